"""Lay JSON data out: what fits stands on one line, the rest is broken so that changes show as few lines."""

from __future__ import annotations

import json
from typing import Any

WIDTH = 100
_LARGEST_PLAIN = 1e15


def text_of_number(value: float) -> str:
    """Return the shortest text that reads back as the same number; whole numbers without '.0'."""
    whole = isinstance(value, float) and value.is_integer() and abs(value) < _LARGEST_PLAIN
    return str(int(value)) if whole and str(value) != "-0.0" else repr(value)


def scalar(value: Any) -> str:
    """Return a number, text, true, false or null."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return text_of_number(value)
    return json.dumps(value, ensure_ascii=False)


def on_one_line(value: Any) -> str:
    """Return data on one line, however long."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{scalar(key)}: {on_one_line(part)}" for key, part in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(on_one_line(part) for part in value) + "]"
    return scalar(value)


def lay_out(value: Any, indent: int = 0, lead: int = 0, broken: tuple[str, ...] = (), key: str | None = "") -> str:
    """Return data at an indentation; `lead` columns stand before it on its first line.

    Objects under a key of `broken` are broken even where they would fit: one entry a line. The key of the
    whole is '', and entries of lists have none.
    """
    forced = key in broken and isinstance(value, dict) and bool(value)
    line = on_one_line(value)
    if not forced and (indent + lead + len(line) < WIDTH or not isinstance(value, dict | list) or not value):
        return line
    inner = indent + 2
    entries: list[tuple[str, bool]] = []
    if isinstance(value, dict):
        for name, part in value.items():
            label = f"{scalar(name)}: "
            entries.append((label + lay_out(part, inner, len(label), broken, name), not forced and _small(part)))
    else:
        entries = [(lay_out(part, inner, 0, broken, None), _small(part)) for part in value]
    opening, closing = "{}" if isinstance(value, dict) else "[]"
    margin = " " * inner
    return opening + "\n" + margin + f",\n{margin}".join(_filled(entries, inner)) + "\n" + " " * indent + closing


def _small(value: Any) -> bool:
    """Return whether data may share a line with its neighbours: scalars, and lists of them."""
    if isinstance(value, list):
        return all(not isinstance(part, dict | list) for part in value)
    return not isinstance(value, dict)


def _filled(entries: list[tuple[str, bool]], indent: int) -> list[str]:
    """Return lines of entries; small neighbours share a line while it is not too long."""
    lines: list[str] = []
    open_line = False
    for text, small in entries:
        if small and open_line and "\n" not in text and indent + len(lines[-1]) + 2 + len(text) < WIDTH:
            lines[-1] += f", {text}"
        else:
            lines.append(text)
        open_line = small
    return lines
