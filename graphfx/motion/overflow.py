"""Whether a particle has left the numbers: scalar functions for one particle.

32 bits hold numbers up to 3.4e38, 64 bits up to 1.8e308; what would be greater is infinite, and inf - inf is no number.
"""

from __future__ import annotations

from typing import Any

from graphfx.math import absolute
from graphfx.program import Bundle

OVERFLOW = Bundle("overflow")


@OVERFLOW.function("vec3", "bool")
def is_beyond(value: Any) -> Any:
    """|x| + |y| + |z| is infinite, or no number."""
    return is_infinite(absolute(value.x) + absolute(value.y) + absolute(value.z))


@OVERFLOW.function("vec3 vec3", "bool")
def are_beyond(position: Any, velocity: Any) -> Any:
    """The sum of the sizes of all six coordinates is infinite, or no number."""
    place = absolute(position.x) + absolute(position.y) + absolute(position.z)
    return is_infinite(place + (absolute(velocity.x) + absolute(velocity.y) + absolute(velocity.z)))


def is_infinite(total: Any) -> Any:
    """total - total != 0: of what is infinite, or no number, that is no number."""
    return ~(total - total == 0.0)
