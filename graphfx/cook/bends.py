"""Hits on the way, from the columns in which a run in own time hands them over."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from graphfx.cook.particles import Bends
from graphfx.motion.clock import Interval
from graphfx.plan.knots import MOST_KNOTS, place_name, time_name


def bends_of(rows: np.ndarray, interval: Interval, knots: Mapping[str, tuple[np.ndarray, ...]], since: float) -> Bends:
    """Return the hits of rows after `since` [s], in order of time for each row."""
    counts = knots["knots"][0][: len(rows)]
    found = Bends()
    for k in range(min(int(counts.max(initial=0)), MOST_KNOTS)):
        times = interval.start + knots[time_name(k)][0][: len(rows)].astype(np.float64)
        met = np.flatnonzero((counts > k) & (times > since))
        places = np.stack([part[met].astype(np.float64) for part in knots[place_name(k)]])
        found = found.joined(Bends(rows[met], times[met], places))
    return found
