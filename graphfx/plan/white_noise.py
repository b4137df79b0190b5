"""Write the random vectors that noise operators are handed, for the cells of 1/24 s that a step meets."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from graphfx.math.random import key_of
from graphfx.motion import basic, wiener
from graphfx.motion.clock import GRID
from graphfx.plan.moment import ZERO, Moment
from graphfx.plan.movers import Mover
from graphfx.program import Column, Operand, Uniform

NOUGHT = Uniform("0", "float", 0.0)
END = Uniform(f"{GRID}", "float", float(GRID))
WHOLE_STEP = -1
"""In place of a cell's number: the whole step, however many cells it meets."""


@dataclass
class WhiteNoise:
    """Noise of one source; a step may meet `cells` cells. What was `prepared` serves all who go parts of the same step."""

    cells: int
    prepared: dict[tuple[int, Operand], Operand] = field(default_factory=dict)

    def draw(self, mover: Mover, moment: Moment, cell: int) -> Column:
        """Write the draw of a cell, or of that of the middle of the step."""
        return self._draw(mover, moment, moment.writer.scope.number("lives"), moment.cell_time("cell", cell))

    @staticmethod
    def _draw(mover: Mover, moment: Moment, life: Operand, cell: Operand) -> Column:
        scope = moment.writer.scope
        return moment.builder.draw(key_of(scope.seed, scope.emitter, mover.node.seed), scope.identity(), life, cell)

    def prepare(self, mover: Mover, moment: Moment, cell: int) -> None:
        """Write the vector of Brownian noise before those who need it."""
        if mover.is_brownian:
            self.prepared[self._key(mover, moment, cell)] = self._brownian(mover, moment, cell)

    @staticmethod
    def _key(mover: Mover, moment: Moment, cell: int) -> tuple[int, Operand]:
        return id(mover), moment.cell_time("cell", cell)

    def vector(self, mover: Mover, moment: Moment, cell: int) -> Operand:
        """Return the vector of a cell, or of the whole step: uniform in the unit ball, or a Brownian increment over its time."""
        if not mover.is_brownian:
            held: Operand = moment.builder.call(wiener.in_ball, self.draw(mover, moment, cell), name="noise")
            return held
        return self.prepared.get(self._key(mover, moment, cell)) or self._brownian(mover, moment, cell)

    def _brownian(self, mover: Mover, moment: Moment, cell: int) -> Operand:
        """Write the increment of a step, or of its piece in a cell, over its time; that of the newborn is since their birth."""
        builder = moment.builder
        builder.note = f"{mover.node.path}: Brownian noise"
        cells = range(self.cells) if cell == WHOLE_STEP else (cell,)
        begin, end = moment.cell_time("piece begin", cells[0]), moment.cell_time("piece end", cells[-1])
        born = moment.born() if moment.born is not None else None
        after = before = None
        for each in cells:
            ends = self._ends(mover, moment, each, born)
            after = ends[1] if after is None else builder.call(basic.sum_of_vectors, after, ends[1], name="after")
            before = ends[0] if before is None else builder.call(basic.sum_of_vectors, before, ends[0], name="before")
        since = begin if born is None else builder.call(basic.later, begin, born, name="since")
        white: Operand = builder.call(wiener.white, after, before, since, end, name="white noise")  # type: ignore[arg-type]
        return white

    def _ends(self, mover: Mover, moment: Moment, cell: int, born: Operand | None) -> list[Operand]:
        """Write W at both ends of a step's piece in a cell, from 0 at the cell's begin."""
        builder = moment.builder
        lives = moment.writer.scope.attribute("lives")
        number = moment.cell_time("cell", cell)
        word = builder.call(wiener.whole_word, lives, name="whole")
        at_end = builder.call(wiener.whole, self._draw(mover, moment, word, number), name="at end")
        first, last = moment.cell_time("first place", cell), moment.cell_time("last place", cell)
        if born is not None:
            start, begin = moment.cell_time("cell start", cell), moment.cell_time("piece begin", cell)
            first = builder.call(wiener.place_of_birth, born, begin, start, first, last, name="first place")
        return [self._at(mover, moment, place, (lives, number), at_end) for place in (first, last)]

    def _at(self, mover: Mover, moment: Moment, place: Operand, counters: tuple[Operand, Operand], at_end: Column) -> Operand:
        """Write W at a place of a cell: its end is drawn, and parts of it are halved until one begins there."""
        builder, (lives, number) = moment.builder, counters
        low, high = (builder.call(basic.copy_number, end, name=name) for end, name in ((NOUGHT, "low"), (END, "high")))
        below, above = (builder.call(basic.copy_vector, end, name=name) for end, name in ((ZERO, "below"), (at_end, "above")))
        parting = builder.call(wiener.is_inside, place, END, name="parting")
        inner = builder.loop(parting, wiener.MOST_HALVINGS, builder.note)
        within = replace(moment, builder=inner)
        parted, word = inner.call(wiener.middle, low, high, lives, name="parted word")
        into = (low, high, below, above)
        inner.call(wiener.halve, *into, parted, self._draw(mover, within, word, number), place, into=into)
        inner.call(basic.is_less, low, place, into=parting)
        found: Operand = builder.call(wiener.found, place, below, at_end, END, name="W")
        return found
