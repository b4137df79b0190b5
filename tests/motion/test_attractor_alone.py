"""An attractor without softening, alone: its orbit is the motion, in cooks of many particles and between bounces."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.plan.movers import mover_of

from .one_particle import LIBRARY, effect_of, path
from .orbit_reference import errors

PULL = {"type": "attract", "strength": 10, "softening": 0}


def plan_of(*ops: Any, **more: Any) -> Any:
    """Return the plan of one particle under operators."""
    return effect_of(list(ops), (1, 0, 0), (0, 1, 0), **{"method": "auto", **more}).plan.emitters["one"]


def test_reason():
    """The plan says that the method is exact, and by what."""
    told = plan_of(PULL)
    assert (told.method, told.reason) == (
        "exact",
        "one acceleration with an exact flow (attract): its orbit, by universal variables",
    )


@pytest.mark.parametrize(
    "ops",
    [
        [PULL, {"type": "gravity"}],
        [PULL, PULL],
        [PULL | {"softening": 0.1}],
        [PULL | {"falloff": 1}],
        [PULL | {"strength": {"keys": [[0, 1], [1, 2]]}}],
        [PULL | {"strength": {"expr": "1 + dot(position, position)"}}],
        [PULL | {"during": [0, 0.5]}],
        [PULL | {"only": {"expr": "mass > 1"}}],
        [PULL, {"type": "random_acceleration"}],
    ],
    ids=["gravity", "two", "softening", "falloff", "keys", "expression", "during", "only", "noise"],
)
def test_not_alone(ops):
    """With anything else that acts, with softening, another falloff, a strength that changes or a condition, it is not exact."""
    assert plan_of(*ops).method != "exact"


def test_asked_for():
    """Where `strang` is asked for, the pull is an acceleration; where `exact` is, its orbit will do."""
    assert plan_of(PULL, method="strang").method == "strang"
    assert plan_of(PULL, method="exact").method == "exact"


@pytest.mark.parametrize("as_force, mass", [(False, 4.0), (True, 4.0)])
def test_path_is_the_orbit(as_force, mass):
    """Frame after frame a particle is where its orbit is, about a centre anywhere, and a force is divided by its mass."""
    center, start, velocity = np.array([1.0, -2, 0.5]), np.array([3.0, -2, 0.5]), np.array([0, 1.5, 0.25])
    op = PULL | {"center": center.tolist(), "as_force": as_force}
    position, speed = path([op], start, velocity, mass=mass, method="auto")
    strength = 10 / mass if as_force else 10
    for frame in (1, 7, 24):
        found = errors((position[frame] - center, speed[frame]), start - center, velocity, strength, frame / 24)
        assert max(found) <= 1e-13


def plunging(bits: int) -> Effect:
    """Return the effect of 2000 particles that fall almost straight into an attractor."""
    document = {
        "graphfx": 1,
        "seed": 7,
        "time": {"fps": 24, "frames": [0, 240], "precision": bits},
        "nodes": {
            "dust": {
                "type": "emit",
                "count": 2000,
                "set": {
                    "position": {"in_sphere": {"radius": 2.0}},
                    "velocity": {"in_box": {"min": [-0.01] * 3, "max": [0.01] * 3}},
                },
            },
            "fall": {"type": "stack", "from": "dust", "ops": [PULL]},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "fall", "camera": "view", "shutter": 0},
        },
    }
    return Effect(flatten(document_of(document), LIBRARY))


def energies(simulation: Any) -> tuple[np.ndarray, np.ndarray]:
    """Return the energy of every particle, and its distance."""
    particles = simulation.particles["dust"]
    assert particles.store.count == 2000
    both = [[np.asarray(part)[:2000] for part in particles.value(name)] for name in ("position", "velocity")]
    place, speed = np.array(both, np.longdouble)
    distance = np.sqrt((place**2).sum(0))
    return (speed**2).sum(0) / 2 - 10 / distance, distance


@pytest.mark.parametrize("bits", [32, 64])
def test_plunges(bits):
    """Of 2000 near-radial plunges in 10 s at 24 fps none is flung; p95 of the energy's relative error is below 1e-9.

    In float32 it is below 1000 eps.
    """
    found = plunging(bits)
    simulation = found.simulation()
    frames = iter(simulation.frames(found.flat.time.last))
    next(frames)
    first, _ = energies(simulation)
    worst = np.zeros(2000)
    for _ in frames:
        energy, distance = energies(simulation)
        assert (distance <= 1.01 * -10 / first).all()
        worst = np.maximum(worst, np.abs(energy / first - 1).astype(float))
    bound = 1e-9 if bits == 64 else 1000 * np.finfo(np.float32).eps
    assert np.quantile(worst, 0.95) <= bound and worst.max() <= 20 * bound


@pytest.mark.parametrize("speed", [0.0, 0.5, 30.0])
def test_repulsion(speed):
    """From a point that repels, particles are driven off on their orbit, to 1e-10 and far below."""
    position, velocity = path([PULL | {"strength": -10}], (1, 0.5, 0), (-speed, 0, 0), frames=48, method="auto")
    for frame in (1, 5, 48):
        assert max(errors((position[frame], velocity[frame]), (1, 0.5, 0), (-speed, 0, 0), -10, frame / 24)) <= 1e-13


@pytest.mark.parametrize("fps", [12, 24, 60])
def test_bounces_are_found_along_the_orbit(fps):
    """A ball that falls from rest to a floor under which an attractor stands rises to where it came from, at any step."""
    ops = [PULL | {"center": [0, -1, 0]}, {"type": "bounce_plane", "resilience": 1}]
    assert plan_of(*ops).method == "exact"
    position, velocity = path(ops, (0.3, 1, 0), fps=fps, frames=10 * fps, method="auto")
    arm = position - [0, -1, 0]
    energy = (velocity**2).sum(1) / 2 - 10 / np.linalg.norm(arm, axis=1)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-11)
    assert (position[:, 1] >= 0).all() and position[:, 1].min() < 0.1 and np.ptp(np.sign(velocity[:, 1])) == 2


def test_fall_time_to_a_floor():
    """Straight down to a floor half way the fall takes (pi/4 + 1/2) sqrt(r^3 / 2 mu), and the way up takes the same."""
    strength, half = 8.0, (np.pi / 4 + 0.5) * np.sqrt(2.0**3 / 16)
    ops = [PULL | {"strength": strength, "center": [0, -1, 0]}, {"type": "bounce_plane", "resilience": 1}]
    position, velocity = path(ops, (0, 1, 0), fps=8, frames=40, method="auto")
    for frame in range(41):
        since = abs((frame * 0.125 + half) % (2 * half) - half)
        if 0 < since < half * 0.999:
            found = position[frame] - [0, -1, 0], velocity[frame]
            assert errors(found, (0, 2, 0), (0, 0, 0), strength, since)[0] <= 1e-11


def test_orbit_beside_the_acceleration():
    """An attractor stays an acceleration; its orbit stands beside it, for what is composed with others."""
    effect = effect_of([PULL], (1, 0, 0))
    node = next(node for node in effect.flat.nodes.values() if node.node_type.name == "attract")
    mover = mover_of(node)
    assert mover.role == "acceleration" and mover.whole is not None and mover.whole.carries and mover.whole.time_free
