"""Write steps of a particle's own length: taken, judged by their errors, and taken again where they were too long."""

from __future__ import annotations

from dataclasses import dataclass

from graphfx.motion import basic, pacing
from graphfx.plan.moment import State
from graphfx.plan.scheme import Scheme, put_back
from graphfx.program import Builder, Column, Operand, Uniform, constant_number

MOST_TURNS = 64
"""Steps that one run takes, refused ones too; who is not at the end then is gathered with its like for another run."""
FIRST_TURNS = 8
"""Steps that the first run of a frame takes, in which long and short ones lie side by side: who needs more leaves it early."""
ALLOWED = "allowed turns"
"""The number of steps that a run takes, as it is handed over."""
SHARE = "step share"
"""The column that remembers how long a particle's steps are."""
FINEST = {32: 2.0**-20, 64: 2.0**-40}
"""The least share of the longest step."""
RESOLUTION = {32: 2.0**-21, 64: 2.0**-50}
"""Four units in the last place."""


@dataclass
class Pacing:
    """The columns of one program: `share` of the longest step, `waiting` for another run, `failed` to find a step short
    enough; `turns` and `contacts` count."""

    scheme: Scheme
    longest: Uniform
    share: Column
    waiting: Column
    failed: Column
    turns: Column
    contacts: Column
    precision: int
    most_contacts: int = 0

    @classmethod
    def begin(cls, builder: Builder, scheme: Scheme, longest: Uniform, precision: int, most_contacts: int) -> Pacing:
        """Load what was kept from before; `most_contacts` of a particle are allowed in a frame (0: there are no surfaces)."""
        share = builder.load(SHARE, "float")
        builder.call(pacing.share_of, share, into=share)
        waiting, failed = (builder.call(basic.but_not, builder.mask, builder.mask, name=name) for name in ("waiting", "failed"))
        zero = Uniform("0", "float", 0.0)
        turns = builder.call(basic.copy_number, zero, name="turns")
        contacts = builder.load("contacts", "float")
        return cls(scheme, longest, share, waiting, failed, turns, contacts, precision, most_contacts)

    def going(self, builder: Builder) -> Column:
        """Write who is neither waiting nor at the end of its means."""
        out = builder.call(basic.either, self.waiting, self.failed, name="out")
        going: Column = builder.call(basic.but_not, builder.mask, out, name="going")
        if self.most_contacts:
            going = builder.call(basic.both, going, builder.call(basic.is_less, self.contacts, self._most), name="going")
        return going

    def has_turns(self, builder: Builder, allowed: Uniform) -> Column:
        """Write who may take another step in this run."""
        found: Column = builder.call(basic.is_less, self.turns, allowed, name="soon")
        return found

    @property
    def _most(self) -> Uniform:
        return Uniform(str(self.most_contacts), "float", float(self.most_contacts))

    def restless(self, builder: Builder) -> Column:
        """Write who has met surfaces so often that it is to rest."""
        few = builder.call(basic.is_less, self.contacts, self._most, name="few contacts")
        found: Column = builder.call(basic.but_not, builder.mask, few, name="unfinished")
        return found

    def limit(self, builder: Builder, step: Column) -> Column:
        """Write the next step: as long as the particle's are, but not beyond `step`."""
        one = Uniform("1", "float", 1.0)
        builder.call(basic.sum_of_numbers, self.turns, one, into=self.turns)
        longest = builder.call(pacing.part_of, self.share, self.longest, name="longest")
        limited: Column = builder.call(basic.earlier, step, longest, name="step")
        return limited

    def judge(
        self, builder: Builder, state: State, first: dict[str, Column], step: Column, errors: dict[str, Operand]
    ) -> Builder:
        """Write who may keep its step, and return the builder under those; the others go back, their `step` is 0."""
        builder.note = "judge the step"
        zero = Uniform("(0, 0, 0)", "vec3", (0.0, 0.0, 0.0))
        error = builder.call(
            pacing.size_of_error, errors.get("position", zero), errors.get("velocity", zero), self.longest, name="error"
        )
        tolerance = constant_number(self.scheme.tolerance)
        resolution = Uniform("4 eps", "float", RESOLUTION[self.precision])
        velocity = state.velocity or zero
        hidden = builder.call(
            pacing.hidden_error, state.position, velocity, self.longest, self.share, resolution, name="hidden"
        )
        finest = constant_number(FINEST[self.precision])
        steep = constant_number(self.scheme.steep)
        accepted, fails, share = Column("accepted", "bool"), Column("fails", "bool"), self.share
        builder.call(
            pacing.judged, error, hidden, tolerance, step, self.longest, share, finest, steep, into=(accepted, fails, share)
        )
        everywhere = builder.under(builder.program.context)
        everywhere.call(basic.either, self.failed, fails, into=self.failed)
        refused = builder.under(builder.call(basic.but_not, builder.mask, accepted, name="refused"))
        put_back(refused, state, first)
        refused.call(basic.difference, step, step, into=step)
        return builder.under(builder.call(basic.both, builder.mask, accepted, name="kept"))

    def meet(self, builder: Builder, met: Column) -> None:
        """Count a contact."""
        builder.under(met).call(basic.sum_of_numbers, self.contacts, Uniform("1", "float", 1.0), into=self.contacts)

    @property
    def stores(self) -> dict[str, Column]:
        """Return the columns by the names under which a run hands them over, or keeps them."""
        return {
            SHARE: self.share, "waiting": self.waiting, "failed": self.failed, "turns": self.turns, "contacts": self.contacts,
        }  # fmt: skip
