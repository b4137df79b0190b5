"""The shutter: at which instants the places of particles are kept, so that a picture can show where they have been.

With `shutter` and `phase` in frames, the shutter of the picture of frame n is open

    from  n - phase - shutter  to  n - phase

The places where particles were then are found within the frame in which the instant lies (`tail` when the shutter opens),
and handed on from frame to frame where it is more than one frame ago. Only what some picture needs is kept.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

EDGE = 1e-9
"""Frames; instants nearer to each other are one."""


@dataclass(frozen=True)
class Instant:
    """A time `back` frames before a picture's, and the column that holds where particles were.

    As a frame begins the column takes over what `source` holds, an instant's column or the position of a frame ago; where
    there is none, the frame's programs find it.
    """

    back: float
    column: str
    source: str = ""
    reason: str = field(default="", compare=False)
    """Why it is kept."""

    @property
    def time(self) -> str:
        """Return the name of the instant's time in programs."""
        return "opening" if self.column == "tail" else self.column

    def step(self, substeps: int) -> int:
        """Return the step of a frame in which the instant lies."""
        return min(int((1 - self.back) * substeps), substeps - 1)


@dataclass(frozen=True)
class Exposure:
    """What pictures see of one source: how far back they reach [frames], and the instants kept, the latest first."""

    reach: float = 0.0
    instants: tuple[Instant, ...] = ()
    deep: bool = False
    """Whether a picture shows what is not of its own frame's time alone, so that births and deaths must be known for longer."""

    @property
    def within(self) -> list[Instant]:
        """Return the instants that the frame's programs find."""
        return [instant for instant in self.instants if not instant.source]


def exposure_of(windows: Iterable[tuple[float, float]]) -> Exposure:
    """Return what is kept for pictures of some (phase, shutter): exact when the longest opens, and when any closes."""
    known = sorted({(phase, shutter) for phase, shutter in windows})
    reach = max((phase + shutter for phase, shutter in known), default=0.0)
    if reach <= EDGE:
        return Exposure()
    deep = reach > 1 + EDGE or any(phase > EDGE for phase, _ in known)
    lengths = {_within_frame(reach): reach}
    for phase, _ in known:
        if phase > EDGE:
            lengths.setdefault(_within_frame(phase), phase)
            lengths[_within_frame(phase)] = max(lengths[_within_frame(phase)], phase)
    if reach > 1 + EDGE:
        lengths[1.0] = max(lengths.get(1.0, 0.0), math.floor(reach + EDGE))
    instants = [instant for first, last in lengths.items() for instant in _chain(first, last, first == _within_frame(reach))]
    instants.sort(key=lambda instant: instant.back)
    ends = {round(back, 6): "opened" for phase, shutter in known for back in (phase + shutter,)}
    ends |= {round(phase, 6): "closed" for phase, _ in known}
    return Exposure(reach, tuple(replace(instant, reason=_reason(instant.back, ends)) for instant in instants), deep)


def _reason(back: float, ends: dict[float, str]) -> str:
    """Return why an instant is kept."""
    end = ends.get(round(back, 6))
    what = f"the shutter {end}" if end else f"it was {back:g} frame{'' if back == 1 else 's'} before"
    return f"where {what}, for motion blur"


def _within_frame(back: float) -> float:
    """Return the instant of the last frame, 0 < b <= 1, from which one so many frames back is handed on."""
    return round(back - math.ceil(back - EDGE) + 1, 9)


def _chain(first: float, last: float, opens: bool) -> Iterable[Instant]:
    """Yield the instants first, first + 1, ... last."""
    column = "tail" if opens else f"path {first:g}"
    yield Instant(first, column, "position" if first == 1.0 and not opens else "")
    for k in range(1, round(last - first + EDGE) + 1):
        before, column = column, f"path {first + k:g}"
        yield Instant(first + k, column, before)
