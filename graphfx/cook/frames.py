"""Frame sets, as people type them: `12`, `1-48`, `1-48x2`, `1-10,20,30-40`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from graphfx.errors import UsageError

_PART = re.compile(r"\s*(-?\d{1,9})(?:-(-?\d{1,9})(?:x(\d{1,9}))?)?\s*")


def parse_frames(text: str, first: int, last: int, whose: str = "the graph's",
                 to_have_more: str = "change time.frames in the graph to have more") -> list[int]:
    """Return the frames of a set in ascending order, each once; all must lie between the first and the last of someone's."""
    found: set[int] = set()
    for part in text.split(","):
        match = _PART.fullmatch(part)
        if match is None:
            raise UsageError(f"--frames: '{part.strip()}' is no frame set; write 12, 1-48, 1-48x2 or several with commas")
        begin, end = int(match[1]), int(match[2] or match[1])
        step = int(match[3] or 1)
        if end < begin or step < 1:
            raise UsageError(f"--frames: '{part.strip()}' is empty; write the lesser frame first and a step of 1 or more")
        if begin < first or end > last:
            raise UsageError(f"--frames: '{part.strip()}' goes beyond {whose} frames {first} to {last}; {to_have_more}")
        found.update(range(begin, end + 1, step))
    return sorted(found)


def frames_text(frames: Iterable[int]) -> str:
    """Return the shortest common way to type a set of frames, which `parse_frames` reads back."""
    left, parts = sorted(set(frames)), []
    while left:
        step = left[1] - left[0] if len(left) > 1 else 1
        count = 1
        while count < len(left) and left[count] - left[count - 1] == step:
            count += 1
        if count == 2 and step > 1:
            count = 1
        many = f"-{left[count - 1]}" + (f"x{step}" if step > 1 else "")
        parts.append(f"{left[0]}{many if count > 1 else ''}")
        left = left[count:]
    return ",".join(parts)


def spread(frames: Sequence[int], count: int) -> list[int]:
    """Return so many of the frames, or all if they are fewer, evenly spread from the first to the last."""
    count = min(count, len(frames))
    return [frames[place * (len(frames) - 1) // max(count - 1, 1)] for place in range(count)]
