"""Read JSON strictly, with the place of every key and value, and say what to do about each mistake.

Mistakes that do not hide what was meant (a trailing comma, a comment, a key written twice, NaN) are
collected and reading goes on; at any other the text ends there.
"""

from __future__ import annotations

import re

from graphfx.errors import GraphError, LimitError, Location, Problem
from graphfx.graph.items import Item, Source
from graphfx.graph.limits import Limits
from graphfx.graph.tokens import NOT_FINITE, Tokens

_SPACE = re.compile(r"[ \t\r\n]*")
_WORD = re.compile(r"[A-Za-z_$][A-Za-z0-9_$]*")
_COMMENT = re.compile(r"//[^\n]*|#[^\n]*|/\*.*?\*/", re.DOTALL)
_MEANT = {"True": "true", "False": "false", "None": "null", "TRUE": "true", "FALSE": "false", "NULL": "null",
          "undefined": "null", "nil": "null"}
_STRAY_SPACE = {"\u00a0": "a no-break space", "\u2028": "a line separator", "\ufeff": "a byte order mark",
                "\u200b": "a zero-width space", "\u3000": "an ideographic space"}
_WRONG_QUOTES = "'`\u2018\u2019\u201c\u201d"


def decode(data: bytes, file: str) -> tuple[str, list[Problem]]:
    """Return the text of a file's bytes; a byte order mark is left out and reported."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise GraphError(Problem("this file is UTF-16 text; save it as UTF-8", Location(file, 1, 1)))
    problems = []
    if data[:3] == b"\xef\xbb\xbf":
        problems.append(Problem("the file begins with a byte order mark; save it as UTF-8 without one ('UTF-8', not "
                                "'UTF-8 with BOM')", Location(file, 1, 1)))
        data = data[3:]
    try:
        return data.decode("utf-8"), problems
    except UnicodeDecodeError as error:
        before = data[: error.start].decode("utf-8")
        place = Source(file, before).location(len(before))
        raise GraphError(Problem(f"the byte 0x{data[error.start]:02x} is not UTF-8; save the file as UTF-8", place)) from None


def read(text: str | bytes, file: str, limits: Limits | None = None) -> tuple[Item, list[Problem]]:
    """Return the tree of a JSON text and the mistakes that could be read past; raise `GraphError` at any other."""
    limits = limits or Limits()
    size = len(text) if isinstance(text, bytes) else len(text.encode("utf-8", "surrogatepass"))
    if size > limits.bytes:
        raise LimitError(Problem(f"the document has {size:,} bytes, more than the limit of {limits.bytes:,}; "
                                 "split it into groups, or raise the limit on bytes", Location(file)))
    problems: list[Problem] = []
    if isinstance(text, bytes):
        text, problems = decode(text, file)
    elif text.startswith("\ufeff"):
        return read(text.encode("utf-8"), file, limits)
    return _Reader(Source(file, text), limits, problems).document(), problems


class _Reader(Tokens):
    def space(self) -> str:
        """Pass white space and comments; return the next character, or '' at the end."""
        while True:
            self.at = _SPACE.match(self.text, self.at).end()  # type: ignore[union-attr]
            char = self.text[self.at : self.at + 1]
            if char in ("/", "#") and char:
                comment = _COMMENT.match(self.text, self.at)
                if comment is None:
                    self.fail("a comment begins here and does not end; JSON has no comments: use \"doc\"")
                self.note("JSON has no comments; say it in \"doc\", or under a key that begins with 'x-'", self.at)
                self.at = comment.end()
                continue
            if char in _STRAY_SPACE and char:
                self.note(f"{_STRAY_SPACE[char]} stands here; delete it and type an ordinary space", self.at)
                self.at += 1
                continue
            return char

    def document(self) -> Item:
        if not self.space():
            self.fail('the document is empty; the smallest graph is {"graphfx": 1, "nodes": {}}')
        root = self.value()
        if self.space():
            self.fail(f"the document ends before this {self.found()}; delete what follows, or look for a bracket "
                      "closed too early")
        return root

    def found(self) -> str:
        char = self.text[self.at : self.at + 1]
        if not char:
            return "end of the file"
        word = _WORD.match(self.text, self.at)
        text = word.group() if word else char
        text = text if len(text) <= 30 else text[:27] + "..."
        return f"'{text}'" if text.isprintable() else f"character U+{ord(char):04X}"

    def value(self) -> Item:
        char = self.space()
        start = self.at
        if char == "{":
            return self.object()
        if char == "[":
            return self.list()
        if char == '"':
            return self.string()
        if char and char in "-+.0123456789":
            return self.number()
        word = _WORD.match(self.text, start)
        if word:
            return self.word(word)
        if char and char in _WRONG_QUOTES:
            self.fail(f'text stands in double quotes: write " and not {char}')
        if not char:
            self.fail("the file ends where a value should stand")
        self.fail(f"a value should stand here, not {self.found()}")

    def word(self, word: re.Match[str]) -> Item:
        text, start = word.group(), self.at
        if text in ("true", "false", "null"):
            self.at = word.end()
            return self.item({"true": True, "false": False, "null": None}[text], start)
        if text in _MEANT:
            self.note(f"JSON writes '{_MEANT[text]}', not '{text}'", start)
            self.at = word.end()
            return self.item({"true": True, "false": False, "null": None}[_MEANT[text]], start)
        if text in NOT_FINITE:
            self.not_finite(text, start)
            self.at = word.end()
            return self.item(0.0, start, broken=True)
        self.fail(f'\'{text}\' is no JSON value; text stands in double quotes: "{text}"')

    def enter(self) -> int:
        self.depth += 1
        if self.depth > self.limits.depth:
            message = (f"objects and lists nest deeper than the limit of {self.limits.depth}; "
                       "use groups, or raise the limit on depth")
            raise LimitError([*self.problems, Problem(message, self.source.location(self.at))])
        start = self.at
        self.at += 1
        return start

    def leave(self) -> None:
        self.depth -= 1
        self.at += 1

    def separator(self, start: int, close: str) -> bool:
        """Pass the comma between two entries; return whether another entry follows."""
        char = self.space()
        if char == close:
            return False
        kind = "object" if close == "}" else "list"
        if not char:
            self.fail(f"the {kind} that begins here is not closed; write '{close}' at its end", start)
        if char == '"' or (kind == "list" and char in "{[-0123456789"):
            self.note("a comma is missing before this entry", self.at)
            return True
        if char != ",":
            self.fail(f"between two entries of this {kind} stands a comma, and at its end '{close}'; here stands {self.found()}")
        comma = self.at
        self.at += 1
        while self.space() == ",":
            self.note("a second comma stands here; delete it", self.at)
            self.at += 1
        if self.text[self.at : self.at + 1] == close:
            self.note(f"a comma stands before the closing '{close}'; delete it", comma)
            return False
        return True

    def list(self) -> Item:
        start = self.enter()
        values: list[Item] = []
        more = self.space() != "]"
        while more:
            if not self.space():
                self.fail("the list that begins here is not closed; write ']' at its end", start)
            values.append(self.value())
            more = self.separator(start, "]")
        self.leave()
        return self.item(values, start)

    def object(self) -> Item:
        start = self.enter()
        entries: dict[str, Item] = {}
        keys: dict[str, int] = {}
        more = self.space() != "}"
        while more:
            key, at = self.key(start)
            value = self.value()
            if key in keys:
                first = self.source.location(keys[key])
                self.note(f"the key '{key}' stands twice in this object, first at {first.line}:{first.column}; "
                          "delete one of them", at)
            else:
                entries[key], keys[key] = value, at
            more = self.separator(start, "}")
        self.leave()
        return self.item(entries, start, keys=keys)

    def key(self, start: int) -> tuple[str, int]:
        char = self.space()
        at = self.at
        if not char:
            self.fail("the object that begins here is not closed; write '}' at its end", start)
        if char != '"':
            word = _WORD.match(self.text, at)
            if word:
                self.fail(f'keys stand in double quotes: "{word.group()[:40]}"')
            if char in _WRONG_QUOTES:
                self.fail(f'keys stand in double quotes: write " and not {char}')
            self.fail(f"a key in double quotes should stand here, not {self.found()}")
        key = self.string().value
        if self.space() != ":":
            self.fail(f"after the key '{key[:40]}' a colon should stand, not {self.found()}")
        self.at += 1
        return key, at
