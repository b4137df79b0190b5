"""Refuse, before any work, what would not fit: too many particles, too large a picture."""

from __future__ import annotations

import math
from dataclasses import dataclass

from graphfx.errors import LimitError, Problem
from graphfx.graph.values import Keys, Literal, Value
from graphfx.plan.make import EmitterPlan, Plan
from graphfx.plan.pictures import ImagePlan, plain_value


@dataclass(frozen=True)
class CookLimits:
    """What a cook may take; each can be set on the command line or in Python."""

    particles: int = 100_000_000
    """Particles alive at once, of one emitter."""
    pixels: int = 1 << 27
    """Pixels of one picture."""


def check_limits(plan: Plan, limits: CookLimits) -> None:
    """Raise LimitError with everything that would pass a limit."""
    problems = [problem for emitter in plan.emitters.values() if (problem := _too_many(emitter, plan, limits))]
    problems += [problem for image in plan.images if (problem := _too_large(image, limits))]
    if problems:
        raise LimitError(problems)


def _greatest(value: Value) -> float:
    """Return the greatest that a value takes, as far as it can be told."""
    if isinstance(value, Keys):
        return max(float(plain_value(point) if isinstance(point, Value) else point) for point in value.values)
    return float(value.value) if isinstance(value, Literal) else 0.0


def _too_many(emitter: EmitterPlan, plan: Plan, limits: CookLimits) -> Problem | None:
    time = plan.flat.time
    begin, end = emitter.node.during or (-time.preroll, math.inf)
    span = max(min(end, (time.last - time.first) / time.fps) - max(begin, -time.preroll), 0.0)
    life = float(emitter.constants.get("life", span))
    given = emitter.node
    if given.node_type.role != "emit":
        return None
    rated = "rate" in given.given or not ("count" in given.given or "vertices" in given.references)
    rate = _greatest(given.arguments["rate"]) if rated else 0.0
    every = _greatest(given.arguments["every"])
    bursts = 1 + (min(span, life) // every if every > 0 else 0.0)
    count = rate * min(span, life) + _greatest(given.arguments["count"]) * bursts
    if count <= limits.particles:
        return None
    bytes_each = sum({"float": 4, "vec3": 12, "mask": 1}.get(type_, 8) for type_ in emitter.attributes.columns.values())
    return Problem(
        f"about {count:,.0f} particles would be alive at once, and the limit is {limits.particles:,}; "
        "lower the rate, the count or the life, or allow more with --limit-particles",
        emitter.node.location,
        f"nodes.{emitter.path}",
        (f"they would take {count * bytes_each / 2**30:,.1f} GiB",),
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
