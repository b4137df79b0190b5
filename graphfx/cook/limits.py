"""Refuse, before any work, what would not fit: too many particles, too large a picture, too many files."""

from __future__ import annotations

import math
import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from graphfx.cook.formats import bits_of, ending
from graphfx.errors import LimitError, Problem
from graphfx.graph.values import Keys, Literal, Value
from graphfx.plan.make import EmitterPlan, Plan
from graphfx.plan.pictures import ImagePlan, plain_value

BASE = 200_000_000
"""Bytes that graphfx takes without any particle: the interpreter, Numba, the kernels."""
SURVEYED = 2
"""Bytes of a particle, beside its own, while a picture is made patch by patch: the rows of tiles that it reaches."""
LIVED = 12
"""Bytes of a particle that is born while a shutter is open, beside its own: for how much of it it is seen, and when."""
COMPRESSED = 0.25
"""About what is left of a picture of particles when it is compressed."""


@dataclass(frozen=True)
class CookLimits:
    """What a cook may take; each can be set on the command line or in Python."""

    particles: int = 100_000_000
    """Particles alive at once, of one emitter."""
    pixels: int = 1 << 27
    """Pixels of one picture."""
    disk: int | None = None
    """Bytes that the pictures may take together, as far as can be told; None: what is free."""
    memory: int | None = None
    """Bytes of memory that the process may take; pictures that need more are made patch by patch. None: what is free."""


def check_limits(plan: Plan, limits: CookLimits) -> None:
    """Raise LimitError with everything that would pass a limit."""
    problems = [problem for emitter in plan.emitters.values() if (problem := _too_many(emitter, plan, limits))]
    problems += [problem for image in plan.images if (problem := _too_large(image, limits))]
    problems += [problem for problem in [_too_much_memory(plan, limits)] if problem]
    if problems:
        raise LimitError(problems)


def check_disk(plan: Plan, out: Path, frames: Sequence[int], limits: CookLimits) -> None:
    """Raise LimitError where the pictures of some frames would take more of the disk than is free, or than is allowed."""
    needed = len(frames) * sum(_file_bytes(image) for image in plan.stills)
    there = next(folder for folder in (out.absolute(), *out.absolute().parents) if folder.is_dir())
    allowed = shutil.disk_usage(there).free if limits.disk is None else limits.disk
    if needed <= allowed:
        return
    room = f"{in_bytes(allowed)} {f'are free in {out}' if limits.disk is None else 'are allowed'}"
    raise LimitError(
        f"{len(frames):,} frames would take about {in_bytes(needed)}, and {room}; free some space, choose another folder "
        f"with --out, write fewer with --frames, or allow it with --limit-disk {in_bytes(needed).replace(' ', '')}"
    )


def _file_bytes(image: ImagePlan) -> int:
    """Return about how many bytes a picture takes; a deep one as if it had one sample a pixel, since none can tell."""
    width, height = image.size
    numbers = 3 if ending(str(image.value("file"))) == ".png" and not image.value("transparent") else 4
    return int(width * height * (numbers * bits_of(image) // 8 + 4 * len(image.channels)) * COMPRESSED)


def in_bytes(count: float) -> str:
    """Return a number of bytes as one says it: 640 B, 1.5 GB."""
    units = ("B", "kB", "MB", "GB", "TB")
    place = min(int(math.log10(max(count, 1)) / 3), len(units) - 1)
    return f"{math.ceil(count / 1000**place * 10) / 10:g} {units[place]}"


def _greatest(value: Value) -> float:
    """Return the greatest that a value takes, as far as it can be told."""
    if isinstance(value, Keys):
        return max(float(plain_value(point) if isinstance(point, Value) else point) for point in value.values)
    return float(value.value) if isinstance(value, Literal) else 0.0


def _alive(emitter: EmitterPlan, plan: Plan) -> float:
    """Return about how many particles of an emitter are alive at once; of what is spawned nothing can be told."""
    time = plan.flat.time
    begin, end = emitter.node.during or (-time.preroll, math.inf)
    span = max(min(end, (time.last - time.first) / time.fps) - max(begin, -time.preroll), 0.0)
    life = float(emitter.constants.get("life", span))
    given = emitter.node
    if given.node_type.role != "emit":
        return 0.0
    rated = "rate" in given.given or not ("count" in given.given or "vertices" in given.references)
    rate = _greatest(given.arguments["rate"]) if rated else 0.0
    every = _greatest(given.arguments["every"])
    bursts = 1 + (min(span, life) // every if every > 0 else 0.0)
    return rate * min(span, life) + _greatest(given.arguments["count"]) * bursts


def _bytes_each(emitter: EmitterPlan) -> int:
    """Return the memory of one particle."""
    return sum({"float": 4, "vec3": 12, "mask": 1}.get(type_, 8) for type_ in emitter.attributes.columns.values())


def _born_in_shutter(emitter: EmitterPlan, plan: Plan) -> float:
    """Return about how many particles of a rate are born while a shutter is open."""
    given, time = emitter.node, plan.flat.time
    if given.node_type.role != "emit" or "rate" not in given.given:
        return 0.0
    return min(_greatest(given.arguments["rate"]) * emitter.exposure.reach / time.fps, _alive(emitter, plan))


def _too_much_memory(plan: Plan, limits: CookLimits) -> Problem | None:
    """Return that the particles and films alone would take more than the memory that is allowed; told where the most are born."""
    each = {
        path: _alive(emitter, plan) * (_bytes_each(emitter) + SURVEYED) + _born_in_shutter(emitter, plan) * LIVED
        for path, emitter in plan.emitters.items()
    }
    particles, films = sum(each.values()), sum(16 * math.prod(image.size) for image in plan.images)
    if limits.memory is None or particles + films + BASE <= limits.memory:
        return None
    needed, allowed = in_bytes(particles + films + BASE), in_bytes(limits.memory)
    notes = (f"particles {in_bytes(particles)}, pictures {in_bytes(films)}, graphfx itself {in_bytes(BASE)}",)
    if limits.memory < BASE:
        return Problem(f"graphfx itself takes about {in_bytes(BASE)} of memory, and {allowed} are allowed; allow {needed} "
                       "with --memory", notes=notes)
    message = f"about {needed} of memory are needed, and {allowed} are allowed; allow {needed} with --memory, or "
    most = max(each, key=lambda path: each[path], default="")
    if particles <= films:
        return Problem(message + "make the pictures smaller", notes=notes)
    return Problem(message + "lower the rate, the count or the life of the particles", plan.emitters[most].node.location,
                   f"nodes.{most}", notes)


def _too_many(emitter: EmitterPlan, plan: Plan, limits: CookLimits) -> Problem | None:
    count = _alive(emitter, plan)
    if count <= limits.particles:
        return None
    return Problem(
        f"about {count:,.0f} particles would be alive at once, and the limit is {limits.particles:,}; "
        "lower the rate, the count or the life, or allow more with --limit-particles",
        emitter.node.location,
        f"nodes.{emitter.path}",
        (f"they would take {count * _bytes_each(emitter) / 2**30:,.1f} GiB",),
    )


def _too_large(image: ImagePlan, limits: CookLimits) -> Problem | None:
    width, height = (int(number) for number in image.value("size"))
    if width * height <= limits.pixels:
        return None
    return Problem(
        f"a picture of {width} x {height} has {width * height:,} pixels, and the limit is {limits.pixels:,}; "
        "make it smaller, or allow more with --limit-pixels",
        image.node.location,
        f"nodes.{image.node.path}",
    )
