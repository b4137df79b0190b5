"""The settings that a study tries: one table of families of methods, each with its steps or its tolerances."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields, replace

from graphfx.graph.flat import FlatGraph, TimeSettings

STEPS = (1, 2, 4, 8, 16, 32)
"""Steps of a frame."""
TOLERANCES = tuple(10.0**-k for k in range(1, 10))
"""Tolerances of methods that choose their steps [m]."""
COARSE = TOLERANCES[::2]
PRECISIONS = (32, 64)


@dataclass(frozen=True)
class Family:
    """A method of the language, of one order where it has several, and what is varied: steps a frame, or tolerances [m]."""

    name: str
    method: str
    steps: tuple[int, ...] = ()
    tolerances: tuple[float, ...] = ()
    order: int | None = None


FAMILIES = (
    Family("exact", "exact", STEPS),
    Family("strang", "strang", STEPS),
    Family("adaptive 4", "adaptive", (), COARSE, 4),
    Family("adaptive 6", "adaptive", (), TOLERANCES, 6),
    Family("adaptive 8", "adaptive", (), COARSE, 8),
    Family("rk45", "rk45", (), COARSE),
    Family("sims", "sims", STEPS),
)


@dataclass(frozen=True)
class Candidate:
    """One setting: a family with steps a frame or a tolerance [m], and the bits of a number."""

    family: Family
    precision: int
    steps: int = 1
    tolerance: float | None = None

    @property
    def setting(self) -> str:
        """Return what is varied, in words: `4 steps`, `1e-3 m`."""
        if self.tolerance is not None:
            return f"{self.tolerance:.0e} m".replace("e-0", "e-")
        return f"{self.steps} step{'' if self.steps == 1 else 's'}"

    @property
    def name(self) -> str:
        """Return the whole setting in words."""
        return f"{self.family.name}, {self.setting}, {self.precision} bits"

    def time(self, time: TimeSettings) -> TimeSettings:
        """Return the time settings of a graph under this candidate."""
        return settings(time, self.family.method, self.precision, self.steps, self.tolerance, self.family.order)

    def flat(self, flat: FlatGraph) -> FlatGraph:
        """Return a graph under this candidate."""
        return replace(flat, time=self.time(flat.time))

    def document(self) -> dict[str, object]:
        """Return the keys of `time` in a graph that ask for this setting, whatever others it has."""
        found: dict[str, object] = {"method": self.family.method, "precision": self.precision, "substeps": self.steps}
        if self.tolerance is None:
            return found
        return found | {"tolerance": self.tolerance} | ({"order": self.family.order} if self.family.order else {})


def settings(
    time: TimeSettings, method: str, precision: int, steps: int = 1, tolerance: float | None = None, order: int | None = None
) -> TimeSettings:
    """Return time settings with another method."""
    changed = {"method": method, "precision": precision, "substeps": steps}
    if tolerance is not None:
        changed["tolerance"] = tolerance  # type: ignore[assignment]
    if order is not None and "order" in {each.name for each in fields(TimeSettings)}:
        changed["order"] = order
    return replace(time, **changed)  # type: ignore[arg-type]


def candidates(precisions: tuple[int, ...] = PRECISIONS) -> Iterator[Candidate]:
    """Yield all settings, the cheaper of a family first."""
    for precision in precisions:
        for family in FAMILIES:
            yield from (Candidate(family, precision, steps) for steps in family.steps)
            yield from (Candidate(family, precision, 1, tolerance) for tolerance in family.tolerances)
