"""The plots of a study as one picture, drawn by matplotlib (the extra `study`): for papers and slides."""

from __future__ import annotations

import math
from importlib import import_module
from io import BytesIO
from typing import Any

from graphfx.errors import UsageError, how_to_install
from graphfx.study.candidates import FAMILIES
from graphfx.study.recommend import advice, length
from graphfx.study.study import Study, quartiles
from graphfx.study.style import COLOURS

INCHES, DOTS = (12.0, 5.2), 150
MARKERS = ("o", "s", "^", "D", "v", "p", "*")


def need_matplotlib() -> None:
    """Raise UsageError where matplotlib is not there, before any work."""
    try:
        import_module("matplotlib.figure")
    except Exception as error:  # libraries of other versions make it fail in many ways
        raise UsageError(f"--png needs matplotlib, {how_to_install(error, 'study')}") from error


def picture(study: Study) -> bytes:
    """Return a PNG with the 95th percentile of the errors against run time and against evaluations."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=INCHES, layout="constrained")
    FigureCanvasAgg(figure)
    figure.suptitle(f"{study.flat.name}: position error, 95th percentile (tolerance {length(study.tolerance)})")
    time, evaluations = figure.subplots(1, 2, sharey=True)
    _draw(study, time, True)
    _draw(study, evaluations, False)
    time.set(xlabel="processor time of a run [s]", ylabel="error [m]")
    evaluations.set(xlabel="evaluations of each moving particle in a frame")
    if evaluations.get_legend_handles_labels()[0]:
        evaluations.legend(fontsize=8)
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=DOTS)
    return stream.getvalue()


def _draw(study: Study, axes: Any, timed: bool) -> None:
    best = advice(study).result
    floor = study.truth.difference.p95 if study.truth is not None else 0.0
    for number, family in enumerate(FAMILIES):
        for precision in (64, 32):
            results = [each for each in study.of(family.name, precision) if math.isfinite(each.errors.p95)]
            if not results:
                continue
            work = [quartiles(each.seconds)[1] if timed else each.evaluations for each in results]
            errors = [max(each.errors.p95, floor, 1e-300) for each in results]
            axes.plot(work, errors, "-" if precision == 64 else "--", color=COLOURS[number][0], marker=MARKERS[number],
                      fillstyle="full" if precision == 64 else "none", label=f"{family.name}, {precision} bits")
            axes.plot([w for w, each in zip(work, results, strict=True) if each is best],
                      [e for e, each in zip(errors, results, strict=True) if each is best],
                      "o", color="black", fillstyle="none", markersize=14)
    axes.set(xscale="log", yscale="log")
    axes.axhline(study.tolerance, color="black", linestyle="--", linewidth=1)
    if floor > 0:
        axes.axhspan(axes.get_ylim()[0], floor, color="grey", alpha=0.2)
    axes.grid(True, which="major", alpha=0.3)
