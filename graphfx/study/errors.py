"""How far particles are from where they should be, and what a set of such distances comes to.

    e = |P - P_true| [m],    RMS = sqrt(mean e^2)

over all particles and frames that are compared. A particle that is no number, that is missing, or that is farther from
its true place than all true places lie apart has failed: it counts as infinitely wrong in the median, in the 95th
percentile and among those over the tolerance, and not at all in RMS and greatest error.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from graphfx.cook.matching import distances, keys_of, quantile
from graphfx.cook.trial import States

StatesByFrame = Mapping[str, Mapping[int, States]]


@dataclass(frozen=True)
class Errors:
    """Statistics of distances [m]; `compared` counts pairs of a particle and a frame, the rest counts particles."""

    compared: int = 0
    rms: float = 0.0
    median: float = 0.0
    p95: float = 0.0
    greatest: float = 0.0
    over: int = 0
    """Pairs whose error is above the tolerance."""
    not_finite: int = 0
    missing: int = 0
    escaped: int = 0

    @property
    def failures(self) -> int:
        """Return how many particles failed, in whatever way."""
        return self.not_finite + self.missing + self.escaped


@dataclass
class Distances:
    """Distances as they are gathered, with the particles that failed in one way or another."""

    found: dict[int, list[np.ndarray]] = field(default_factory=dict)
    """By frame."""
    not_finite: set[tuple[str, int]] = field(default_factory=set)
    missing: set[tuple[str, int]] = field(default_factory=set)
    escaped: set[tuple[str, int]] = field(default_factory=set)

    def add(self, source: str, frame: int, true: States, other: States, extent: float) -> None:
        """Compare the particles of one source at one frame."""
        distance, rows, theirs = distances(true, other)
        keys = keys_of(true)
        lost = np.ones(len(true), bool)
        lost[rows] = False
        wrong = np.zeros(len(true), bool)
        wrong[rows] = ~np.isfinite(other.position[theirs]).all(axis=1)
        away = ~lost & ~wrong & (distance > extent)
        for failed, which in ((self.missing, lost), (self.not_finite, wrong), (self.escaped, away)):
            failed.update((source, int(key)) for key in keys[which])
        distance[lost | wrong | away] = np.inf
        self.found.setdefault(frame, []).append(distance)

    def by_frame(self, share: float = 0.95) -> dict[int, float]:
        """Return a quantile of the distances at each frame [m], of those frames that have any."""
        joined = {frame: np.sort(np.concatenate(found)) for frame, found in self.found.items()}
        return {frame: quantile(each, share) for frame, each in sorted(joined.items()) if len(each)}

    def errors(self, tolerance: float) -> Errors:
        """Return the statistics."""
        parts = [each for found in self.found.values() for each in found]
        every = np.sort(np.concatenate(parts)) if parts else np.zeros(0)
        if not len(every):
            return Errors()
        finite = every[np.isfinite(every)]
        rms = root_mean_square(finite)
        escaped = self.escaped - self.not_finite
        missing = self.missing - self.not_finite - escaped
        return Errors(
            len(every), rms, quantile(every, 0.5), quantile(every, 0.95), float(finite[-1]) if len(finite) else np.inf,
            int(np.count_nonzero(every > tolerance)), len(self.not_finite), len(missing), len(escaped),
        )


def root_mean_square(values: np.ndarray) -> float:
    """Return sqrt(mean v^2), scaled so that nothing overflows; infinite of nothing."""
    greatest = float(np.max(values)) if len(values) else np.inf
    if greatest in (0.0, np.inf):
        return greatest
    return greatest * float(np.sqrt(np.mean((values / greatest) ** 2)))


def observed_order(work: list[float], errors: list[float], least: float, most: float = np.inf) -> float | None:
    """Return p of error ~ work^-p by least squares over the points between `least` and `most`.

    None where they are fewer than two, or the most work of them is not twice the least.

    What has more work than the point of least error is left out, since there rounding rules; of more than four the four
    with the most work count, which are nearest to the limit.
    """
    known = sorted((w, e) for w, e in zip(work, errors, strict=True) if np.isfinite(e) and w > 0)
    best = min(known, key=lambda point: point[1], default=(0.0, 0.0))[0]
    points = [(np.log(w), np.log(e)) for w, e in known if least < e < most and w <= best][-4:]
    if len(points) < 2 or points[-1][0] - points[0][0] < 0.99 * np.log(2):
        return None
    x, y = np.array(points).T
    x = x - x.mean()
    return float(-(x @ y) / (x @ x))
