"""Study a graph: what each method makes of it, and at what cost, against what two references agree on.

All settings run over the same sample of particles, in one process and on one thread. The cheapest setting of each family
goes first, so that when time runs out the dearest are left out. Then they run again, in turn, the quickest of them if there is
not time for all: what disturbs the machine disturbs all of them alike.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from graphfx.cook.pilot import choices_for
from graphfx.cook.sample import Sample
from graphfx.cook.trial import States, Trials, sample_of, spread_frames
from graphfx.errors import GraphfxError
from graphfx.graph.flat import FlatGraph
from graphfx.plan.make import make_plan
from graphfx.study.candidates import FAMILIES, PRECISIONS, Candidate, Family, candidates
from graphfx.study.errors import Errors, observed_order
from graphfx.study.films import PictureError
from graphfx.study.reference import Truth, references, truth_of
from graphfx.study.stiffness import Scene, Stiffness

PARTICLES, FRAMES, SECONDS = 1000, 24, 60.0
"""What a study takes, unless told: particles of each source, frames compared, seconds of processor time."""
MOST_REPEATS = 5
DEAREST = 0.1
"""The share of a study's time that no single run may be expected to take."""
MORE = 1.1
"""What evaluations must grow by for an error that does not shrink to count as the least there is."""
BETTER = 0.9
"""What an error must fall to, over two smaller tolerances, for still smaller ones to be tried."""
BASELINE = "sims"
"""The family to whose run of one step, of the same precision and round, run times are told as ratios."""


@dataclass
class Result:
    """What one setting came to. `message` says why it could not run; `seconds` [s] are those of each round."""

    candidate: Candidate
    methods: tuple[str, ...] = ()
    reasons: dict[str, str] = field(default_factory=dict)
    """How the motion of each source is computed, and why, as the plan says it."""
    errors: Errors = field(default_factory=Errors)
    by_frame: dict[int, float] = field(default_factory=dict)
    """The 95th percentile of the distances at each frame [m]."""
    evaluations: float = 0.0
    seconds: list[float] = field(default_factory=list)
    capped: int = 0
    restless: int = 0
    message: str = ""
    last: dict[str, States] = field(default_factory=dict)
    """The states at the last frame that is compared, by source."""
    energy: dict[str, float] = field(default_factory=dict)
    """The RMS of the energy that was made or lost by then, over the mean kinetic energy, by source."""

    @property
    def sound(self) -> bool:
        """Return whether it ran, and lost no particle."""
        return not self.message and self.errors.failures == 0 and self.capped == 0


@dataclass
class Study:
    """All that was found. `left_out` says what was not tried, and why; `orders` are by family and precision."""

    flat: FlatGraph
    frames: list[int]
    particles: dict[str, int] = field(default_factory=dict)
    truth: Truth | None = None
    results: list[Result] = field(default_factory=list)
    own: Result | None = None
    """The graph as it is."""
    left_out: list[tuple[str, str]] = field(default_factory=list)
    reached: list[Stiffness] = field(default_factory=list)
    """What the operators reach."""
    conserved: list[str] = field(default_factory=list)
    """Sources of which energy is defined, and kept."""
    pictures: list[PictureError] = field(default_factory=list)
    """Where they were compared."""
    stopped: bool = False

    @property
    def tolerance(self) -> float:
        """Return the graph's tolerance [m]."""
        return self.flat.time.tolerance

    def of(self, family: str, precision: int) -> list[Result]:
        """Return the results of a family that ran, the cheaper first."""
        return [each for each in self.results if (each.candidate.family.name, each.candidate.precision) == (family, precision)
                and not each.message]

    def order(self, family: str, precision: int) -> float | None:
        """Return the order that the errors of a family show: against steps, or against evaluations where it chooses its steps."""
        if self.truth is None:
            return None
        found = self.of(family, precision)
        work, errors = [each.evaluations for each in found], [each.errors.p95 for each in found]
        rounding = 30 * self.truth.extent * 2.0 ** (-24 if precision == 32 else -53)
        return observed_order(work, errors, max(3 * self.truth.difference.p95, rounding), self.truth.extent / 10)

    def ratios(self, result: Result) -> list[float]:
        """Return the run times of a setting over those of `BASELINE` of one step, in the same rounds."""
        for base in self.of(BASELINE, result.candidate.precision):
            if base.candidate.steps == 1:
                return [one / other for one, other in zip(result.seconds, base.seconds, strict=False)]
        return []


@dataclass
class Maker:
    """Makes a study. `tell` is given what is done now, and how much of all, from 0 to 1."""

    flat: FlatGraph
    most: int = PARTICLES
    frames: Sequence[int] | None = None
    seconds: float = SECONDS
    precisions: tuple[int, ...] = PRECISIONS
    repeats: int = MOST_REPEATS
    tell: Callable[[str, float], None] = lambda what, share: None
    trials: list[tuple[Result, Trials]] = field(default_factory=list)

    def make(self) -> Study:
        """Study the graph; what is stopped by Ctrl-C keeps what is done."""
        time_ = self.flat.time
        study = Study(self.flat, spread_frames(self.frames or range(time_.first, time_.last + 1), FRAMES))
        try:
            self._measure(study)
        except KeyboardInterrupt:
            study.stopped = True
            study.left_out.append(("the rest", "it was stopped"))
        return study

    def _measure(self, study: Study) -> None:
        flat, begun = self.flat, time.process_time()
        self.tell("choosing particles", 0.0)
        sample = sample_of(flat, self.most, max(study.frames))
        study.particles = {path: len(chosen) for path, chosen in sample.ordinals.items()}
        both = references(flat, sample, study.frames, lambda name: self.tell(f"reference: {name}", 0.0))
        study.truth = truth_of(*both, study.frames, flat.time.tolerance)
        if study.truth.until is None:
            study.left_out.append(("all settings", "the references disagree from the first frame on"))
            return
        study.frames = [frame for frame in study.frames if frame <= study.truth.until]
        self.tell("the graph as it is", 0.0)
        own = Candidate(Family("the graph as it is", flat.time.method), flat.time.precision, flat.time.substeps)
        study.own = self._tried(study, own, flat, sample)
        try:
            for candidate, share in self._affordable(study, begun):
                self.tell(candidate.name, share)
                self._try(study, candidate, sample)
            self.tell("rates and energy", 1.0)
            self._look(study, sample)
            self._repeat(study, begun)
        finally:
            study.results.sort(key=lambda each: (each.candidate.precision, FAMILIES.index(each.candidate.family)))

    def _affordable(self, study: Study, begun: float) -> Iterator[tuple[Candidate, float]]:
        """Yield the settings, the cheapest of each family first, as long as there is time; then say what was left out."""
        waiting = by_rank(list(candidates(self.precisions)))
        refused: set[tuple[Family, int]] = set()
        late: dict[str, list[str]] = {}
        for number, candidate in enumerate(waiting):
            if (candidate.family, candidate.precision) in refused:
                continue
            if time.process_time() - begun > self.seconds:
                late.setdefault(candidate.family.name, []).append(f"{candidate.setting} ({candidate.precision} bits)")
                continue
            before = len(study.left_out), len(study.results)
            yield candidate, number / len(waiting)
            unplanned = len(study.results) > before[1] and study.results[-1].message
            if len(study.left_out) > before[0] or unplanned or self._says_no_more(study, candidate):
                refused.add((candidate.family, candidate.precision))
        for family, names in late.items():
            study.left_out.append((f"{family}, {', '.join(names)}", "there was no time left; more of it: --seconds"))

    def _says_no_more(self, study: Study, candidate: Candidate) -> bool:
        """Tell whether the smaller tolerances of a family are left out after one, and say why."""
        found = study.of(candidate.family.name, candidate.precision)
        if candidate.tolerance in (None, *candidate.family.tolerances[-1:]) or len(found) < 2:
            return False
        before, last = found[-2:]
        what = f"{candidate.family.name} below {candidate.setting}, {candidate.precision} bits"
        if last.evaluations > before.evaluations and last.seconds[0] ** 2 / before.seconds[0] > DEAREST * self.seconds:
            study.left_out.append((what, f"a run takes {last.seconds[0]:.1f} s already; --seconds allows more"))
            return True
        if len(found) > 2 and last.evaluations > MORE * found[-3].evaluations and last.errors.p95 > BETTER * found[-3].errors.p95:
            study.left_out.append((what, "two smaller tolerances before took more work and gave no smaller error"))
            return True
        return False

    def _try(self, study: Study, candidate: Candidate, sample: Sample) -> None:
        """Run a setting once and keep what it came to, or why it did not run."""
        result = self._tried(study, candidate, candidate.flat(self.flat), sample)
        if result.message or candidate.family.method in result.methods:
            study.results.append(result)
            return
        runs = " and ".join(result.methods)
        study.left_out.append((f"{candidate.family.name}, {candidate.precision} bits", f"in this graph it is the same as {runs}"))

    def _tried(self, study: Study, candidate: Candidate, flat: FlatGraph, sample: Sample) -> Result:
        """Run a graph once and return what it came to; not where the plan takes another method than the setting's."""
        result = Result(candidate)
        assert study.truth is not None
        try:
            trials = Trials(flat, sample, choices=choices_for(make_plan(flat)))
            result.reasons = {path: f"{emitter.method}; {emitter.reason}" for path, emitter in trials.plan.emitters.items()}
            result.methods = tuple(sorted({emitter.method for emitter in trials.plan.emitters.values()}))
            if candidate.family in FAMILIES and candidate.family.method not in result.methods:
                return result
            trial = trials.run(study.frames)
        except GraphfxError as error:
            result.message = "; ".join(problem.message for problem in error.problems)
            return result
        distances = study.truth.distances(trial.states)
        result.errors, result.by_frame = distances.errors(study.tolerance), distances.by_frame()
        result.evaluations, result.capped, result.restless = trial.evaluations, trial.failed, trial.restless
        result.last = {path: frames[study.frames[-1]] for path, frames in trial.states.items()}
        result.seconds.append(trial.seconds)
        self.trials.append((result, trials))
        return result

    def _look(self, study: Study, sample: Sample) -> None:
        """Find what the operators reach, and what becomes of energy."""
        scene, last = Scene(self.flat, sample, study.frames[-1]), study.frames[-1]
        assert study.truth is not None
        study.reached = scene.reached
        study.conserved = [path for path in scene.conserved() if path in study.truth.states]
        for result in [*study.results, *([study.own] if study.own else [])]:
            if not result.message:
                result.energy = {path: scene.drift(path, study.truth.states[path][last], result.last[path])
                                 for path in study.conserved}

    def _repeat(self, study: Study, begun: float) -> None:
        """Run the settings again, in turn, for their run times: in what time is left, the quickest of them."""
        allowed = (self.seconds - (time.process_time() - begun)) / max(self.repeats - 1, 1)
        quickest = sorted(self.trials, key=lambda each: each[0].seconds[0])
        sums = np.cumsum([result.seconds[0] for result, _ in quickest])
        again = {id(result) for (result, _), sum_ in zip(quickest, sums, strict=True) if sum_ <= allowed}
        for number in range(2, self.repeats + 1):
            for result, trials in self.trials:
                if id(result) in again:
                    self.tell(f"run times, round {number}: {result.candidate.name}", number / self.repeats)
                    result.seconds.append(trials.run(study.frames).seconds)


def by_rank(all_of_them: list[Candidate]) -> list[Candidate]:
    """Return settings with the first of each family and precision first, then the second ones, and so on."""
    ranks: dict[tuple[str, int], int] = {}
    ranked = []
    for candidate in all_of_them:
        key = candidate.family.name, candidate.precision
        ranked.append((ranks.setdefault(key, 0), candidate))
        ranks[key] += 1
    return [candidate for _, candidate in sorted(ranked, key=lambda each: each[0])]


def quartiles(values: Sequence[float]) -> tuple[float, float, float]:
    """Return the first quartile, the median and the third quartile of some numbers; nothing measured is nan."""
    if not values:
        return float("nan"), float("nan"), float("nan")
    low, middle, high = np.quantile(values, [0.25, 0.5, 0.75])
    return float(low), float(middle), float(high)
