"""Vec3: the algebra of vectors, and turning without drift."""

import numpy as np
import pytest

from graphfx.math import Vec3, cross, dot, length, rotate, sincos, unit, where

KINDS = [np.float32, np.float64]
DRAW = np.random.default_rng(3)


def vectors(kind, count=200, scale=1.0):
    return Vec3(*(DRAW.normal(size=(3, count)) * scale).astype(kind))


def same(a, b):
    return all(np.array_equal(x, y) for x, y in zip(a, b, strict=True))


@pytest.mark.parametrize("kind", KINDS)
def test_operators_act_on_each_component(kind):
    """Sum, difference, opposite, multiple and quotient are those of the components, with their precision."""
    a, b, k = Vec3(kind(1), kind(-2), kind(3)), Vec3(kind(0.5), kind(4), kind(-1)), kind(4)
    assert list(a + b) == [1.5, 2, 2] and list(a - b) == [0.5, -6, 4] and list(-a) == [-1, 2, -3]
    assert list(a * k) == list(k * a) == [4, -8, 12] and list(a / k) == [0.25, -0.5, 0.75]
    assert {type(x) for v in (a + b, a - b, -a, a * k, k * a, 2.0 * a, a / k) for x in v} == {kind}


def test_where_chooses_whole_vectors():
    """where(condition, Vec3, Vec3) gives one vector or the other, lane by lane for arrays."""
    a, b = Vec3(*np.ones((3, 2), np.float32)), Vec3(*np.zeros((3, 2), np.float32))
    assert same(where(np.array([True, False]), a, b), [[1, 0]] * 3)
    assert list(where(np.bool_(False), Vec3(1.0, 2.0, 3.0), Vec3(4.0, 5.0, 6.0))) == [4, 5, 6]


@pytest.mark.parametrize("kind", KINDS)
def test_cross_is_perpendicular_and_right_handed(kind):
    """x cross y is z, v cross v is exactly 0, and a cross b is at right angles to both."""
    one, none = kind(1), kind(0)
    assert list(cross(Vec3(one, none, none), Vec3(none, one, none))) == [0, 0, 1]
    a, b = vectors(kind), vectors(kind)
    assert same(cross(a, a), np.zeros((3, 200)))
    size = length(a) * length(a) * length(b)
    assert np.all(np.abs(dot(a, cross(a, b))) <= 4 * np.finfo(kind).eps * size)


@pytest.mark.parametrize("kind, least, most", [(np.float32, -18, 18.5), (np.float64, -153, 153.5)])
def test_unit_is_one_long_over_half_of_the_range(kind, least, most):
    """A unit vector's length is 1 within 3 ulp for any length in the middle half of the exponents."""
    v = vectors(kind, 2000) * (10.0 ** DRAW.uniform(least + 1, most - 1, 2000)).astype(kind)
    sizes = [np.asarray(x, np.longdouble) for x in unit(v)]
    assert np.all(np.abs(np.sqrt(sum(x * x for x in sizes)) - 1) <= 3 * np.finfo(kind).eps)


@pytest.mark.parametrize("kind", KINDS)
def test_unit_of_zero_is_zero(kind):
    """The zero vector has no direction: its unit vector is zero, not NaN."""
    with np.errstate(all="ignore"):
        assert list(unit(Vec3(kind(0), kind(0), kind(0)))) == [0, 0, 0]
        beyond = unit(Vec3(np.finfo(kind).max, kind(1), kind(0)))
    assert list(beyond) == [0, 0, 0]


@pytest.mark.parametrize("kind", KINDS)
def test_quarter_turn_is_right_handed(kind):
    """A right-handed quarter turn about +y takes +z to +x, and leaves the height."""
    one, none = kind(1), kind(0)
    assert list(rotate(Vec3(none, kind(0.1), one), Vec3(none, one, none), one, none)) == [1, kind(0.1), 0]


@pytest.mark.parametrize("kind", KINDS)
def test_turning_composes(kind):
    """Turning by a and then by b is turning by a + b, about any axis."""
    axis = unit(Vec3(kind(1), kind(-2), kind(0.5)))
    v, a, b = vectors(kind), kind(0.7), kind(1.9)
    twice = rotate(rotate(v, axis, *sincos(a)), axis, *sincos(b))
    once = rotate(v, axis, *sincos(a + b))
    assert np.all(length(twice - once) <= 8 * np.finfo(kind).eps * length(v))


def turns_about_y(kind, turns, count=4):
    """Return start vectors, and the sines and cosines of many random angles."""
    draw = np.random.default_rng(4)
    angles = draw.uniform(-10, 10, (turns, count)).astype(kind)
    return Vec3(*draw.uniform(0.1, 2, (3, count)).astype(kind)), *sincos(angles)


@pytest.mark.parametrize("kind", KINDS)
def test_turning_about_a_coordinate_axis_is_the_plane_rotation(kind):
    """About +y, rotate is x c + z s and z c - x s to the bit, and leaves the height's bits alone."""
    v, sines, cosines = turns_about_y(kind, 500)
    for s, c in zip(sines, cosines, strict=True):
        turned = rotate(v, Vec3(kind(0), kind(1), kind(0)), s, c)
        assert same(turned, (v.x * c + v.z * s, v.y, v.z * c - v.x * s))
        v = turned


@pytest.mark.parametrize("kind, bound", [(np.float32, 6e-5), (np.float64, 1e-13)])
def test_a_hundred_thousand_turns_keep_the_radius(kind, bound):
    """The radius is kept within a random walk of roundings: no shrinking, no growing."""
    start, sines, cosines = turns_about_y(kind, 100_000)
    x, z = start.x, start.z
    for s, c in zip(sines, cosines, strict=True):
        x, z = x * c + z * s, z * c - x * s
    assert np.max(np.abs(np.hypot(x, z) / np.hypot(start.x, start.z) - 1)) < bound
