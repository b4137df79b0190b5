"""Write one step as a scheme: equal symmetric steps, alone or extrapolated to a higher order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphfx.motion import basic, pacing
from graphfx.plan.moment import ZERO, Moment, State
from graphfx.program import Builder, Column, Operand, constant_number

COUNTS = {4: (1, 2), 6: (1, 2, 3), 8: (1, 2, 3, 4)}
"""Numbers of equal steps that are extrapolated, by the order that results."""


@dataclass(frozen=True)
class Scheme:
    """How a step is taken: in `counts` equal symmetric steps; of several counts the results are extrapolated.

    `tolerance` is the error allowed in each second of motion where particles have steps of their own [m/s], else 0.
    `runge_kutta` takes rates of the whole motion at seven instants in place of all that.
    """

    counts: tuple[int, ...] = (1,)
    tolerance: float = 0.0
    runge_kutta: bool = False

    @property
    def paced(self) -> bool:
        """Return whether each particle has steps of its own length, by their errors."""
        return self.tolerance > 0

    @property
    def evaluations(self) -> int:
        """Return how often forces are evaluated in a step."""
        return 7 if self.runge_kutta else sum(self.counts)

    @property
    def steep(self) -> float:
        """Return by how much the error, against what is allowed, shrinks as a step is halved."""
        return 16.0 if self.runge_kutta else float(2 ** (2 * len(self.counts) - 2))


SIMPLE = Scheme()


def kept_state(builder: Builder, state: State) -> dict[str, Column]:
    """Keep what of a particle's state changes."""
    parts = {"position": state.position, "velocity": state.velocity}
    return {
        name: builder.call(basic.copy_vector, part, name=f"first {name}")
        for name, part in parts.items()
        if isinstance(part, Column)
    }


def put_back(builder: Builder, state: State, kept: dict[str, Column]) -> None:
    """Go back to a state that was kept."""
    for name, column in kept.items():
        builder.call(basic.copy_vector, column, into=state.read(name))  # type: ignore[arg-type]


def write_scheme(
    scheme: Scheme, moment: Moment, state: State, write: Callable[[Moment, State], None]
) -> dict[str, Operand] | None:
    """Write a step in place, by `write` for each symmetric one; return the estimated errors of what was extrapolated."""
    if scheme.counts == (1,):
        write(moment, state)
        return None
    builder = moment.builder
    first = kept_state(builder, state) if len(scheme.counts) > 1 else {}
    found: list[dict[str, Column]] = []
    for count in scheme.counts:
        if found:
            put_back(builder, state, first)
        for number in range(count):
            write(moment.part(number, count), state)
        if count != scheme.counts[-1]:
            found.append(kept_state(builder, state))
    if not found:
        return None
    return _extrapolate(builder, scheme.counts, state, found)


def _extrapolate(builder: Builder, counts: tuple[int, ...], state: State, found: list[dict[str, Column]]) -> dict[str, Operand]:
    """Write the combination of the results of fewer steps with the last, which `state` holds; return the errors."""
    values, errors = pacing.weights_of(counts)
    builder.note = "extrapolate"
    wrong: dict[str, Operand] = {}
    for name in found[0]:
        into = state.read(name)
        assert isinstance(into, Column)
        last = builder.call(basic.copy_vector, into, name=f"last {name}")
        error = builder.call(basic.copy_vector, ZERO, name=f"error of {name}")
        for row, value, difference in zip(found, values, errors, strict=True):
            builder.call(pacing.corrected, into, last, row[name], constant_number(value), into=into)
            builder.call(pacing.corrected, error, last, row[name], constant_number(difference), into=error)
        wrong[name] = error
    return wrong
