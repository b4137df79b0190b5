"""sincos, atan2 and acos where accuracy says nothing: the circle, symmetry, hostile input."""

import numpy as np
import pytest

from graphfx.math import acos, atan2, cos, sin, sincos

KINDS = [np.float32, np.float64]
DEFECT = {np.float32: 1.4e-7, np.float64: 2.4e-16}


def squared_radius(s, c):
    return s.astype(np.longdouble) ** 2 + c.astype(np.longdouble) ** 2


@pytest.mark.parametrize("kind", KINDS)
def test_every_finite_angle_is_on_the_circle(kind):
    """Whatever the bits of a finite angle, s^2 + c^2 is 1 to rounding."""
    bits = np.random.default_rng(1).integers(0, 2**64, 20_000, dtype=np.uint64).view(kind)
    huge = np.array([np.finfo(kind).max, -np.finfo(kind).max, 2.0**24, 2.0**25 + 4, 2.0**63, 1e30], kind)
    x = np.concatenate([bits[np.isfinite(bits)], huge])
    assert np.abs(squared_radius(*sincos(x)) - 1).max() <= DEFECT[kind]


@pytest.mark.parametrize("kind, count, bound", [(np.float32, 1_000_000, 1e-9), (np.float64, 100_000, 1e-17)])
def test_the_circle_has_no_bias(kind, count, bound):
    """The mean of s^2 + c^2 - 1 over angles is far below a rounding, so that orbits neither shrink nor grow."""
    x = np.random.default_rng(2).uniform(-100, 100, count).astype(kind)
    assert abs((squared_radius(*sincos(x)) - 1).mean()) < bound


@pytest.mark.parametrize("kind", KINDS)
def test_sine_is_odd_and_cosine_is_even(kind):
    """sin(-x) is -sin(x) and cos(-x) is cos(x) to the last bit, in the quarter turn about 0."""
    x = np.random.default_rng(3).uniform(0, 0.785, 10_000).astype(kind)
    assert np.array_equal(sin(-x), -sin(x)) and np.array_equal(cos(-x), cos(x))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("x", [np.inf, -np.inf, np.nan])
def test_no_angle_has_no_sine(kind, x):
    """The sine and the cosine of an infinity and of NaN are NaN."""
    with np.errstate(all="ignore"):
        assert np.isnan(sincos(kind(x))).all()


@pytest.mark.parametrize("kind", KINDS)
def test_the_sine_of_a_tiny_angle_is_the_angle(kind):
    """sin x is x and cos x is 1 for the smallest numbers, denormals and zero."""
    for x in (np.finfo(kind).smallest_subnormal, np.finfo(kind).tiny, kind(1e-30), kind(0), kind(-1e-30)):
        assert sincos(x) == (x, 1)


CORNERS = [
    (0.0, 1, 0.0), (-0.0, 1, -0.0), (0.0, 0.0, 0.0), (0.0, -0.0, np.pi), (-0.0, -0.0, -np.pi), (0.0, -1, np.pi),
    (-0.0, -1, -np.pi), (1, 0.0, np.pi / 2), (-1, 0.0, -np.pi / 2), (1, 1, np.pi / 4), (-1, -1, -3 * np.pi / 4),
    (np.inf, np.inf, np.pi / 4),
    (np.inf, -np.inf, 3 * np.pi / 4), (-np.inf, 1, -np.pi / 2), (1, np.inf, 0.0), (1, -np.inf, np.pi), (3e38, 3e38, np.pi / 4),
    (1e-45, 1e-45, np.pi / 4), (np.nan, 0.0, np.nan), (0.0, np.nan, np.nan), (np.nan, np.inf, np.nan), (np.inf, np.nan, np.nan),
]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("y, x, angle", CORNERS)
def test_atan2_at_corners(kind, y, x, angle):
    """On the axes, at the origin, at infinity and for NaN, atan2 answers as in C."""
    with np.errstate(all="ignore"):
        got = atan2(kind(y), kind(x))
    assert np.isclose(got, kind(angle), rtol=2 * np.finfo(kind).eps, atol=0, equal_nan=True)
    assert np.isnan(angle) or np.signbit(got) == np.signbit(angle)


@pytest.mark.parametrize("kind", KINDS)
def test_atan2_finds_the_angle_again(kind):
    """atan2 of the sine and cosine of an angle is the angle, all round the circle."""
    angle = np.linspace(-3.14, 3.14, 2001).astype(kind)
    assert np.abs(atan2(*sincos(angle)) - angle).max() <= 3 * np.finfo(kind).eps


@pytest.mark.parametrize("kind", KINDS)
def test_acos_at_corners(kind):
    """acos(1) is 0, acos(0) a right angle, acos(-1) pi, and beyond there is none."""
    with np.errstate(all="ignore"):
        assert [acos(kind(x)) for x in (1, -1)] == [0, kind(np.pi)]
        assert abs(acos(kind(0)) - kind(np.pi / 2)) <= np.finfo(kind).eps
        assert all(np.isnan(acos(kind(x))) for x in (1.0001, -1.0001, np.inf, np.nan))


@pytest.mark.parametrize("kind", KINDS)
def test_arrays_give_what_scalars_give(kind):
    """One angle at a time, the bits are those of many at once."""
    x = np.random.default_rng(4).normal(size=200).astype(kind) * kind(10)
    y = np.roll(x, 1)
    assert [sincos(v) for v in x] == list(zip(*sincos(x), strict=True))
    assert [atan2(a, b) for a, b in zip(y, x, strict=True)] == list(atan2(y, x))
