"""A particle that is outside a surface at both ends of a step is seen to have gone through it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.motion.probe import shape_of
from graphfx.plan.values import node_function

from .many_particles import carried, effect_of
from .one_particle import LIBRARY, path
from .test_machine import bits

GRAVITY = {"type": "gravity"}
STICK = {"response": "stick"}


def aimed(count: int, radius: float, speed: float, axis: Any = None) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return (P, V, offset, direction) of ways past the origin, at offsets even over a disc."""
    rng = np.random.default_rng(24)
    along = rng.normal(size=(count, 3)) if axis is None else np.tile(axis, (count, 1)) * 1.0
    along /= np.linalg.norm(along, axis=1)[:, None]
    across = np.cross(along, rng.normal(size=(count, 3)))
    across /= np.linalg.norm(across, axis=1)[:, None]
    offset = across * (radius * np.sqrt(rng.uniform(size=count)))[:, None]
    return offset - along * (speed / 24 * rng.uniform(0.1, 0.9, (count, 1))), along * speed, offset, along


def test_all_hits_of_a_small_sphere_are_found():
    """Of 20 000 particles at 1 km/s all bounce off a sphere of 1 mm, at 24 frames a second; most to 1e-9 of the mirror."""
    radius, speed = 1e-3, 1e3
    position, velocity, offset, along = aimed(20_000, radius, speed)
    sphere = {"type": "bounce_sphere", "sphere_radius": radius, "resilience": 1}
    _, after = carried([sphere], position, velocity, frames=1)
    assert np.count_nonzero(np.abs(after - velocity).max(1) > 1e-9 * speed) == 20_000
    depth = np.sqrt(radius**2 - np.sum(offset**2, axis=1, keepdims=True))
    normal = (offset - along * depth) / radius
    error = np.abs(after - velocity + 2 * normal * np.sum(velocity * normal, axis=1, keepdims=True)).max(1) / speed
    assert np.median(error) <= 1e-10 and error.max() <= 1e-7


@pytest.mark.parametrize("node", [
    {"type": "bounce_box", "size": [2e-3, 2e-3, 2e-3]},
    {"type": "bounce_disc", "disc_radius": 1e-3, "normal": [0.6, 0, 0.8]},
])
def test_all_hits_of_small_things_are_found(node):
    """Of 2000 particles at 1 km/s all bounce off a box and off a disc of 2 mm."""
    position, velocity, *_ = aimed(2000, 1e-3, 1e3, [0.6, 0, 0.8] if "disc_radius" in node else None)
    _, after = carried([node | {"resilience": 1}], position, velocity, frames=1)
    assert (np.abs(after - velocity).max(1) > 1e-3).all()


def test_who_passes_by_is_not_touched():
    """Particles that pass a small sphere by a ten-thousandth of its radius go straight on."""
    position, velocity, offset, _ = aimed(2000, 1e-3, 1e3)
    position += offset * (1.0001e-3 / np.linalg.norm(offset, axis=1) - 1)[:, None]
    _, after = carried([{"type": "bounce_sphere", "sphere_radius": 1e-3}], position, velocity, frames=1)
    assert (after == velocity).all()


def test_a_parabola_meets_the_ceiling_within_a_step():
    """A ball that would rise 5 cm above a ceiling and fall again within one step of a second sticks where it meets it."""
    ceiling = {"type": "bounce_plane", "point": [0, 1, 0], "normal": [0, -1, 0], **STICK}
    position, _ = path([GRAVITY, ceiling], (0, 0, 0), (1, np.sqrt(2 * 9.81 * 1.05), 0), fps=1, frames=1)
    time = (np.sqrt(2 * 9.81 * 1.05) - np.sqrt(2 * 9.81 * 0.05)) / 9.81
    np.testing.assert_allclose(position[-1], [time, 1, 0], rtol=0, atol=1e-12)


SCENES: dict[str, tuple[list[dict[str, Any]], float]] = {
    "ball": ([{"type": "bounce_sphere", "sphere_radius": 0.3}], 12.0),
    "box": ([{"type": "bounce_box", "size": [0.2, 1.0, 0.1]}], 12.0),
    "two": ([{"type": "bounce_sphere", "sphere_radius": 0.2}, {"type": "bounce_box", "center": [1, 0, 0], "size": [0.2] * 3}], 9),
    "hollow ball": ([{"type": "bounce_sphere", "sphere_radius": 2.5, "inside": True}], -3.0),
    "hollow box": ([{"type": "bounce_box", "size": [4.4, 4.4, 4.4], "inside": True}], -3.0),
    "tilted ceiling": ([{"type": "bounce_plane", "point": [0, 2.2, 0], "normal": [0.3, -1, 0]}], -5.0),
}


@pytest.mark.parametrize("scene", SCENES)
def test_long_steps_find_what_short_ones_find(scene):
    """Falling particles stick where they meet a surface, the same for steps of 1/8 s and of 1/512 s, but for one in 500."""
    surfaces, rate = SCENES[scene]
    rng = np.random.default_rng(7)
    position = rng.uniform(-1.5, 1.5, (1000, 3))
    velocity = (rng.normal(size=(1000, 3)) * 0.2 - position) * rate
    ops = [GRAVITY, {"type": "damp", "damping": 0.5}, *(surface | STICK | {"id": f"s{k}"} for k, surface in enumerate(surfaces))]
    coarse, fine = (carried(ops, position, velocity, fps=8, frames=4, substeps=n) for n in (1, 64))
    stuck = ~fine[1].any(axis=1)
    assert np.count_nonzero(stuck) > 50
    apart = np.abs(coarse[0] - fine[0]).max(axis=1) > 1e-8
    assert np.count_nonzero(apart) <= 2


@pytest.mark.parametrize("precision", [32, 64])
def test_machine_is_plain_python(precision):
    """Fast particles among small surfaces, one of them moving, have the same bits by both ways."""
    surfaces = [
        {"type": "bounce_sphere", "sphere_radius": 0.2},
        {"type": "bounce_box", "size": [0.5, 0.1, 0.5], "id": "moves", "center": {"keys": [[0, [0, -1, 0]], [1, [0, 9, 0]]]}},
        {"type": "bounce_box", "size": [6, 6, 6], "inside": True, "id": "walls"},
        {"type": "bounce_plane", "point": [0, 2, 0], "normal": [0, -1, 0.1]},
    ]
    emit = {"set": {"position": {"in_box": {"min": [-2, -2, -2], "max": [2, 1.5, 2]}}, "velocity": {"in_sphere": {"radius": 60}}}}
    found = effect_of([GRAVITY, *surfaces], 40, frames=6, emit=emit, precision=precision)
    machine, plain = found.simulate(6, threads=2)["one"], found.simulate(6, reference=True)["one"]
    assert bits(machine) == bits(plain) and np.isfinite(machine["position"]).all()


@pytest.mark.parametrize("name, truths, shape", [
    ("bounce_plane", (), "plane"),
    ("bounce_sphere", (False,), "convex"),
    ("bounce_sphere", (True,), "hollow"),
    ("bounce_box", (False,), "convex"),
    ("bounce_box", (True,), "hollow"),
])
def test_shapes_of_surfaces(name, truths, shape):
    """The shape of a surface's solid is found from its distances."""
    node_type = LIBRARY[name]
    function = node_function(node_type)
    assert shape_of(function.body, node_type.arguments, function.arguments, truths) == shape


def test_a_ring_has_no_simple_shape():
    """The distance from a ring is neither convex nor concave, and all that go through its hole's rim meet it."""
    from graphfx.math import Vec3, sqrt

    def ring(position: Vec3, size: float) -> tuple[float, Vec3]:
        R = sqrt(position.x * position.x + position.z * position.z)
        return sqrt((R - size) * (R - size) + position.y * position.y) - 0.1, position

    assert shape_of(ring, ("position", "size"), ("vec3", "float"), ()) == ""
