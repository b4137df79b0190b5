"""A study as a table in the terminal."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphfx.study.study import Result, Study

WIDTH = 160
"""Columns that the whole table takes; where the terminal has fewer, less is told."""
HEADS = ("setting", "p95 [m]", "median [m]", "RMS [m]", "max [m]", "over", "failed", "evals/frame", "time [ms]", "quartiles",
         "x sims", "order")
NARROW = ("setting", "p95 [m]", "failed", "evals/frame", "time [ms]", "x sims", "order")


def show_study(study: Study) -> None:
    """Print a study."""
    from rich.console import Console

    console = Console(highlight=False)
    if not console.is_terminal:
        console = Console(highlight=False, width=WIDTH)
    if study.truth is not None and study.truth.until is not None:
        console.print(_table(study, HEADS if console.width >= WIDTH else NARROW))
    for line in lines(study):
        console.print(line, soft_wrap=True, markup=False)


def _table(study: Study, heads: tuple[str, ...]) -> Any:
    from rich import box
    from rich.markup import escape
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, title=escape(_title(study)), title_justify="left", title_style="bold")
    for name in heads:
        table.add_column(escape(name), justify="left" if name == "setting" else "right", no_wrap=True)

    def add(result: Result, name: str, order: str, last: bool) -> None:
        row = dict(zip(HEADS, _row(study, result, name, order), strict=True))
        table.add_row(*(row[head] for head in heads), end_section=last)

    if study.own is not None and not study.own.message:
        add(study.own, "the graph as it is", "", True)
    families = dict.fromkeys((each.candidate.precision, each.candidate.family.name) for each in study.results)
    for precision, family in families:
        found = study.of(family, precision)
        order = study.order(family, precision)
        for number, result in enumerate(found):
            name = f"{family:<11}{result.candidate.setting:<9}{precision} bits"
            add(result, name, "" if number or order is None else f"{order:.1f}", number == len(found) - 1)
    return table


def _title(study: Study) -> str:
    particles = sum(study.particles.values())
    chosen = f"{particles:,} {'birth' if particles == 1 else 'births'}"
    return f"{study.flat.name}: tolerance {study.tolerance:g} m, {chosen}, {len(study.frames)} frames compared"


def _row(study: Study, result: Result, name: str, order: str) -> list[str]:
    from graphfx.study.recommend import keeps
    from graphfx.study.study import quartiles

    errors = result.errors
    floor = study.truth.difference if study.truth is not None else errors
    style = "green" if keeps(result, study.tolerance) else "red" if errors.p95 > study.tolerance else "yellow"
    low, middle, high = (1000 * value for value in quartiles(result.seconds))
    ratio = quartiles(study.ratios(result))[1]
    failed = errors.failures + result.capped
    return [
        name, f"[{style}]{told(errors.p95, floor.p95)}[/]", told(errors.median, floor.median), told(errors.rms, floor.rms),
        told(errors.greatest, floor.greatest), f"{errors.over:,}" if errors.over else "-",
        f"[red]{failed:,}[/]" if failed else "-", f"{result.evaluations:.3g}",
        *((f"{middle:,.0f}", f"{low:,.0f}-{high:,.0f}") if math.isfinite(middle) else ("-", "-")),
        f"{ratio:.2f}" if math.isfinite(ratio) else "-", order,
    ]


def told(value: float, floor: float) -> str:
    """Return an error [m]; what is below the difference of the references is told as that."""
    if not math.isfinite(value):
        return "infinite"
    if value <= floor:
        return f"<={floor:.1e}" if floor else "0"
    return f"{value:.1e}"


def lines(study: Study) -> list[str]:
    """Return what is said below the table."""
    from graphfx.study.recommend import advice, by_reason

    found, truth, own = [], study.truth, study.own
    if own is not None and not own.message:
        found += [f"as it is: {path}: {reason}" for path, reason in own.reasons.items()]
    if truth is not None:
        found.append(f"truth: {truth.references[0].name}")
        checked = f"  checked by {truth.references[1].name}"
        if truth.until is None:
            found.append(f"{checked}: they agree at no frame: the motion is chaotic, or what is looked at once a step decides it")
        else:
            found.append(f"{checked}: they differ by {truth.difference.p95:.1e} m (95th percentile), "
                         f"{truth.difference.greatest:.1e} m at most; no smaller error is measured")
        if truth.chaotic and truth.until is not None:
            found.append(f"  chaotic: the references agree up to frame {truth.until} only, and all is compared up to there")
        if truth.unknown:
            found.append(f"  {truth.unknown:,} of {truth.particles:,} particles are left out where the references differ by more "
                         f"than a tenth of the tolerance")
    found += _stiffness(study)
    found += [f"picture of frame {each.frame}: {each.name}: RMS {each.rms:.2e}, PSNR {each.psnr:.1f} dB"
              for each in study.pictures]
    found += [f"failed: {name}: {message}" for message, name in _messages(study).items()]
    found += [f"left out: {'; '.join(what)}: {why}" for why, what in by_reason(study).items()]
    advised = advice(study)
    name = f"{advised.result.candidate.name}: " if advised.result else ""
    return [*found, f"recommended: {name}{advised.reason}"]


def _stiffness(study: Study) -> list[str]:
    """Return what the operators reach, and where energy is kept."""
    found = []
    for each in study.reached:
        measured = {"w": each.w, "d": each.d, "s": each.s}
        rates = ", ".join(f"{name} h {value:.2g}" for name, value in measured.items() if value > 1e-6)
        strang = "without limit" if each.exact else f"from {each.strang}"
        sims = "never" if each.sims is None else f"from {each.sims}"
        found.append(f"reached: {each.operator} ({each.type}): {rates or 'nothing'}; stable steps a frame: strang {strang}, "
                     f"rk45 from {each.rk45}, sims {sims}")
    if study.conserved:
        found.append(f"energy is kept by {', '.join(study.conserved)}: what settings make or lose of it is on the page")
    return found


def _messages(study: Study) -> dict[str, str]:
    """Return why settings did not run, each with the families that it befell."""
    found: dict[str, str] = {}
    for result in study.results:
        if result.message:
            name = f"{result.candidate.family.name} ({result.candidate.precision} bits)"
            found[result.message] = f"{found[result.message]}, {name}" if result.message in found else name
    return found
