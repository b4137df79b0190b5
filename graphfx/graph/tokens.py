"""The tokens of a JSON text that can be wrong in themselves: numbers and texts."""

from __future__ import annotations

import re
from typing import Any, NoReturn

from graphfx.errors import GraphError, Problem
from graphfx.graph.items import Item, Source
from graphfx.graph.limits import Limits

_PLAIN_TEXT = re.compile(r'"([^"\\\x00-\x1f]*)"')
_TEXT_PART = re.compile(r'[^"\\\x00-\x1f]+')
_NUMBER = re.compile(r"-?(?:0|[1-9][0-9]*)(\.[0-9]+)?([eE][-+]?[0-9]+)?")
_NUMBER_LIKE = re.compile(r"[-+.0-9][-+.0-9A-Za-z_]*")
_HEX4 = re.compile(r"[0-9A-Fa-f]{4}")
_ESCAPES = {'"': '"', "\\": "\\", "/": "/", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t"}
_LONGEST_INTEGER = 18
NOT_FINITE = {"NaN", "nan", "Infinity", "inf", "Inf"}


class Tokens:
    """A place in a text, and the readers of numbers and texts that stand there."""

    def __init__(self, source: Source, limits: Limits, problems: list[Problem]):
        """Stand at the beginning of a text; mistakes that can be read past go to `problems`."""
        self.source, self.text, self.limits, self.problems = source, source.text, limits, problems
        self.at = 0
        self.depth = 0

    def fail(self, message: str, offset: int | None = None) -> NoReturn:
        """Stop reading here, or at an offset."""
        problem = Problem(message, self.source.location(self.at if offset is None else offset))
        raise GraphError([*self.problems, problem])

    def note(self, message: str, offset: int) -> None:
        """Tell a mistake and read on."""
        self.problems.append(Problem(message, self.source.location(offset)))

    def item(self, value: Any, offset: int, **more: Any) -> Item:
        """Return a value that begins at an offset."""
        return Item(value, offset, self.source, **more)

    def not_finite(self, text: str, start: int) -> None:
        """Tell that JSON has no such number."""
        meant = "give a finite number" if text.lower() == "nan" else 'leave the parameter out, or write "infinity" in quotes'
        self.note(f"JSON has no {text}; {meant}", start)

    def number(self) -> Item:
        """Read a number."""
        start = self.at
        like = _NUMBER_LIKE.match(self.text, start).group()  # type: ignore[union-attr]
        number = _NUMBER.fullmatch(like)
        self.at = start + len(like)
        if number is None:
            if like.lstrip("+-") in NOT_FINITE:
                self.not_finite(like, start)
            else:
                self.note(f"'{like[:40]}' is no JSON number{_repaired(like)}", start)
            return self.item(0.0, start, broken=True)
        if number.group(1) is None and number.group(2) is None and len(like) <= _LONGEST_INTEGER:
            return self.item(int(like), start)
        value = float(like)
        if value in (float("inf"), float("-inf")):
            self.note(f"the number {like[:40]} is too large; the largest is about 1.8e308", start)
            return self.item(0.0, start, broken=True)
        return self.item(value, start)

    def string(self) -> Item:
        """Read a text."""
        start = self.at
        whole = _PLAIN_TEXT.match(self.text, start)
        if whole:
            self.at = whole.end()
            return self.item(whole.group(1), start)
        parts: list[str] = []
        self.at += 1
        while True:
            run = _TEXT_PART.match(self.text, self.at)
            if run:
                parts.append(run.group())
                self.at = run.end()
            char = self.text[self.at : self.at + 1]
            if char == '"':
                self.at += 1
                return self.item("".join(parts), start, plain=False)
            if char in ("", "\n", "\r"):
                self.fail('the text that begins here has no closing quote; end it with " on the same line', start)
            if char == "\\":
                parts.append(self.escape())
            else:
                escape = {"\t": "\\t"}.get(char, f"\\u{ord(char):04x}")
                self.note(f"the control character U+{ord(char):04X} stands in a text; write {escape}", self.at)
                parts.append(char)
                self.at += 1

    def escape(self) -> str:
        """Read what a backslash begins."""
        start = self.at
        kind = self.text[start + 1 : start + 2]
        if kind in _ESCAPES and kind:
            self.at += 2
            return _ESCAPES[kind]
        if kind != "u":
            name = kind if kind.isprintable() else ""
            self.note(f"\\{name} means nothing in JSON; write \\\\ for a backslash, / in paths", start)
            self.at += 1
            return ""
        code = self.code_unit(start)
        if 0xD800 <= code < 0xDC00 and self.text.startswith("\\u", self.at):
            second_start = self.at
            low = self.code_unit(self.at)
            if 0xDC00 <= low < 0xE000:
                return chr(0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00))
            self.at = second_start
        if 0xD800 <= code < 0xE000:
            self.note(f"\\u{code:04x} is half of a surrogate pair; write the character itself, or both halves", start)
            return "\ufffd"
        return chr(code)

    def code_unit(self, start: int) -> int:
        """Read the four digits after a backslash and u at `start`."""
        digits = _HEX4.match(self.text, start + 2)
        if digits is None:
            self.note("\\u needs four hexadecimal digits, as in \\u00e9", start)
            self.at = start + 2
            return 0xFFFD
        self.at = start + 6
        return int(digits.group(), 16)


def _repaired(like: str) -> str:
    """Return "; write ..." with the number as JSON would have it, where that is clear."""
    text = like.lstrip("+").replace("_", "")
    try:
        value = float(text)
    except ValueError:
        try:
            value = int(text, 16)
        except ValueError:
            return ""
    return f"; write {value:g}" if abs(value) < 1e300 else ""
