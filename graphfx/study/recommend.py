"""Recommend a setting: the one of fewest evaluations that keeps the tolerance, with the reason."""

from __future__ import annotations

from dataclasses import dataclass

from graphfx.study.candidates import FAMILIES
from graphfx.study.films import picture_errors
from graphfx.study.study import BASELINE, Result, Study, quartiles

ENOUGH = 3
"""Runs of a setting from which on run times are compared."""
SURELY = 0.8
"""How much less the greater times of a quicker setting are than the lesser ones of another."""


@dataclass(frozen=True)
class Advice:
    """A setting, or None where none can be recommended, and why."""

    result: Result | None
    reason: str


def length(value: float) -> str:
    """Return a length in metres, as one says an error: `2.1e-4 m`."""
    if value == float("inf"):
        return "infinite"
    return f"{value:.1e} m".replace("e-0", "e-").replace("e+0", "e+") if value else "0 m"


def advice(study: Study) -> Advice:
    """Return what is recommended for a graph."""
    truth, tolerance = study.truth, study.tolerance
    if truth is None:
        return Advice(None, "nothing can be recommended: the references are not made")
    if truth.until is None:
        return Advice(None, "nothing can be recommended: the references disagree from the first frame on, so nobody knows "
                            "what is right; a greater time.tolerance, or a less chaotic graph, can be studied")
    if not truth.particles:
        return Advice(None, "nothing can be recommended: there is no particle at the frames that were compared")
    ran = [each for each in study.results if not each.message]
    if not ran:
        return Advice(None, "nothing can be recommended: no setting was tried in the time that there was; --seconds allows more")
    good = sorted((each for each in ran if keeps(each, tolerance)), key=cost)
    if not good:
        nearest = min(ran, key=lambda each: (not each.sound, each.errors.p95))
        known = f"the nearest is {nearest.candidate.name} with {length(nearest.errors.p95)}"
        return Advice(None, f"no setting keeps 95 % of the errors within {length(tolerance)} and loses no particle; {known}")
    best = good[0]
    cheaper = [each for each in ran if cost(each)[:1] < cost(best)[:1] and each.candidate.family == best.candidate.family
               and each.candidate.precision == best.candidate.precision]
    reason = (f"95 % of its errors are below {length(best.errors.p95)}, within the tolerance of {length(tolerance)}, for "
              f"{best.evaluations:.3g} evaluations of each moving particle in a frame: the fewest of the {len(good)} settings "
              f"that keep it, of {len(ran)} tried")
    if cheaper:
        next_ = max(cheaper, key=cost)
        reason += f"; with {next_.candidate.setting} they would be {length(next_.errors.p95)}"
    if best.candidate.tolerance not in (None, tolerance):
        reason += (f"; its tolerance of {best.candidate.setting} is what each particle's steps may err in a second, and takes "
                   f"the place of the graph's, which these errors were held to")
    return Advice(best, reason + _quicker(best, good))


def _quicker(best: Result, good: list[Result]) -> str:
    """Return what is said of a setting that keeps the tolerance in surely less run time: no quartiles overlap."""
    quickest = min(good, key=lambda each: quartiles(each.seconds)[1])
    (_, middle, high), (low, other, _) = quartiles(quickest.seconds), quartiles(best.seconds)
    if len(quickest.seconds) < ENOUGH or len(best.seconds) < ENOUGH or not high < low * SURELY:
        return ""
    share = f"{middle / other:.2g} times its run time here"
    return f"; {quickest.candidate.name} took {share}, for {quickest.evaluations:.3g} evaluations"


def by_reason(study: Study) -> dict[str, list[str]]:
    """Return what was left out by the reason."""
    found: dict[str, list[str]] = {}
    for what, why in study.left_out:
        found.setdefault(why, []).append(what)
    return found


def compare_pictures(study: Study) -> None:
    """Compare pictures of the last frame: of the graph as it is, as recommended, and by the scheme of the paper."""
    time, best = study.flat.time, advice(study).result
    others = [*([best] if best else []), *study.of(BASELINE, time.precision)[:1]]
    times = {"the graph as it is": time} | {each.candidate.name: each.candidate.time(time) for each in others}
    study.pictures = picture_errors(study.flat, study.frames[-1], times)


def keeps(result: Result, tolerance: float) -> bool:
    """Return whether a setting keeps the tolerance, and loses no particle."""
    return result.sound and result.errors.p95 <= tolerance


def cost(result: Result) -> tuple[float, int, int, float]:
    """Return what settings are ordered by: evaluations to two digits, then bits, then the order of the table, then run time."""
    family = result.candidate.family
    return float(f"{result.evaluations:.2g}"), result.candidate.precision, FAMILIES.index(family), quartiles(result.seconds)[1]
