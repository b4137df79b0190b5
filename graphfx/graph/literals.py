"""Literal values: numbers, vectors, colours, text, intervals and lists, checked against a declaration."""

from __future__ import annotations

import re
from typing import Any

from graphfx.graph.checking import Checking, not_one_of, number
from graphfx.graph.items import Item, shown
from graphfx.graph.paths import PathRefused, find_file
from graphfx.node.types import Parameter

VECTORS = ("vec3", "point", "direction", "color")
_HEX_COLOR = re.compile(r"#(?:[0-9A-Fa-f]{3}|[0-9A-Fa-f]{6})")
_INFINITY = {"infinity": float("inf"), "-infinity": float("-inf")}
_WANTED = {
    "float": "a number", "int": "a whole number", "bool": "true or false", "vec3": "a vector [x, y, z]",
    "point": "a point [x, y, z]", "direction": "a direction [x, y, z]", "string": "text in quotes",
    "color": 'a colour, "#rrggbb" or linear [red, green, blue]', "path": "the path of a file",
    "interval": "an interval [start, end]", "list": "a list of numbers or texts", "": "a value",
    "mesh": "the id of a geometry node",
}


def lane(kind: str) -> str:
    """Return the type that expressions know for a parameter's type: 'float', 'vec3', 'bool', or the type itself."""
    return {"int": "float"}.get(kind, "vec3" if kind in VECTORS else kind)


def wanted(want: Parameter) -> str:
    """Return what a parameter should be given, with its unit."""
    if want.choices:
        return f"{'a list of some' if want.type == 'list' else 'one'} of {', '.join(want.choices)}"
    if want.type == "list" and want.default:
        return f"a list such as {list(want.default)}"
    return _WANTED.get(want.type, want.type) + (f" [{want.unit}]" if want.unit else "")


def linear(channel: float) -> float:
    """Return the linear light of an sRGB channel in 0..1 [IEC 61966-2-1].

        c / 12.92                        c <= 0.04045
        ((c + 0.055) / 1.055) ** 2.4     otherwise

    Rounded to 8 decimals, so that all machines agree.
    """
    return round(channel / 12.92 if channel <= 0.04045 else ((channel + 0.055) / 1.055) ** 2.4, 8)


def color(text: str) -> tuple[float, float, float] | None:
    """Return the linear colour of "#rrggbb" or "#rgb", or None where the text is neither."""
    if not _HEX_COLOR.fullmatch(text):
        return None
    digits = text[1:] if len(text) == 7 else "".join(digit * 2 for digit in text[1:])
    red, green, blue = (linear(int(digits[i : i + 2], 16) / 255) for i in (0, 2, 4))
    return red, green, blue


def out_of_range(value: Any, want: Parameter) -> str:
    """Return what is wrong with a number, or with one of a vector's, or ''."""
    if isinstance(value, bool | str) or value is None:
        return ""
    for part in value if isinstance(value, tuple) else (value,):
        if isinstance(part, str):
            continue
        low, high = want.min, want.max
        if (low is None or part >= low) and (high is None or part <= high):
            continue
        unit = f" [{want.unit}]" if want.unit else ""
        if low is not None and high is not None:
            limits = f"must lie between {number(low)} and {number(high)}{unit}"
        else:
            limits = f"must be at least {number(low)}{unit}" if low is not None else f"must be at most {number(high or 0)}{unit}"
        return f"{number(part)} is out of range; {want.name} {limits}"
    return ""


def not_chosen(value: Any, want: Parameter) -> bool:
    """Return whether a value, or an entry of a list, is none of a parameter's choices."""
    parts = value if isinstance(value, tuple) else (value,)
    return bool(want.choices) and any(str(part) not in want.choices for part in parts)


class Literals:
    """Reads literals; complaints go to the checking."""

    def __init__(self, checking: Checking, folders: list[Any]):
        """Read for a graph whose files may lie in `folders`."""
        self.checking, self.folders = checking, folders

    def read(self, item: Item, want: Parameter, path: str) -> Any:
        """Return the value of a literal as `Literal.value` holds it, or None after a complaint."""
        notes: tuple[str, ...] = ()
        try:
            value, message = self._convert(item, want)
        except PathRefused as refusal:
            value, message, notes = None, str(refusal), refusal.notes
        if value is not None:
            message = out_of_range(value, want)
            if not item.is_text and not_chosen(value, want):
                message = not_one_of(item, want.name, want.choices)
            if not message and want.type == "direction" and not any(value):
                message = f"{want.name} is a direction, and [0, 0, 0] points nowhere"
        if message:
            self.checking.complain(item.location, path, message, *notes)
            return None
        return value

    def _convert(self, item: Item, want: Parameter) -> tuple[Any, str]:
        value, kind = item.value, want.type
        if kind in ("float", "int", ""):
            return self._number(item, want)
        if kind == "bool" and isinstance(value, bool):
            return value, ""
        if kind in VECTORS:
            return self._vector(item, want)
        if kind == "string" and item.is_text:
            if want.choices and value not in want.choices:
                return None, _unlike(want, item)
            return value, ""
        if kind == "path" and item.is_text:
            if value == want.default == "":
                return "", ""
            return str(find_file(value, self.folders)), ""
        if kind == "interval" and item.is_list and len(value) == 2 and all(_is_end(part) for part in value):
            start, end = (_INFINITY[part.value] if part.is_text else float(part.value) for part in value)
            return ((start, end), "") if start <= end else (None, f"the interval ends at {number(end)}, before its start "
                                                                   f"at {number(start)}; write [start, end]")
        if kind == "list" and item.is_list:
            return _list(item, want)
        return None, _unlike(want, item)

    def _number(self, item: Item, want: Parameter) -> tuple[Any, str]:
        value = item.value
        if want.type == "":
            if isinstance(value, bool):
                return value, ""
            if item.is_list or (item.is_text and str(value).startswith("#")):
                return self._vector(item, want)
        if item.is_text and value in _INFINITY and want.type != "int":
            return _INFINITY[value], ""
        if not item.is_number:
            return None, _unlike(want, item)
        if want.type == "int":
            if float(value).is_integer():
                return int(value), ""
            return None, f"{want.name} should be a whole number, not {value}"
        return float(value), ""

    def _vector(self, item: Item, want: Parameter) -> tuple[Any, str]:
        if item.is_text and want.type in ("color", ""):
            found = color(item.value)
            wrong = f"{shown(item.value)} is no colour; write \"#rrggbb\", as in \"#ff8000\", or linear [1, 0.5, 0]"
            return found, "" if found else wrong
        if not item.is_list or len(item.value) != 3 or not all(part.is_number for part in item.value):
            if want.type == "color" and item.is_list and len(item.value) == 4:
                return None, "a colour has three channels; opacity is an attribute of its own"
            return None, _unlike(want, item)
        return tuple(float(part.value) for part in item.value), ""


def _is_end(item: Item) -> bool:
    return item.is_number or (item.is_text and item.value in _INFINITY)


def _list(item: Item, want: Parameter) -> tuple[Any, str]:
    """Return a list; where the default has entries, it says how many and of what kind they are."""
    like = want.default if isinstance(want.default, tuple | list) else ()
    if like and len(item.value) != len(like):
        return None, f"{want.name} should be a list of {len(like)}, such as {list(like)}; here stands {item.words}"
    for index, part in enumerate(item.value):
        if want.choices:
            if not part.is_text or part.value not in want.choices:
                return None, not_one_of(part, f"entry {index} of {want.name}", want.choices)
            if part.value in [other.value for other in item.value[:index]]:
                return None, f"{want.name} names '{part.value}' twice; keep one"
        if not (part.is_number or part.is_text):
            return None, f"{want.name} holds numbers or texts, but entry {index} is {part.words}"
        whole = index < len(like) and type(like[index]) is int
        if (like and isinstance(like[index], str) != part.is_text) or (whole and not float(part.value).is_integer()):
            kind = "text in quotes" if isinstance(like[index], str) else "a whole number" if whole else "a number"
            return None, f"entry {index} of {want.name} should be {kind}, not {part.words}"
    parts = (part.value for part in item.value)
    return tuple(int(part) if isinstance(part, float) and part.is_integer() else part for part in parts), ""


def _unlike(want: Parameter, item: Item) -> str:
    """Return that an item is not what is wanted, and what to write instead."""
    name = want.name or "this"
    if want.choices and item.is_text and want.type != "list":
        return not_one_of(item, name, want.choices)
    message = f"{name} should be {wanted(want)}; here stands {item.words}"
    if item.is_list and len(item.value) == 2 and lane(want.type) in ("float", "vec3"):
        return message + '; a value drawn between two is {"rand": [a, b]}'
    if item.is_text and lane(want.type) == "float":
        try:
            float(item.value)
        except ValueError:
            return message + f'; an expression is {{"expr": {_quoted(item.value)}}}'
        return message + "; write it without quotes"
    if isinstance(item.value, bool) and lane(want.type) == "float":
        return message + "; write 1 or 0"
    return message


def _quoted(text: str) -> str:
    return '"' + shown(text, 40)[1:-1].replace('"', '\\"') + '"'
