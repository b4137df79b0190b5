"""What operators reach, against rates found by hand; and energy, where there is one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphfx.cook.trial import Trials
from graphfx.study.stiffness import Scene, Stiffness

from .problems import flat_of

CLOUD = {"count": 20, "set": {"position": {"in_box": {}}, "velocity": [1, 0, 0], "rest_position": [0, 0, 0]}}
NEAR = {"count": 4, "set": {"position": [1, 0, 0], "velocity": [0, 1, 0]}}
H = 1 / 24


def scene(ops, emit=CLOUD, **keys) -> Scene:
    return Scene(flat_of(ops, emit, **keys), None, 6)


@pytest.mark.parametrize("op, w, d, s", [
    ({"type": "spring", "frequency": 10, "damping_ratio": 0.1}, 10, 2, 0),
    ({"type": "damp", "damping": 3}, 0, 3, 0),
    ({"type": "damp", "damping": 3, "threshold": 0.1}, 0, 3, 0),
    ({"type": "spiral", "speed": 5}, 0, 0, 5),
    ({"type": "rotate", "speed": 7}, 0, 0, 7),
    ({"type": "gravity"}, 0, 0, 0),
])
def test_rates_are_those_of_the_operators(op, w, d, s):
    """A spring of 10 rad/s and 10 % has w = 10, d = 2; damping, turning of the velocity and rotation are what they state."""
    found = scene([op]).reached[0]
    assert (found.w, found.d, found.s) == pytest.approx((w * H, d * H, s * H), rel=1e-3, abs=1e-6)


def test_rates_grow_near_what_pulls():
    """At 1 m from an unsoftened attractor of 9 m/s^2 the tidal rate is sqrt(2 9), to the nearest that the orbit comes."""
    pull = {"type": "attract", "strength": 9, "softening": 0}
    orbit = {"count": 4, "set": {"position": [1, 0, 0], "velocity": [0, 3, 0]}}
    assert scene([pull], orbit).reached[0].w == pytest.approx(18**0.5 * H, rel=1e-2)


def test_idle_conditions_have_no_rate():
    """Where an operator acts on nobody, nothing is reached."""
    op = {"type": "spring", "frequency": 10, "only": {"inside_sphere": {"center": [99, 0, 0], "radius": 1}}}
    assert scene([op]).reached[0].w == 0


def test_steps_that_are_stable():
    """w h = 5 takes 3 steps of strang and 6 of rk45; undamped, sims never is stable; flows and linear motion have no limit."""
    pull = Stiffness("a", "b", "attract", exact=False, w=5.0)
    assert (pull.strang, pull.rk45, pull.sims) == (3, 6, None)
    assert replace(pull, exact=True).strang == 1
    assert Stiffness("a", "b", "damp", exact=True, d=6.7).rk45 == 3
    assert Stiffness("a", "b", "damp", exact=True, d=6.7).sims == 4


@pytest.mark.parametrize("ops, kept", [
    ([{"type": "attract"}], True),
    ([{"type": "attract", "softening": 0}], True),
    ([{"type": "attract", "softening": 0}, {"type": "gravity"}], True),
    ([{"type": "attract"}, {"type": "gravity"}, {"type": "spring", "damping_ratio": 0}], True),
    ([{"type": "attract"}, {"type": "damp"}], False),
    ([{"type": "vortex"}], False),
    ([{"type": "turbulence"}], False),
    ([{"type": "attract", "strength": {"expr": "1 + time"}}], False),
    ([{"type": "attract"}, {"type": "bounce_plane"}], False),
    ([{"type": "attract"}, {"type": "random_acceleration"}], False),
])
def test_energy_is_kept_where_there_is_a_potential(ops, kept):
    """Pulls, gravity and undamped springs keep energy; damping, turbulence, noise, surfaces and pulls that change do not."""
    assert scene(ops, NEAR).conserved() == (["dots"] if kept else [])


def test_energy_drift_is_the_difference_of_energies():
    """Around a softened attractor, E - E_true is what V^2 / 2 - g / sqrt(r^2 + s^2) says."""
    flat = flat_of([{"type": "attract", "strength": 4, "softening": 0.5}], NEAR)
    runs = {steps: Trials(replace(flat, time=replace(flat.time, method="strang", substeps=steps, precision=64))).run([6])
            for steps in (1, 64)}
    true, other = runs[64].states["dots"][6], runs[1].states["dots"][6]

    def energy(states):
        return np.sum(states.velocity**2, axis=1) / 2 - 4 / np.sqrt(np.sum(states.position**2, axis=1) + 0.25)

    wanted = np.sqrt(np.mean((energy(other) - energy(true)) ** 2)) / np.mean(np.sum(true.velocity**2, axis=1) / 2)
    assert Scene(flat, None, 6).drift("dots", true, other) == pytest.approx(wanted, rel=1e-3)
    assert wanted > 1e-6
