"""The words and signs of expressions."""

from __future__ import annotations

import re
from collections.abc import Iterator

TOKEN = re.compile(r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|(?P<name>[A-Za-z_]\w*)"
                    r"|(?P<sign>\*\*|<=|>=|==|!=|&&|\|\||//|[-+*/%<>().,=!^?:\[\]]))")
KEYWORDS = ("and", "or", "not", "if", "else")
QUALIFIERS = ("param", "birth", "parent", "hit")
FOREIGN = {
    "&&": "write 'and'", "||": "write 'or'", "!": "write 'not'", "^": "a power is written a ** b", "=": "equality is written ==",
    "?": "a choice is written 'a if condition else b'", ":": "a choice is written 'a if condition else b'",
    "//": "write floor(a / b)", "[": "a vector is written vec(x, y, z)",
}
"""Signs of other languages, and what to write instead."""


def names_in(text: str) -> Iterator[str]:
    """Yield the names that an expression reads and that stand by themselves: no functions, nothing before or after a dot."""
    tokens = [token.group(token.lastgroup or 0) for token in TOKEN.finditer(text)]
    for before, word, after in zip(["", *tokens], tokens, [*tokens[1:], ""], strict=False):
        if before != "." and after != "(" and (after != "." or word not in QUALIFIERS) and word.isidentifier():
            yield word
