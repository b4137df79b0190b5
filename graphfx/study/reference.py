"""What is taken for the truth: two references of different orders, and how far they can be trusted.

The first is `adaptive` of order 8 at 1e-5 of the graph's tolerance, the second of order 6, both in 64 bits. Where a graph
does not take that method, symmetric steps are extrapolated: their error is a series in h^2, so from runs of m, 2 m and
4 m steps a frame

    P_4 = (4 P_2m - P_m) / 3,    P_6 = (16 P_4(2m, 4m) - P_4(m, 2m)) / 15

are of orders 4 and 6. [Richardson 1911; Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, II.9]

Where the two differ by more than a tenth of the tolerance, nobody knows where a particle is: it is compared only before
that, and all are compared only as long as 95 % of them are known.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from graphfx.cook.matching import keys_of, matched, size
from graphfx.cook.sample import Sample
from graphfx.cook.trial import States, Trial, Trials
from graphfx.errors import GraphfxError
from graphfx.graph.flat import FlatGraph
from graphfx.study.candidates import settings
from graphfx.study.errors import Distances, Errors, StatesByFrame

FINER = 1e-5
"""The tolerance of a reference, as a share of the graph's."""
AGREED = 0.1
"""How far references may differ, as a share of the graph's tolerance."""
KNOWN = 0.95
"""The share of the particles that must be known for a frame to be compared."""
FAR = 1000.0
"""Tolerances within which no particle has escaped, however small the scene is."""
BASE_STEPS = 16
"""The fewest steps a frame of those that are extrapolated."""


@dataclass
class Reference:
    """States by source and frame, and how they were found, in words."""

    name: str
    states: StatesByFrame
    seconds: float = 0.0


@dataclass
class Truth:
    """The known states by source and frame, and by how much two references differ there.

    `until` is the last frame that is compared, None where not even the first can be; `chaotic` tells whether that is before
    the last wanted. `unknown` counts the particles that were left out, wholly or from some frame on, of `particles`.
    `extent` is how far apart their places lie [m], and 1000 tolerances at least.
    """

    references: tuple[Reference, Reference]
    states: dict[str, dict[int, States]] = field(default_factory=dict)
    difference: Errors = field(default_factory=Errors)
    until: int | None = None
    chaotic: bool = False
    unknown: int = 0
    particles: int = 0
    extent: float = 0.0

    def distances(self, states: StatesByFrame) -> Distances:
        """Return how far other states are from these."""
        distances = Distances()
        for source, frames in self.states.items():
            for frame, true in frames.items():
                distances.add(source, frame, true, states[source][frame], self.extent)
        return distances


def references(
    flat: FlatGraph, sample: Sample | None, frames: Sequence[int], tell: Callable[[str], None] = lambda name: None
) -> tuple[Reference, Reference]:
    """Run both references."""
    made = [_adaptive(flat, order, sample, frames, tell) for order in (8, 6)]
    if made[0] is not None and made[1] is not None:
        return made[0], made[1]
    return _extrapolated(flat, sample, frames, tell)


def _adaptive(
    flat: FlatGraph, order: int, sample: Sample | None, frames: Sequence[int], tell: Callable[[str], None]
) -> Reference | None:
    """Run `adaptive` at a fine tolerance; None where the graph does not take it, or it gives up."""
    tolerance = flat.time.tolerance * FINER
    time = settings(flat.time, "adaptive", 64, 1, tolerance, order)
    try:
        trials = Trials(replace(flat, time=time), sample)
        if "adaptive" not in {emitter.method for emitter in trials.plan.emitters.values()}:
            return None
        name = f"adaptive {order} at {tolerance:.0e} m, 64 bits".replace("e-0", "e-")
        tell(name)
        trial = trials.run(frames)
    except GraphfxError:
        return None
    return Reference(name, trial.states, trial.seconds) if not trial.failed else None


def _extrapolated(
    flat: FlatGraph, sample: Sample | None, frames: Sequence[int], tell: Callable[[str], None]
) -> tuple[Reference, Reference]:
    runs: list[Trial] = []
    numbers, method = [BASE_STEPS, 2 * BASE_STEPS, 4 * BASE_STEPS], "strang"
    for steps in numbers:
        trials = Trials(replace(flat, time=settings(flat.time, "strang", 64, steps)), sample)
        method = " and ".join(sorted({emitter.method for emitter in trials.plan.emitters.values()}))
        tell(f"{method} with {steps} steps a frame, 64 bits")
        runs.append(trials.run(frames))
    low = _joined(runs[0].states, runs[1].states, 4.0)
    high = _joined(runs[1].states, runs[2].states, 4.0)
    best = _joined(low, high, 16.0)
    seconds = [trial.seconds for trial in runs]
    told = "steps a frame, extrapolated to order"
    return (
        Reference(f"{method} with {numbers[0]}, {numbers[1]} and {numbers[2]} {told} 6, 64 bits", best, sum(seconds)),
        Reference(f"{method} with {numbers[1]} and {numbers[2]} {told} 4, 64 bits", high, sum(seconds[1:])),
    )


def _joined(coarse: StatesByFrame, fine: StatesByFrame, factor: float) -> dict[str, dict[int, States]]:
    """Return fine + (fine - coarse) / (factor - 1) for the particles that both have."""
    return {source: {frame: _extrapolation(coarse[source][frame], states, factor) for frame, states in frames.items()}
            for source, frames in fine.items()}


def _extrapolation(coarse: States, fine: States, factor: float) -> States:
    rows, others = matched(fine, coarse)
    share = 1 / (factor - 1)
    with np.errstate(invalid="ignore", over="ignore"):
        position = fine.position[rows] + (fine.position[rows] - coarse.position[others]) * share
        velocity = fine.velocity[rows] + (fine.velocity[rows] - coarse.velocity[others]) * share
    return States(fine.ids[rows], fine.lives[rows], position, velocity)


def truth_of(first: Reference, second: Reference, frames: Sequence[int], tolerance: float) -> Truth:
    """Find what both references know."""
    made = Truth((first, second))
    lost: dict[str, set[int]] = {source: set() for source in first.states}
    seen: dict[str, set[int]] = {source: set() for source in first.states}
    distances = Distances()
    for frame in sorted(frames):
        known = {source: _known(first.states[source][frame], second.states[source][frame], tolerance, lost[source])
                 for source in first.states}
        everyone = sum(len(first.states[source][frame]) for source in known)
        if sum(int(each.sum()) for each in known.values()) < KNOWN * everyone:
            made.chaotic = True
            break
        made.until = frame
        for source, each in known.items():
            states = first.states[source][frame]
            seen[source].update(keys_of(states).tolist())
            made.states.setdefault(source, {})[frame] = chosen(states, each)
    for source, by_frame in made.states.items():
        for frame, states in by_frame.items():
            distances.add(source, frame, states, second.states[source][frame], np.inf)
    made.difference = distances.errors(tolerance * AGREED)
    made.particles = sum(map(len, seen.values()))
    made.unknown = sum(len(lost[source] & seen[source]) for source in seen)
    made.extent = max(_extent(made.states), FAR * tolerance)
    return made


def _known(first: States, second: States, tolerance: float, lost: set[int]) -> np.ndarray:
    """Return which particles both references put at one place, now and before; note in `lost` those that are not."""
    rows, others = matched(first, second)
    agree = np.zeros(len(first), bool)
    agree[rows] = size(first.position[rows] - second.position[others]) <= AGREED * tolerance
    keys = keys_of(first)
    agree &= ~np.isin(keys, np.fromiter(lost, np.uint64, len(lost)))
    lost.update(keys[~agree].tolist())
    return agree


def chosen(states: States, which: np.ndarray) -> States:
    """Return some of the particles."""
    return States(states.ids[which], states.lives[which], states.position[which], states.velocity[which])


def _extent(states: StatesByFrame) -> float:
    """Return the diagonal of the box that holds all places [m]."""
    places = [each.position for frames in states.values() for each in frames.values() if len(each)]
    if not places:
        return 0.0
    every = np.concatenate(places)
    return float(np.linalg.norm(every.max(axis=0) - every.min(axis=0)))
