"""Which numbers of particles kept them from being drawn: those that are not finite."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from graphfx.cook.moments import pieces
from graphfx.cook.streaks import Shown
from graphfx.plan.pictures import ImagePlan

COLUMNS = {"position": range(6), "radius": range(6, 8), "color": range(8, 14), "opacity": range(14, 16)}
"""The columns of streaks by attribute; see Streaks.columns."""


Fault = tuple[str, str, int]
"""A stream, or "" for triangles; an attribute that was not finite; and of how many that were not drawn."""


def faults_of(shown: Sequence[Shown], image: ImagePlan, dropped: int) -> list[Fault]:
    """Return why so many were not drawn; one with several faults is told of under the first of its attributes."""
    read = {"position", *image.reads}
    found = Counter[tuple[str, str]]()
    for each in shown:
        for start, stop in pieces(0, each.streaks.count):
            columns, told = each.streaks.columns(start, stop), np.zeros(stop - start, bool)
            for attribute, places in COLUMNS.items():
                if attribute in read:
                    wrong = ~np.logical_and.reduce([np.broadcast_to(np.isfinite(columns[c]), len(told)) for c in places]) & ~told
                    found[image.streams[each.stream].path, attribute] += int(np.count_nonzero(wrong))
                    told |= wrong
    left = dropped - found.total()
    return [(*whose, count) for whose, count in found.items() if count] + ([("", "corners or colours", left)] if left > 0 else [])
