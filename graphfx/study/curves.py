"""The lines of a study's plots: error against run time, against evaluations, and along the shot."""

from __future__ import annotations

from collections.abc import Callable

from graphfx.motion.clock import Clock
from graphfx.study.candidates import FAMILIES, Family
from graphfx.study.errors import Errors
from graphfx.study.plot import LENGTHS, MARKERS, TIMES, Line, Plot, Point
from graphfx.study.recommend import advice, length
from graphfx.study.study import Result, Study, quartiles

STATISTICS: dict[str, Callable[[Errors], float]] = {
    "p95": lambda errors: errors.p95,
    "median": lambda errors: errors.median,
    "RMS": lambda errors: errors.rms,
    "greatest": lambda errors: errors.greatest,
}
WHAT = {"p95": "95th percentile", "median": "median", "RMS": "root mean square", "greatest": "greatest error"}
MARKER_OF = dict(zip((family.name for family in FAMILIES), MARKERS, strict=True))


def style_of(family: Family) -> str:
    """Return the class of a family in the page's style."""
    return f"f{FAMILIES.index(family)}" if family in FAMILIES else "own"


def _families(study: Study) -> list[tuple[Family, int, list[Result]]]:
    found: dict[tuple[Family, int], list[Result]] = {}
    for result in study.results:
        if not result.message:
            found.setdefault((result.candidate.family, result.candidate.precision), []).append(result)
    return [(family, precision, results) for (family, precision), results in found.items()]


def work_precision(study: Study, statistic: str, timed: bool) -> Plot:
    """Return the plot of one statistic of the errors against run time, or against evaluations."""
    assert study.truth is not None
    value, floor = STATISTICS[statistic], STATISTICS[statistic](study.truth.difference)
    best = advice(study).result

    def point(result: Result) -> Point:
        low, middle, high = quartiles(result.seconds) if timed else (result.evaluations,) * 3
        error = value(result.errors)
        told = length(error) if error > floor else f"at most {length(floor)}"
        work = f"{1000 * middle:.0f} ms" if timed else f"{middle:.3g} evaluations a frame"
        return Point(middle, error, f"{result.candidate.name}: {told}, {work}", low, high, result is best)

    lines = [Line(f"{style_of(family)} b{precision}", MARKER_OF[family.name], [point(each) for each in results], precision == 32)
             for family, precision, results in _families(study)]
    across = "processor time of a run" if timed else "evaluations of each moving particle in a frame"
    title = f"Position error ({WHAT[statistic]}) against {'run time' if timed else 'evaluations'}"
    description = (f"A line for each method; logarithmic axes. Below and to the left is better. The tolerance is "
                   f"{length(study.tolerance)}. All numbers are in the table below.")
    name = f"{statistic}-{'time' if timed else 'evaluations'}"
    return Plot(name, title, description, across, lines, study.tolerance, floor, TIMES if timed else {})


def along_the_shot(study: Study) -> Plot:
    """Return the plot of the 95th percentile at each frame: of the graph as it is, of what is recommended, and of `sims`."""
    assert study.truth is not None
    best, clock = advice(study).result, Clock(study.flat.time.fps, study.flat.time.first)
    baseline = next(iter(study.of("sims", 32) or study.of("sims", 64)), None)
    lines = []
    for result, style, marker in ((baseline, "sims", "star"), (study.own, "own", "diamond"), (best, "best", "circle")):
        if result is not None and not result.message:
            points = [Point(clock.time_of(frame), error, f"{result.candidate.name}, frame {frame}: {length(error)}")
                      for frame, error in result.by_frame.items()]
            lines.append(Line(style, marker, points))
    return Plot("shot", "Position error along the shot", "The 95th percentile of the position error at each frame that is "
                "compared, on a logarithmic axis, against the time of the frame.", "time in the shot [s]", lines,
                study.tolerance, study.truth.difference.p95, linear_x=True)


__all__ = ["LENGTHS", "STATISTICS", "WHAT", "along_the_shot", "style_of", "work_precision"]
