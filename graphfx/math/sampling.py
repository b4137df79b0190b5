"""Directions from uniform numbers, for distributions."""

from __future__ import annotations

from typing import Any

from .primitives import absolute, maximum, sqrt, where
from .trigonometric import sincos
from .vec3 import Vec3, cross, unit

__all__ = ["around", "on_unit_sphere"]

TURN = 6.283185307179586


def on_unit_sphere(u: Any, v: Any) -> Any:
    """A unit vector, uniform over the sphere for uniform u and v.

        z = 2 u - 1,  (sqrt(1 - z^2) cos 2 pi v, sqrt(1 - z^2) sin 2 pi v, z)

    Equal heights of a sphere have equal areas (Archimedes).
    """
    z = u * 2.0 - 1.0
    ring = sqrt(maximum(1.0 - z * z, 0.0))
    sine, cosine = sincos(v * TURN)
    return Vec3(ring * cosine, ring * sine, z)


def around(axis: Any, v: Any) -> Any:
    """A unit vector square to the unit vector `axis`, at the angle 2 pi v about it.

        cos 2 pi v e1 + sin 2 pi v (axis x e1),  e1 = b x axis / |b x axis|, b the x or y axis, whichever is not near
    """
    upright = absolute(axis.y) < 0.9
    zero, one = axis.x * 0.0, axis.x * 0.0 + 1.0
    first = unit(cross(Vec3(where(upright, zero, one), where(upright, one, zero), zero), axis))
    sine, cosine = sincos(v * TURN)
    return first * cosine + cross(axis, first) * sine
