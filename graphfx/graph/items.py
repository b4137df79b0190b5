"""JSON values that know where they stand: what the reader makes of a text."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from graphfx.errors import Location


@dataclass(frozen=True, eq=False)
class Source:
    """The text of one document; turns offsets into lines and columns, which count from 1."""

    file: str
    text: str

    @cached_property
    def _line_starts(self) -> list[int]:
        return [0, *(index + 1 for index, char in enumerate(self.text) if char == "\n")]

    def location(self, offset: int) -> Location:
        """Return the place of a character."""
        line = bisect_right(self._line_starts, offset)
        return Location(self.file, line, offset - self._line_starts[line - 1] + 1)


@dataclass(frozen=True, slots=True, eq=False)
class Item:
    """One JSON value: None, bool, int, float, str, a list of Items or a dict of Items.

    `keys` holds the offset of each key of an object; `plain` is false for text with escapes in it,
    whose columns are not those of the file; `broken` is true for what could not be read, so that no check
    complains of it again.
    """

    value: Any
    offset: int
    source: Source
    keys: dict[str, int] = field(default_factory=dict)
    plain: bool = True
    broken: bool = False

    @property
    def location(self) -> Location:
        """Return where the value begins."""
        return self.source.location(self.offset)

    def key_location(self, key: str) -> Location:
        """Return where a key of this object begins."""
        return self.source.location(self.keys[key])

    def text_location(self, index: int) -> Location:
        """Return the place of a character inside this text, or of the text where escapes make that unknown."""
        return self.source.location(self.offset + 1 + index) if self.plain else self.location

    @property
    def is_object(self) -> bool:
        """Return whether it is an object."""
        return isinstance(self.value, dict)

    @property
    def is_list(self) -> bool:
        """Return whether it is a list."""
        return isinstance(self.value, list)

    @property
    def is_text(self) -> bool:
        """Return whether it is text."""
        return isinstance(self.value, str)

    @property
    def is_number(self) -> bool:
        """Return whether it is a number; true and false are none."""
        return isinstance(self.value, int | float) and not isinstance(self.value, bool)

    @property
    def words(self) -> str:
        """Return what a message calls this value."""
        value = self.value
        if value is None:
            return "null"
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, str):
            return f"the text {shown(value)}"
        if isinstance(value, list):
            return f"a list of {len(value)}" if value else "an empty list"
        return "an object" if isinstance(value, dict) else f"the number {value}"

    def entries(self) -> Iterator[tuple[str, Item]]:
        """Yield the entries of an object whose keys do not begin with `x-`; nothing of anything else."""
        if isinstance(self.value, dict):
            for key, item in self.value.items():
                if not key.startswith("x-"):
                    yield key, item

    def data(self) -> Any:
        """Return plain Python data: dict, list, str, int, float, bool, None."""
        if isinstance(self.value, dict):
            return {key: item.data() for key, item in self.value.items()}
        if isinstance(self.value, list):
            return [item.data() for item in self.value]
        return self.value


def shown(text: str, most: int = 60) -> str:
    """Return a text in quotes for a message, on one line and not too long."""
    text = text if len(text) <= most else text[: most - 3] + "..."
    return "'" + "".join(char if char.isprintable() else char.encode("unicode_escape").decode() for char in text) + "'"
