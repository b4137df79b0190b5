"""A study as one page of HTML that needs nothing else: what to take, plots, a table, and how to read them."""

from __future__ import annotations

import html
import json
import math
from collections.abc import Iterator

from graphfx.motion.clock import Clock
from graphfx.study.candidates import FAMILIES, Family
from graphfx.study.curves import MARKER_OF, STATISTICS, WHAT, along_the_shot, style_of, work_precision
from graphfx.study.plot import MARKERS, svg
from graphfx.study.recommend import advice, by_reason, keeps, length
from graphfx.study.study import Result, Study, quartiles
from graphfx.study.style import style

HEADS = ("setting", "95th percentile", "median", "RMS", "greatest", "over", "failed", "evaluations", "energy", "time",
         "quartiles", "x sims", "order")


def escaped(text: object) -> str:
    """Return a text as it stands in HTML."""
    return html.escape(str(text), quote=True)


def page(study: Study) -> str:
    """Return the page of a study."""
    title = escaped(f"{study.flat.name}: what accuracy costs")
    head = f'<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>{title}</title>'
    sheet = f"<style>{style(tuple(STATISTICS), len(FAMILIES))}</style>"
    body = [*_header(study), *_verdict(study)]
    if study.truth is not None and study.truth.until is not None:
        body += [*_plots(study), *_shot(study), *_pictures(study), *_stiffness(study), *_table(study)]
    body += [*_left_out(study), *_how_to_read(study)]
    footer = '<footer>Made by graphfx study. The same as data: <a href="study.json">study.json</a>.'
    return "\n".join([f'<!doctype html>\n<html lang="en">\n<head>\n{head}\n{sheet}\n</head>\n<body>\n<main>', *body,
                      f"{footer}</footer>\n</main>\n</body>\n</html>\n"])


def _header(study: Study) -> Iterator[str]:
    yield '<p class="eyebrow">graphfx study: error against run time</p>'
    yield f"<h1>{escaped(study.flat.name)}</h1>"
    yield f'<p class="soft">{escaped(study.flat.doc)}</p>'


def _verdict(study: Study) -> Iterator[str]:
    found = advice(study)
    reason = escaped(found.reason[0].upper() + found.reason[1:])
    yield '<div class="verdict">'
    if found.result is None:
        yield f'<section class="card none"><p class="eyebrow">No recommendation</p><h2>It cannot be told</h2><p>{reason}.</p>'
    else:
        yield f'<section class="card"><p class="eyebrow">Recommended</p><h2>{escaped(found.result.candidate.name)}</h2>'
        yield f'<pre>"time": {escaped(json.dumps(found.result.candidate.document()))}</pre><p>{reason}.</p>'
    yield "</section>"
    yield '<section class="card"><dl>'
    for name, said in _facts(study):
        yield f"<dt>{name}</dt><dd>{said}</dd>"
    yield "</dl></section></div>"


def _facts(study: Study) -> Iterator[tuple[str, str]]:
    truth, own = study.truth, study.own
    yield "Tolerance", f"{length(study.tolerance)} for 95 % of the positions"
    if own is not None and not own.message:
        kept = keeps(own, study.tolerance)
        verdict = f'<span class="{"good" if kept else "bad"}">{"" if kept else "not "}within it</span>'
        setting = f"<code>{own.candidate.family.method}</code>, {own.candidate.precision} bits"
        yield "As it is", f"{setting}: {length(own.errors.p95)}, {verdict}, {own.evaluations:.3g} evaluations"
        yield from ((f"&emsp;{escaped(path)}", f"<small>{escaped(reason)}</small>") for path, reason in own.reasons.items())
    several = "emitter" if len(study.particles) == 1 else "emitters"
    yield "Particles", f"{sum(study.particles.values()):,} births of {len(study.particles)} {several}, and their children"
    if truth is None:
        return
    yield "Truth", f"{escaped(truth.references[0].name)}"
    checked = f"{escaped(truth.references[1].name)} differs by {length(truth.difference.p95)}"
    yield "Checked by", f"{checked} (95th percentile), {length(truth.difference.greatest)} at most"
    if truth.until is None:
        yield "Known until", '<span class="bad">nowhere: the references disagree from the first frame on</span>'
    else:
        time = Clock(study.flat.time.fps, study.flat.time.first).time_of(truth.until)
        said = f"frame {truth.until} ({time:.3g} s)"
        yield "Known until", f'<span class="fair">{said}; chaos after that</span>' if truth.chaotic else f"{said}, the last one"
    if truth.unknown:
        yield "Left out", f"{truth.unknown:,} of {truth.particles:,} particles, from where the references part"


def _plots(study: Study) -> Iterator[str]:
    yield "<h2>Error against cost</h2>"
    yield ('<p class="soft">Each line is a method with more and more steps, or smaller and smaller tolerances. Below and to the '
           "left is better. The ring marks what is recommended; hollow points on solid lines are not measured, as the "
           "references differ by more.</p>")
    yield from _switches(study)
    yield '<div class="plots">'
    for timed in (True, False):
        yield '<figure class="card">'
        yield f"<figcaption>Error against {'run time' if timed else 'evaluations'}</figcaption>"
        for statistic in STATISTICS:
            yield f'<div class="of-{statistic}">{svg(work_precision(study, statistic, timed))}</div>'
        yield "</figure>"
    yield "</div>"


def _switches(study: Study) -> Iterator[str]:
    yield '<div class="switches"><fieldset><legend>Error</legend>'
    for number, name in enumerate(STATISTICS):
        checked = " checked" if number == 0 else ""
        yield f'<label><input type="radio" name="statistic" id="show-{name}"{checked}>{WHAT[name]}</label>'
    yield "</fieldset><fieldset><legend>Methods</legend>"
    ran = [each.candidate for each in study.results if not each.message]
    for family in dict.fromkeys(candidate.family for candidate in ran):
        key = (f'<svg viewBox="-13 -7 26 14" aria-hidden="true"><g class="line {style_of(family)}">'
               f'<path class="way" d="M-13,0H13"/><path class="mark" d="{MARKERS[MARKER_OF[family.name]]}"/></g></svg>')
        yield f'<label><input type="checkbox" id="hide-{style_of(family)}" checked>{key}{escaped(family.name)}</label>'
    yield "</fieldset><fieldset><legend>Precision</legend>"
    for bits, said in ((64, "64 bits, solid"), (32, "32 bits, dashed")):
        if any(candidate.precision == bits for candidate in ran):
            yield f'<label><input type="checkbox" id="hide-b{bits}" checked>{said}</label>'
    yield "</fieldset></div>"


def _shot(study: Study) -> Iterator[str]:
    yield '<h2>Error along the shot, and what each method can do</h2><div class="plots"><figure class="card">'
    yield ('<p class="soft">How wrong 95 % of the particles are at most, frame by frame: '
           '<span class="line own"><b>the graph as it is</b></span>, '
           '<span class="line best"><b>what is recommended</b></span> and '
           '<span class="line sims"><b>the scheme of the paper</b></span> with one step.</p>')
    yield f'{svg(along_the_shot(study))}</figure><section class="card wide"><table><thead><tr>'
    heads = ("method", "bits", "least error", "order", "evaluations to keep the tolerance")
    yield "".join(f'<th scope="col">{head}</th>' for head in heads) + "</tr></thead><tbody>"
    for family, precision in families_of(study):
        found, order = study.of(family.name, precision), study.order(family.name, precision)
        least = min((each.errors.p95 for each in found), default=math.inf)
        enough = min((each.evaluations for each in found if keeps(each, study.tolerance)), default=None)
        floor = study.truth.difference.p95 if study.truth is not None else 0.0
        cells = (f'<span class="key {style_of(family)}"></span>{escaped(family.name)}', precision, told(least, floor),
                 "" if order is None else f"{order:.1f}",
                 '<span class="bad">not reached</span>' if enough is None else f"{enough:.3g}")
        yield "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
    yield "</tbody></table></section></div>"


def _pictures(study: Study) -> Iterator[str]:
    if study.pictures:
        yield f'<h2>The picture of frame {study.pictures[0].frame}</h2><ul>'
        for each in study.pictures:
            psnr = f"PSNR {each.psnr:.1f} dB" if math.isfinite(each.psnr) else "the same picture"
            yield f"<li>{escaped(each.name)}: RMS {each.rms:.2e} of full white, {psnr}</li>"
        yield "</ul>"


def _stiffness(study: Study) -> Iterator[str]:
    if not study.reached:
        return
    heads = ("operator", "type", "source", "w h", "d h", "s h", "strang", "rk45", "sims")
    yield "<h2>How stiff the scene is</h2>"
    yield ('<p class="soft">The largest rates that particles really reach, times the length of a frame: w of springs and pulls, '
           "d of damping, s of turning. The last columns tell how many steps a frame each method takes to be stable; accuracy "
           "may ask for more.</p>")
    yield '<div class="card wide"><table><thead><tr>' + "".join(f'<th scope="col">{head}</th>' for head in heads)
    yield "</tr></thead><tbody>"
    for each in study.reached:
        rates = [f"{value:.2g}" if value > 1e-6 else "0" for value in (each.w, each.d, each.s)]
        strang = "no limit" if each.exact else f"{each.strang}"
        sims = '<span class="bad">never</span>' if each.sims is None else f"{each.sims}"
        cells = (escaped(each.operator), escaped(each.type), escaped(each.source), *rates, strang, f"{each.rk45}", sims)
        yield "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"
    yield "</tbody></table></div>"
    if study.conserved:
        yield (f'<p class="soft">Energy is defined and kept for {escaped(", ".join(study.conserved))}: all accelerations there '
               "have a potential. What each setting makes or loses of it is in the table.</p>")
    else:
        yield '<p class="soft">Energy is kept by no source of this graph, so no drift is told.</p>'


def families_of(study: Study) -> list[tuple[Family, int]]:
    """Return the families and precisions that ran, in order."""
    return list(dict.fromkeys((each.candidate.family, each.candidate.precision) for each in study.results if not each.message))


def _table(study: Study) -> Iterator[str]:
    best = advice(study).result
    yield "<h2>All settings</h2>"
    yield '<div class="card wide"><table><thead><tr>'
    yield "".join(f'<th scope="col">{head}</th>' for head in HEADS) + "</tr></thead>"
    for family, precision in families_of(study):
        found, order = study.of(family.name, precision), study.order(family.name, precision)
        yield '<tbody class="family">'
        for number, result in enumerate(found):
            told = f"{order:.1f}" if order is not None and not number else ""
            marked = ' class="best"' if result is best else ""
            yield f"<tr{marked}>" + "".join(f"<td>{cell}</td>" for cell in (*_cells(study, result), told)) + "</tr>"
        yield "</tbody>"
    yield "</table></div>"


def _cells(study: Study, result: Result) -> list[str]:
    assert study.truth is not None
    errors, floor = result.errors, study.truth.difference
    verdict = "good" if keeps(result, study.tolerance) else "bad" if errors.p95 > study.tolerance else "fair"
    low, middle, high = (1000 * value for value in quartiles(result.seconds))
    ratio = quartiles(study.ratios(result))[1]
    failed = errors.failures + result.capped
    return [
        f'<span class="key {style_of(result.candidate.family)}"></span>{escaped(result.candidate.name)}',
        f'<span class="{verdict}">{told(errors.p95, floor.p95)}</span>', told(errors.median, floor.median),
        told(errors.rms, floor.rms), told(errors.greatest, floor.greatest), f"{errors.over:,}",
        f'<span class="bad">{failed:,}</span>' if failed else "0", f"{result.evaluations:.3g}",
        " ".join(f"{value:.0e}" for value in result.energy.values()),
        f"{middle:,.0f} ms" if math.isfinite(middle) else "", f"{low:,.0f} to {high:,.0f}" if math.isfinite(middle) else "",
        f"{ratio:.2f}" if math.isfinite(ratio) else "",
    ]


def told(value: float, floor: float) -> str:
    """Return an error; what is not above the difference of the references is told as that."""
    if value <= floor:
        return f"&le; {length(floor)}" if floor else "0"
    return length(value)


def _left_out(study: Study) -> Iterator[str]:
    refused: dict[str, list[str]] = {}
    for result in study.results:
        if result.message:
            refused.setdefault(result.message, []).append(f"{result.candidate.family.name} ({result.candidate.precision} bits)")
    if refused:
        yield "<h2>What did not run</h2><ul>"
        yield from (f"<li><b>{escaped(', '.join(names))}</b>: {escaped(message)}</li>" for message, names in refused.items())
        yield "</ul>"
    if study.left_out:
        yield "<h2>What was left out</h2><ul>"
        yield from (f"<li><b>{escaped('; '.join(what))}</b>: {escaped(why)}</li>" for why, what in by_reason(study).items())
        yield "</ul>"


def _how_to_read(study: Study) -> Iterator[str]:
    yield "<h2>How to read this</h2><ul>"
    for line in (
        "The error of a particle is the distance between where a method puts it and where the truth does, at one frame. "
        "All particles and all frames compared count alike.",
        "The truth is not known either: two references of different orders are computed, and their difference is told. No "
        "smaller error is measured; in the plots that is the shaded zone, in the table &le;.",
        "Particles that become no number, that are missing or that escape count as infinitely wrong in the median and the 95th "
        "percentile; RMS and the greatest error are those of the others.",
        "Evaluations count how often the forces on a particle are found in a frame, on average over those that move. They do not "
        "depend on the machine. Run times are processor time on one thread for the particles sampled, all preparation done; "
        "ratios compare with <code>sims</code>, one step, as many bits, in the same round.",
        "The order p says that error falls as evaluations to the power -p, over what is measured.",
    ):
        yield f"<li>{line}</li>"
    yield "</ul>"
