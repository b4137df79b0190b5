"""Surfaces that have no sides to measure from, sheets and meshes: scalar functions for one particle.

The way of a step is met by a plane, one skin off the surface on the side of the start; the contact is found on the
true path by the signed distance from that plane. So a particle is always a skin away from the surface, which hides
all rounding: no step can end, or begin, on the wrong side. A skin is eight tolerances of `contact_tolerance` thick
at least.
"""

from __future__ import annotations

from typing import Any

from graphfx.math import dot, minimum, where
from graphfx.motion.basic import MOTION


@MOTION.function("vec3 vec3 vec3", "float")
def plane_distance(position: Any, point: Any, normal: Any) -> Any:
    """(P - point) . normal."""
    return dot(position - point, normal)


@MOTION.function("float float", "float")
def surely_below(distance: Any, tolerance: Any) -> Any:
    """The distance at the end of a way that meets the plane: below 0, whatever rounding says."""
    return minimum(distance, tolerance * -0.0009765625)


@MOTION.function("float float", "float")
def from_above(distance: Any, tolerance: Any) -> Any:
    """The distance from a place two tolerances above the plane, where a particle is put: so that what glides along is free."""
    return distance - tolerance * 2.0


@MOTION.function("vec3 vec3 float float float", "vec3")
def put_above(position: Any, normal: Any, above: Any, time: Any, best: Any) -> Any:
    """Where a particle is put at its contact, if this is the first surface that it meets; `above` is what `from_above` gives."""
    return position - normal * where(time <= best, above, 0.0)


@MOTION.function("vec3", "vec3")
def turned_back(velocity: Any) -> Any:
    """-V / 2: a particle that finds no way on out of a narrow corner goes back as it came, more slowly."""
    return velocity * -0.5
