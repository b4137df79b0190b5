"""The functions of expressions, as scalar functions on numbers and vectors alike.

Each is named as the expression language names it; `and`, `or`, `not` and `select` as below.
"""

from __future__ import annotations

from typing import Any

from graphfx.math import Vec3, absolute, maximum, minimum, unit, where
from graphfx.math import cos as cos_of
from graphfx.math import cross as cross_of
from graphfx.math import dot as dot_of
from graphfx.math import exp as exp_of
from graphfx.math import floor as floor_of
from graphfx.math import length as length_of
from graphfx.math import log as log_of
from graphfx.math import power as power_of
from graphfx.math import sin as sin_of
from graphfx.math import sqrt as sqrt_of
from graphfx.math.logarithmic import NAN


def add(a: Any, b: Any) -> Any:
    """a + b."""
    return a + b


def subtract(a: Any, b: Any) -> Any:
    """a - b."""
    return a - b


def multiply(a: Any, b: Any) -> Any:
    """a * b."""
    return a * b


def divide(a: Any, b: Any) -> Any:
    """a / b, by IEEE rules."""
    return a / b


def modulo(a: Any, b: Any) -> Any:
    """a - floor(a / b) b."""
    return a - floor_of(a / b) * b


def power(a: Any, b: Any) -> Any:
    """a to the power b; of a negative a, b a whole number: |a|^b, with the sign of a where b is odd."""
    size = power_of(absolute(a), b)
    odd = floor_of(b * 0.5) * 2.0 != b
    signed = where(odd, -size, size)
    return where(a >= 0.0, size, where(floor_of(b) == b, signed, a * NAN))


def negate(a: Any) -> Any:
    """-a."""
    return -a


def less(a: Any, b: Any) -> Any:
    """a < b."""
    return a < b


def less_equal(a: Any, b: Any) -> Any:
    """a <= b."""
    return a <= b


def greater(a: Any, b: Any) -> Any:
    """a > b."""
    return a > b


def greater_equal(a: Any, b: Any) -> Any:
    """a >= b."""
    return a >= b


def equal(a: Any, b: Any) -> Any:
    """a == b."""
    return a == b


def not_equal(a: Any, b: Any) -> Any:
    """a != b."""
    return a != b


def both(a: Any, b: Any) -> Any:
    """a and b."""
    return a & b


def either(a: Any, b: Any) -> Any:
    """a or b."""
    return a | b


def opposite(a: Any) -> Any:
    """not a."""
    return ~a


def select(condition: Any, a: Any, b: Any) -> Any:
    """a where the condition holds, else b."""
    return where(condition, a, b)


def vec(x: Any, y: Any, z: Any) -> Any:
    """The vector (x, y, z)."""
    return Vec3(x, y, z)


def component_x(v: Any) -> Any:
    """v.x."""
    return v.x


def component_y(v: Any) -> Any:
    """v.y."""
    return v.y


def component_z(v: Any) -> Any:
    """v.z."""
    return v.z


def sin(x: Any) -> Any:
    """Sine of x radians."""
    return sin_of(x)


def cos(x: Any) -> Any:
    """Cosine of x radians."""
    return cos_of(x)


def exp(x: Any) -> Any:
    """e to the power x."""
    return exp_of(x)


def log(x: Any) -> Any:
    """Natural logarithm."""
    return log_of(x)


def sqrt(x: Any) -> Any:
    """Square root."""
    return sqrt_of(x)


def floor(x: Any) -> Any:
    """Greatest whole number <= x."""
    return floor_of(x)


def magnitude(x: Any) -> Any:
    """|x|."""
    return absolute(x)


def least(a: Any, b: Any) -> Any:
    """The lesser."""
    return minimum(a, b)


def greatest(a: Any, b: Any) -> Any:
    """The greater."""
    return maximum(a, b)


def clamp(x: Any, low: Any, high: Any) -> Any:
    """x, at least low and at most high."""
    return minimum(maximum(x, low), high)


def mix(a: Any, b: Any, t: Any) -> Any:
    """a + (b - a) t."""
    return a + (b - a) * t


def step(edge: Any, x: Any) -> Any:
    """0 where x < edge, else 1."""
    return where(x < edge, edge - edge, edge - edge + 1.0)


def smoothstep(low: Any, high: Any, x: Any) -> Any:
    """3 t^2 - 2 t^3 with t = clamp((x - low) / (high - low), 0, 1)."""
    t = minimum(maximum((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def length(v: Any) -> Any:
    """Length of a vector."""
    return length_of(v)


def dot(a: Any, b: Any) -> Any:
    """Scalar product."""
    return dot_of(a, b)


def cross(a: Any, b: Any) -> Any:
    """Vector product."""
    return cross_of(a, b)


def normalize(v: Any) -> Any:
    """Unit vector; zero of zero."""
    return unit(v)


_RENAMED = {"and": both, "or": either, "not": opposite, "abs": magnitude, "min": least, "max": greatest}


def body_of(name: str) -> Any:
    """Return the scalar function that an expression's function means."""
    return _RENAMED.get(name) or globals()[name]
