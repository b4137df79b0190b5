"""The results of the stability runs as data, as lines, and as a page: who goes with whom, and what came out."""

from __future__ import annotations

import html
from collections.abc import Iterator
from typing import Any

from graphfx.study.stability import NAMES, STEPS, Case, Stability
from graphfx.study.style import style

SIGNS = {"finite": "&middot;", "infinite": "&infin;", "failed": "!", "refused": "&ndash;", "not_tried": "?", "bug": "NaN"}
ORDER = ("bug", "infinite", "failed", "not_tried", "refused", "finite")
"""Outcomes, the worse first."""
TOLD = 40
"""Combinations of one outcome that are told one by one."""
FIELDS = {
    "graphfx_stability": "the version of this form",
    "steps": "lengths of a step that were tried [s]",
    "outcomes": "what can come out, in words",
    "counts": "how many runs came out how",
    "operators": "those that were tried",
    "left_out": "those that were not, with the reason",
    "runs": "runs that did not end finite",
    "runs[].operators": "names",
    "runs[].parameters": "which parameters stood at which ends, for each operator",
    "runs[].method": "what was asked for: strang is exact wherever that can be",
    "runs[].precision": "bits of a number",
    "runs[].step": "length of a step [s]",
    "runs[].outcome": "one of outcomes",
    "runs[].message": "of a refusal, or why particles were given up",
    "greatest": "the farthest finite place that a particle came to, by operators together [m]",
    "stopped": "whether it was stopped before its end",
}
"""What each field of the data means."""


def stability_data(found: Stability) -> dict[str, Any]:
    """Return the results as plain data for JSON."""
    greatest: dict[str, float] = {}
    for case in found.cases:
        names = " and ".join(each.name for each in case.operators)
        greatest[names] = max(greatest.get(names, 0.0), case.greatest)
    return {
        "graphfx_stability": 1,
        "steps": list(STEPS),
        "outcomes": NAMES,
        "counts": {outcome: found.count(outcome) for outcome in NAMES},
        "operators": found.operators,
        "left_out": found.left_out,
        "runs": [{"operators": [each.name for each in case.operators], "parameters": [each.label for each in case.operators],
                  "method": case.method, "precision": case.precision, "step": case.step, "outcome": case.outcome,
                  "message": case.message} for case in found.cases if case.outcome != "finite"],
        "greatest": greatest,
        "stopped": found.stopped,
    }


def worst(cases: list[Case]) -> str:
    """Return the worst that came out of some runs."""
    outcomes = {case.outcome for case in cases}
    return next(outcome for outcome in ORDER if outcome in outcomes)


def lines(found: Stability) -> Iterator[str]:
    """Yield the results in words, the worst first."""
    total = len(found.cases)
    counts = ", ".join(f"{found.count(outcome):,} {NAMES[outcome]}" for outcome in NAMES if found.count(outcome))
    yield f"{total:,} runs of {len(found.operators)} operators, alone and in pairs: {counts}"
    for name, why in found.left_out.items():
        yield f"left out: {name}: {why}"
    for outcome in ORDER[:-1]:
        alike: dict[tuple[str, str], list[Case]] = {}
        for case in found.cases:
            if case.outcome == outcome:
                operators = " and ".join(f"{each.name} ({each.label})" for each in case.operators)
                alike.setdefault((operators, case.message), []).append(case)
        for (operators, message), cases in list(alike.items())[:TOLD]:
            yield f"{NAMES[outcome]}: {operators}: {runs_of(cases)}{f': {message}' if message else ''}"
        if len(alike) > TOLD:
            yield f"{NAMES[outcome]}: and {len(alike) - TOLD:,} more"


def runs_of(cases: list[Case]) -> str:
    """Return what methods, precisions and steps some runs had: `strang, 64 bits, steps of 1000 and 1e+06 s`."""
    steps: dict[tuple[str, int], list[str]] = {}
    for case in cases:
        steps.setdefault((case.method, case.precision), []).append(f"{case.step:.3g}")
    return "; ".join(f"{method}, {bits} bits, steps of {' and '.join(found)} s" for (method, bits), found in steps.items())


_STYLE = """
.matrix { border-collapse: separate; border-spacing: 2px; width: auto; font-size: 13px; }
.matrix th, .matrix td { padding: 0; } .matrix td { width: 26px; height: 24px; text-align: center; border-radius: 4px; }
.matrix th { color: var(--soft); font-weight: 500; } .matrix tbody th { padding-right: 10px; text-align: right; }
.matrix thead th { height: 130px; vertical-align: bottom; background: none; border: 0; }
.matrix thead th span { writing-mode: vertical-rl; transform: rotate(180deg); }
.o-finite { background: color-mix(in srgb, var(--good) 16%, transparent); color: var(--good); }
.o-infinite { background: color-mix(in srgb, var(--fair) 26%, transparent); color: var(--fair); }
.o-failed { background: color-mix(in srgb, var(--accent) 22%, transparent); color: var(--accent); }
.o-refused, .o-not_tried { background: var(--zone); color: var(--soft); }
.o-bug { background: var(--bad); color: var(--page); font-weight: 700; }
.key-of { display: inline-block; min-width: 34px; text-align: center; border-radius: 4px; margin-right: 6px; }
"""


def stability_page(found: Stability) -> str:
    """Return the page."""
    sheet = f"<style>{style((), 0)}{_STYLE}</style>"
    head = ('<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>Stability of operators</title>\n{sheet}")
    return "\n".join([f'<!doctype html>\n<html lang="en">\n<head>\n{head}\n</head>\n<body>\n<main>', *_body(found),
                      "</main>\n</body>\n</html>\n"])


def _body(found: Stability) -> Iterator[str]:
    every, *others = lines(found)
    steps = ", ".join(f"{step:.3g}" for step in STEPS)
    yield '<p class="eyebrow">graphfx study: stability</p><h1>Every operator at the ends of its ranges</h1>'
    yield f"<p>{html.escape(every)}.</p>"
    yield (f'<p class="soft">Steps of {steps} s, in 32 and 64 bits, by the exact method where there is one and else by symmetric '
           "steps; alone also with steps of each particle's own. Where a range has no end, a million stands for it. Particles "
           "begin at 0 to 1e6 m with 0 to 1e5 m/s. The scheme <code>sims</code> is left out: it is known to be unstable.</p>")
    yield "<p>" + " ".join(f'<span class="key-of o-{name}">{SIGNS[name]}</span>{NAMES[name]} ' for name in NAMES) + "</p>"
    yield '<h2>Together</h2><p class="soft">The worst of all runs of two operators; on the diagonal, of one alone.</p>'
    yield from _matrix(found)
    yield "<h2>What did not end finite</h2><ul>"
    yield from (f"<li>{html.escape(line)}</li>" for line in others)
    yield "</ul>" if others else "<li>nothing</li></ul>"
    yield '<footer>Made by graphfx study. The same as data: <a href="stability.json">stability.json</a>.</footer>'


def _matrix(found: Stability) -> Iterator[str]:
    names = found.operators
    by_pair: dict[tuple[str, ...], list[Case]] = {}
    for case in found.cases:
        by_pair.setdefault(tuple(sorted(each.name for each in case.operators)), []).append(case)
    yield '<div class="card wide"><table class="matrix"><thead><tr><td></td>'
    yield "".join(f'<th scope="col"><span>{html.escape(name)}</span></th>' for name in names) + "</tr></thead><tbody>"
    for row in names:
        cells = []
        for column in names:
            cases = by_pair.get((row,) if row == column else tuple(sorted((row, column))), [])
            outcome = worst(cases) if cases else ""
            both = row if row == column else f"{row} and {column}"
            label = html.escape(f"{both}: {NAMES[outcome]}") if cases else ""
            cells.append(f'<td class="o-{outcome}" title="{label}">{SIGNS[outcome]}</td>' if cases else "<td></td>")
        yield f'<tr><th scope="row">{html.escape(row)}</th>{"".join(cells)}</tr>'
    yield "</tbody></table></div>"
