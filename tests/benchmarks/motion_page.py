"""The rows of `motion.py` as lines of a terminal, and as a page."""

from __future__ import annotations

import datetime
import importlib.metadata
import math
import os
import platform
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import graphfx


@dataclass(frozen=True)
class Row:
    """One contender on one problem at one tolerance [m]; `seconds` by particle and simulated second, `ratio` to graphfx's.

    graphfx's own row has those of many particles, those of choosing the method, and how the truth is known.
    """

    problem: str
    tolerance: float
    name: str
    setting: str
    error: float
    evaluations: float
    seconds: float
    ratio: float
    many: float = math.nan
    choosing: float = math.nan
    known: str = ""


def _number(value: float, form: str) -> str:
    return "" if math.isnan(value) else format(value, form)


def _rounded(value: float) -> str:
    """Return three digits of a number, never as a power of ten."""
    if math.isnan(value):
        return ""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def _micro(seconds: float) -> str:
    return _rounded(seconds * 1e6)


def row_text(row: Row) -> str:
    """Return a row as a line."""
    head = f"{row.problem:45} {row.tolerance:.0e} {row.name:42} {row.setting:52}"
    numbers = f"{_number(row.error, '.1e'):>8} {_rounded(row.evaluations):>9} {_micro(row.seconds):>9} {_rounded(row.ratio):>8}"
    own = f"  100,000: {_micro(row.many)}; choosing {row.choosing:.1f} s; {row.known}" if row.known else ""
    return f"{head} {numbers}{own}"


def processor() -> str:
    """Return the kind of machine, in general words."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    models = [line.split(":")[1].strip() for line in lines if "model name" in line]
    return f"{models[0] if models else platform.machine()}, {os.cpu_count()} virtual cores"


def versions() -> str:
    """Return the versions of what was measured."""
    found = [f"Python {platform.python_version()}", f"graphfx {graphfx.__version__}"]
    for name in ("numpy", "numba", "scipy", "rebound"):
        try:
            found.append(f"{name} {importlib.metadata.version(name)}")
        except importlib.metadata.PackageNotFoundError:
            found.append(f"no {name}")
    return ", ".join(found)


def aims(rows: list[Row]) -> list[str]:
    """Return how the run stands to the aims."""
    best: list[tuple[float, str]] = []
    behind, unkept, faster = [], [], []
    for (problem, tolerance), group in groupby(rows, key=lambda row: (row.problem, row.tolerance)):
        found, where = list(group), f"{problem} at {tolerance:g} m"
        own = found[0]
        peers = [row.ratio for row in found if row.name.startswith("SciPy") and not math.isnan(row.ratio)]
        if own.error > tolerance:
            unkept.append(f"{where} ({own.error:.1e} m)")
        if peers:
            best.append((min(peers), where))
        if any(row.name == "the paper's scheme" and row.ratio < 1 for row in found):
            behind.append(where)
        faster += [f"{row.name} ({where}, {row.ratio:.2f})" for row in found[1:] if row.ratio < 1]
    least = min(best, default=(math.nan, "none"))
    return [
        f"- The tolerance is kept by graphfx {'everywhere' if not unkept else 'but not in: ' + '; '.join(unkept)}.",
        f"- The best of SciPy takes at least {least[0]:.3g} times as long ({least[1]}); aimed at: 10 times.",
        f"- The paper's scheme is faster {'nowhere' if not behind else 'in: ' + '; '.join(behind)}.",
        f"- All that is faster than graphfx with 2048 particles: {'; '.join(faster) or 'nothing'}.",
    ]


def page(rows: list[Row], shares: list[str]) -> str:
    """Return the page."""
    lines = [
        "# Motion in numbers",
        "",
        "Written by `python tests/benchmarks/motion.py --page tests/benchmarks/motion.md`; do not edit. The error is that of",
        "position which 95 % of particles do not exceed at the end [m]; evaluations are those of the forces, by particle, for",
        "the whole time; µs is CPU time by particle and simulated second, and what follows its ratio to graphfx's. The others",
        "have the cheapest setting that was found to keep the tolerance, and give the last states alone; graphfx gives those of",
        "24 frames a second and chooses for itself, once for a graph, in the seconds told. Settings are tried from the loosest",
        "until one took its particles (2048, or fewer of the slow ones) more than a second of CPU time; then it says: given up.",
        "",
        f"{datetime.date.today()}; {processor()}, one of them used; {versions()}; load {os.getloadavg()[0]:.1f} at the end "
        "(other work beside).",
        "",
        *aims(rows),
    ]
    for problem, group in groupby(rows, key=lambda row: row.problem):
        found = list(group)
        lines += ["", f"## {problem[0].upper()}{problem[1:]}", "", f"Truth: {found[0].known}.", ""]
        lines += ["| tolerance | method | setting | error | evaluations | µs | ratio |", "|---|---|---|---|---|---|---|"]
        for row in found:
            told = row.setting or f"100,000 particles: {_micro(row.many)} µs; chosen in {row.choosing:.1f} s"
            numbers = [_number(row.error, ".1e"), _rounded(row.evaluations), _micro(row.seconds), _rounded(row.ratio)]
            lines.append(f"| {' | '.join([f'{row.tolerance:.0e}', row.name, told, *numbers])} |")
    lines += ["", "## Who needs short steps pays for them alone", "", *(f"- {share}" for share in shares), ""]
    return "\n".join(lines)
