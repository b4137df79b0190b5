"""Attraction to points and lines: values worked out by hand, orbits, and what stays finite."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from graphfx.math import Vec3

from .one_particle import LIBRARY, end_of, path
from .test_linear import array, vector


def pull(name: str, position, mass=1.0, kind=np.float64, **given) -> np.ndarray:
    """Return the acceleration that an operator gives at a place; what is not given stands at its default."""
    node = LIBRARY[name]
    values: dict = {"position": Vec3(*map(kind, position)), "mass": kind(mass)}
    for parameter in node.parameters.values():
        value = given.get(parameter.name, parameter.default)
        cast = np.bool_ if parameter.type == "bool" else kind
        values[parameter.name] = Vec3(*map(kind, value)) if isinstance(value, tuple) else cast(value)
    with np.errstate(all="ignore"):
        return array(node.function(**values))


def test_inverse_square():
    """g m (O - P) / |O - P|^3: 12 m/s^2 at 1 m is 3 at 2 m, towards O."""
    at = pull("attract", (3, 0, 0), center=(1, 0, 0), strength=12, softening=0)
    np.testing.assert_allclose(at, [-3, 0, 0], rtol=1e-15)
    at = pull("attract", (1, 2, 2), strength=27, softening=0)
    np.testing.assert_allclose(at, np.array([-1, -2, -2]), rtol=1e-15)


@pytest.mark.parametrize("falloff, wanted", [(0, 8), (1, 4), (2, 2), (3, 1)])
def test_falloff_is_a_power_of_the_distance(falloff, wanted):
    """At 2 m the pull is strength / 2^falloff, for points and for lines."""
    for name in ("attract", "attract_line"):
        at = pull(name, (0, 0, 2), strength=8, falloff=falloff, softening=0)
        np.testing.assert_allclose(at, [0, 0, -wanted], rtol=1e-15)


def test_softening_rounds_off():
    """At distance r = 3 with softening 4 the pull is strength r / 5^3; at the point itself it is 0."""
    np.testing.assert_allclose(pull("attract", (3, 0, 0), strength=125, softening=4), [-3, 0, 0], rtol=1e-15)
    for softening in (0, 0.1):
        assert not pull("attract", (0, 0, 0), softening=softening).any()
        assert not pull("attract_line", (0, 5, 0), softening=softening).any()


def test_line_pulls_across_itself():
    """Only the part across the line counts, wherever along it the particle is."""
    given = {"point": (1, 0, 0), "axis": (0, 0, 1), "strength": 6, "falloff": 1, "softening": 0}
    for z in (-7, 0, 100):
        np.testing.assert_allclose(pull("attract_line", (1, 3, z), **given), [0, -2, 0], rtol=1e-15)


@pytest.mark.parametrize("name", ["attract", "attract_line"])
def test_a_force_is_divided_by_the_mass(name):
    """A = F / m where strength is a force; else the mass does not matter."""
    light, heavy = (pull(name, (2, 0, 1), mass=mass, as_force=True) for mass in (0.5, 4.0))
    np.testing.assert_allclose(light, heavy * 8, rtol=1e-15)
    assert (pull(name, (2, 0, 1), mass=0.5) == pull(name, (2, 0, 1), mass=4.0)).all()


@pytest.mark.parametrize("name", ["attract", "attract_line"])
@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_whole_range_is_finite(name, kind):
    """At the ends of every declared range, from 1e-30 to 1e18 m away, the pull is finite and towards the point or away."""
    for strength, falloff, softening, distance in product((-1e12, 1e12), (0, 0.5, 8), (0, 1e-20, 1e6), (0, 1e-30, 1e-9, 1, 1e18)):
        at = pull(name, (distance, 0, 0), kind=kind, strength=strength, falloff=falloff, softening=softening)
        assert np.isfinite(at).all() and at[0] * strength <= 0, (strength, falloff, softening, distance)


def test_circular_orbit():
    """At the speed sqrt(g m r^2 / (r^2 + s^2)^1.5) a particle goes round: back after a period; composed, at an order of 2."""
    speed = 1.01**-0.75
    period = 2 * np.pi / speed
    op = {"type": "attract", "strength": 1.0, "softening": 0.1}
    errors = []
    for steps in (100, 200, 400):
        position, _ = end_of([op], (1, 0, 0), (0, speed, 0), period, steps, method="strang")
        errors.append(np.linalg.norm(position - [1, 0, 0]))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert errors[-1] < 1e-3 and (orders > 1.9).all()


def test_plunge_into_a_softened_point_stays_finite():
    """A particle dropped straight into an attractor oscillates through it and does not fly away."""
    position, velocity = path([{"type": "attract", "strength": 10.0}], (1, 0, 0), frames=240, substeps=8)
    assert np.isfinite(position).all() and np.abs(position).max() <= 1.2
    assert np.abs(vector(*velocity[-1]).y) == 0


def test_line_orbit_is_a_helix():
    """Round a line a particle circles at the speed sqrt(strength) with falloff 1, and keeps its pace along it."""
    position, velocity = path([{"type": "attract_line", "strength": 4.0, "softening": 0}], (1.5, 0, 0), (0, 0.7, 2), substeps=64)
    np.testing.assert_allclose(np.hypot(position[:, 0], position[:, 2]), 1.5, rtol=1e-4)
    np.testing.assert_allclose(velocity[:, 1], 0.7, rtol=1e-13)
