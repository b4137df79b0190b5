"""Parts of a text that a program writes, between the lines `<!-- NAME -->` and `<!-- end of NAME -->`."""

from __future__ import annotations


def _marks(name: str) -> tuple[str, str]:
    return f"<!-- {name} -->\n", f"<!-- end of {name} -->\n"


def part_of(text: str, name: str) -> str:
    """Return what stands between the marks of a name; raise ValueError where they are not there once each, in order."""
    begin, end = _marks(name)
    before, _, rest = text.partition(begin)
    part, found, after = rest.partition(end)
    if not found or begin in rest or end in before + after:
        raise ValueError(f"the text should have the lines {begin.strip()} and {end.strip()} once each, in this order")
    return part


def with_part(text: str, name: str, part: str) -> str:
    """Return a text with something else between the marks of a name."""
    begin, end = _marks(name)
    return text.replace(begin + part_of(text, name) + end, begin + part + end)
