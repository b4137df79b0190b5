"""What a parameter may be given in Python, and how it is written in JSON."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from graphfx.authoring.places import Places, caller, fault


class Condition:
    """What can be combined with `&`, `|` and `~`: expressions, selectors, and the ids of selector nodes."""

    def __and__(self, other: Any) -> Value:
        return Value({"all": [*_parts(self, "all"), *_parts(other, "all")]})

    def __or__(self, other: Any) -> Value:
        return Value({"any": [*_parts(self, "any"), *_parts(other, "any")]})

    def __invert__(self) -> Value:
        return Value({"not": self})

    def __bool__(self) -> bool:
        raise fault("whether particles pass is known only in the cook; combine conditions with &, | and ~")


class Value(Condition):
    """A value of the graph language; `data` is its JSON object, in which further values may stand."""

    def __init__(self, data: dict[str, Any]):
        self.data = data
        self.place = caller()

    def __repr__(self) -> str:
        return f"Value({plain(self)})"


class Reference(Condition):
    """A node, as others name it: its id, or `id.output`."""

    def __init__(self, id: str):
        self.id = id

    def look(self, **looks: str) -> dict[str, Any]:
        """Return how an image draws this stream: blend="add", falloff="gaussian", streak="solid"."""
        return {"stream": self.id, **looks}


def _parts(condition: Any, word: str) -> list[Any]:
    """Return the conditions that a combination lists, so that `a & b & c` is one list of three."""
    if isinstance(condition, Value) and list(condition.data) == [word]:
        return list(condition.data[word])
    return [condition]


def plain(given: Any, path: str = "", places: Places | None = None) -> Any:
    """Return what Python gave as JSON data; the lines that made its parts are noted in `places`.

    Tuples, arrays and numbers of NumPy become lists and numbers, infinity its word, nodes their ids.
    """
    if isinstance(given, Value):
        if places is not None:
            places.note(path, given.place)
        return plain(given.data, path, places)
    if isinstance(given, Reference):
        return given.id
    if isinstance(given, Mapping):
        return {str(key): plain(part, f"{path}.{key}" if path else str(key), places) for key, part in given.items()}
    if hasattr(given, "tolist"):
        given = given.tolist()
    if isinstance(given, list | tuple | range):
        return [plain(part, f"{path}[{index}]", places) for index, part in enumerate(given)]
    if isinstance(given, float) and not math.isfinite(given):
        if math.isnan(given):
            raise fault("NaN is no value; give a number", path=path)
        return "infinity" if given > 0 else "-infinity"
    if given is None or isinstance(given, str | bool | int | float):
        return given
    if hasattr(given, "__fspath__"):
        return given.__fspath__()
    raise fault(f"{type(given).__name__} is nothing that a graph holds; give a number, a text, a list, or a value of the graph",
                path=path)
