"""Write down where the paths of particles bend: the places and times of their hits within a run in their own time."""

from __future__ import annotations

from graphfx.motion import basic, events
from graphfx.program import Builder, Column, Uniform

MOST_KNOTS = 8
"""Hits of one particle that are kept of one run; of more, the first ones and the last, with a straight way between."""


class Knots:
    """The columns that hold a particle's hits: `knots` counts them, `knot k` is where and `knot k time` when the k-th was."""

    def __init__(self, builder: Builder):
        nought, nowhere = Uniform("0", "float", 0.0), Uniform("(0, 0, 0)", "vec3", (0.0, 0.0, 0.0))
        self.count = builder.call(basic.copy_number, nought, name="knots")
        self.times = [builder.call(basic.copy_number, nought, name=time_name(k)) for k in range(MOST_KNOTS)]
        self.places = [builder.call(basic.copy_vector, nowhere, name=place_name(k)) for k in range(MOST_KNOTS)]

    def note(self, builder: Builder, time: Column, place: Column) -> None:
        """Write down a hit: in the next column, or in the last."""
        builder.note = "motion blur"
        for k, into in enumerate(zip(self.times, self.places, strict=True)):
            number = Uniform(str(k), "float", float(k))
            function = basic.kept_knot if k + 1 < MOST_KNOTS else basic.kept_last_knot
            builder.call(function, *into, self.count, number, time, place, into=into)
        builder.call(events.one_more, self.count, into=self.count)

    @property
    def stores(self) -> dict[str, Column]:
        """Return the columns by the names under which a run hands them over."""
        times = {time_name(k): column for k, column in enumerate(self.times)}
        return {"knots": self.count, **times, **{place_name(k): column for k, column in enumerate(self.places)}}


def time_name(k: int) -> str:
    """Return the name of the time of the k-th knot."""
    return f"knot {k} time"


def place_name(k: int) -> str:
    """Return the name of the place of the k-th knot."""
    return f"knot {k}"
