"""A study as plain data for JSON: stable names, lengths in metres, times in seconds, null for what is infinite or unknown."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from graphfx.motion.clock import Clock
from graphfx.study.errors import Errors
from graphfx.study.recommend import advice, keeps
from graphfx.study.study import Result, Study, quartiles

VERSION = 1
"""Raised when a field changes its meaning or goes; new ones may come."""

FIELDS = {
    "graphfx_study": "the version of this form",
    "graph": "the graph's name",
    "file": "its file",
    "document": "a hash of its text",
    "tolerance": "time.tolerance of the graph [m]",
    "sampled": "by source, how many births were chosen; their children come with them",
    "frames": "the frames that are compared",
    "until": "the time of the last of them [s]; null if the references agree at none",
    "reference": "what is taken for the truth",
    "reference.first": "how the first reference was found",
    "reference.second": "how the second was",
    "reference.difference": "statistics of their distance, as for a setting: no smaller error is measured",
    "reference.chaotic": "whether they part before the last frame",
    "reference.particles": "how many particles and lives are compared",
    "reference.unknown": "how many of them are left out, wholly or from some frame on, as the references differ there",
    "own": "the graph as it is, like an entry of results",
    "results": "the settings that were tried",
    "results[].family": "the method, and its order where it has several",
    "results[].precision": "bits of a number",
    "results[].time": "the keys of `time` that ask for it in a graph",
    "results[].methods": "what the plan then runs, over all sources",
    "results[].reasons": "by source, how the motion is computed, and why, as the plan says it",
    "results[].message": "why it did not run; empty if it did, and otherwise what follows is null",
    "results[].error": "statistics of the distances from the truth",
    "results[].error.compared": "pairs of a particle and a frame",
    "results[].error.rms": "root mean square over those that did not fail [m]",
    "results[].error.median": "median; failures count as infinite [m]",
    "results[].error.p95": "95th percentile; failures count as infinite [m]",
    "results[].error.max": "the greatest of those that did not fail [m]",
    "results[].error.over": "pairs above the tolerance",
    "results[].p95_by_frame": "95th percentile at each of `frames` [m]; null where there is none, or it is infinite",
    "results[].measured": "whether p95 is above the difference of the references",
    "results[].keeps": "whether p95 is within the tolerance and no particle failed",
    "results[].failures": "particles that failed",
    "results[].failures.not_finite": "whose position is no number at some frame",
    "results[].failures.missing": "that are not there at some frame, though they should be",
    "results[].failures.escaped": "that are farther from their true place than all true places lie apart",
    "results[].failures.capped": "that the method gave up",
    "results[].failures.restless": "contacts that were given up, and ended in rest",
    "results[].energy": "by source of which energy is kept: RMS of what was made or lost, over the mean kinetic energy",
    "results[].evaluations": "force evaluations of each moving particle in each frame, on average; for fixed steps their number",
    "results[].seconds": "processor time of one run on one thread, to the last frame compared",
    "results[].seconds.runs": "of each round [s]",
    "results[].seconds.low": "first quartile [s]",
    "results[].seconds.median": "median [s]",
    "results[].seconds.high": "third quartile [s]",
    "results[].ratio": "the same over the time of `sims` with one step and as many bits in the same round: low, median, high",
    "orders": "p of p95 ~ evaluations^-p, for each family and precision; null where too few errors are measured",
    "recommended": "the setting of fewest evaluations that keeps the tolerance",
    "recommended.name": "in words; null if there is none",
    "recommended.time": "the keys of `time` that ask for it",
    "recommended.reason": "why",
    "conserved": "sources whose accelerations have a potential and nothing else moves them: there energy is defined",
    "stiffness": "the largest rates that operators reach, times the length of a frame",
    "stiffness[].source": "the source",
    "stiffness[].operator": "the operator's path",
    "stiffness[].type": "its type",
    "stiffness[].w": "w h: square root of the largest derivative of the acceleration by the position",
    "stiffness[].d": "d h: the largest damping",
    "stiffness[].s": "s h: the largest turning of the velocity, or rate of change of the position",
    "stiffness[].strang": "steps a frame with which strang is stable; 1 where the operator's flow is exact",
    "stiffness[].rk45": "steps a frame that rk45 needs at least",
    "stiffness[].sims": "steps a frame with which sims is stable; null if it never is",
    "pictures": "how pictures differ from that of a reference, where that was asked for",
    "pictures[].name": "the setting",
    "pictures[].frame": "the frame",
    "pictures[].rms": "root mean square of the differences of sRGB values from 0 to 1",
    "pictures[].psnr": "peak signal-to-noise ratio [dB]; null if they do not differ",
    "left_out": "what was not tried (what), and the reason (why)",
    "stopped": "whether the study was stopped before its end",
}
"""What each field means, by its path; `[]` stands for each entry of a list."""


def number(value: float | None) -> float | None:
    """Return a number, or null for what JSON has no number for."""
    return None if value is None or not math.isfinite(value) else float(value)


def statistics(errors: Errors) -> dict[str, Any]:
    """Return statistics of distances."""
    return {"compared": errors.compared, "rms": number(errors.rms), "median": number(errors.median),
            "p95": number(errors.p95), "max": number(errors.greatest), "over": errors.over}


def spread(values: list[float]) -> dict[str, Any]:
    """Return the quartiles of some numbers."""
    return dict(zip(("low", "median", "high"), map(number, quartiles(values)), strict=True))


def result_data(study: Study, result: Result) -> dict[str, Any]:
    """Return what one setting came to."""
    candidate, errors, ran = result.candidate, result.errors, not result.message
    failures = {"not_finite": errors.not_finite, "missing": errors.missing, "escaped": errors.escaped,
                "capped": result.capped, "restless": result.restless}
    floor = study.truth.difference.p95 if study.truth is not None else 0.0
    return {
        "family": candidate.family.name,
        "precision": candidate.precision,
        "time": candidate.document(),
        "methods": list(result.methods),
        "reasons": result.reasons,
        "message": result.message,
        "error": statistics(errors) if ran else None,
        "p95_by_frame": [number(result.by_frame.get(frame)) for frame in study.frames] if ran else None,
        "measured": errors.p95 > floor if ran else None,
        "keeps": keeps(result, study.tolerance) if ran else None,
        "failures": failures if ran else None,
        "energy": {path: number(value) for path, value in result.energy.items()} if ran else None,
        "evaluations": number(result.evaluations) if ran else None,
        "seconds": {"runs": result.seconds, **spread(result.seconds)} if ran else None,
        "ratio": spread(study.ratios(result)) if ran else None,
    }


def study_data(study: Study) -> dict[str, Any]:
    """Return a study."""
    flat, truth, found = study.flat, study.truth, advice(study)
    clock = Clock(flat.time.fps, flat.time.first, flat.time.preroll)
    families = list(dict.fromkeys((each.candidate.family.name, each.candidate.precision) for each in study.results
                                  if not each.message))
    return {
        "graphfx_study": VERSION,
        "graph": flat.name,
        "file": flat.file,
        "document": flat.document_hash,
        "tolerance": study.tolerance,
        "sampled": study.particles,
        "frames": study.frames if truth is not None and truth.until is not None else [],
        "until": clock.time_of(truth.until) if truth is not None and truth.until is not None else None,
        "reference": None if truth is None else {
            "first": truth.references[0].name,
            "second": truth.references[1].name,
            "difference": statistics(truth.difference),
            "chaotic": truth.chaotic,
            "particles": truth.particles,
            "unknown": truth.unknown,
        },
        "own": result_data(study, study.own) if study.own is not None else None,
        "results": [result_data(study, each) for each in study.results],
        "orders": [{"family": family, "precision": precision, "order": number(study.order(family, precision))}
                   for family, precision in families],
        "recommended": {
            "name": found.result.candidate.name if found.result else None,
            "time": found.result.candidate.document() if found.result else None,
            "reason": found.reason,
        },
        "conserved": study.conserved,
        "stiffness": [{"source": each.source, "operator": each.operator, "type": each.type, "w": number(each.w),
                       "d": number(each.d), "s": number(each.s), "strang": each.strang, "rk45": each.rk45, "sims": each.sims}
                      for each in study.reached],
        "pictures": [{"name": each.name, "frame": each.frame, "rms": number(each.rms), "psnr": number(each.psnr)}
                     for each in study.pictures],
        "left_out": [{"what": what, "why": why} for what, why in study.left_out],
        "stopped": study.stopped,
    }


def paths_in(data: Any, path: str = "") -> Iterator[str]:
    """Yield the path of each field of plain data."""
    if isinstance(data, dict):
        for name, value in data.items():
            inner = f"{path}.{name}" if path else name
            yield inner
            yield from paths_in(value, inner)
    elif isinstance(data, list):
        for value in data:
            yield from paths_in(value, f"{path}[]")
