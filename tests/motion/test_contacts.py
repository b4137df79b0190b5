"""Contacts: found at their instant, answered there, and rest where they should."""

from __future__ import annotations

import numpy as np
import pytest

from .many_particles import walk
from .one_particle import effect_of, path

G = 9.81
GRAVITY = {"type": "gravity"}


def plane(resilience: float, friction: float = 0.0, **more) -> dict:
    return {"type": "bounce_plane", "resilience": resilience, "friction": friction, **more}


def test_ball_keeps_its_height():
    """With resilience 1 the energy after 11 bounces is that at the start, to 1e-10."""
    position, velocity = path([GRAVITY, plane(1)], (0, 1, 0), (0.3, 0, 0), frames=240)
    energy = velocity[:, 1] ** 2 / 2 + G * position[:, 1]
    bounces = int((10 / np.sqrt(2 / G) + 1) / 2)
    assert bounces == 11 and np.abs(energy / G - 1).max() <= 1e-10
    assert position[:, 1].min() >= 0 and np.allclose(position[:, 0], 0.3 * np.arange(241) / 24, rtol=1e-13)


@pytest.mark.parametrize("substeps", [1, 3])
@pytest.mark.parametrize("fps", [24, 7, 240])
def test_ball_is_where_the_closed_form_says(fps, substeps):
    """With resilience .5 a ball is on the parabola of its bounce at every frame, whatever the frames and steps."""
    frames = int(1.2 * fps)
    position, _ = path([GRAVITY, plane(0.5)], (0, 1, 0), fps=fps, frames=frames, substeps=substeps)
    wanted = []
    for t in np.arange(frames + 1) / fps:
        y, v, left = 1.0, 0.0, t
        while (land := (v + np.sqrt(v * v + 2 * G * y)) / G) < left:
            y, v, left = 0.0, 0.5 * (G * land - v), left - land
        wanted.append(y + v * left - G * left * left / 2)
    np.testing.assert_allclose(position[:, 1], wanted, rtol=0, atol=1e-10)


@pytest.mark.parametrize("resilience", [0.5, 0.9])
def test_ball_comes_to_rest(resilience):
    """When its bounces are over a ball lies on the plane with no velocity, and stays to the last bit."""
    first = np.sqrt(2 / G)
    end = first + 2 * first * resilience / (1 - resilience)
    position, velocity = path([GRAVITY, plane(resilience)], (0, 1, 0), frames=int(end * 24) + 24)
    assert np.abs(position[-20:, 1]).max() <= 1e-15 and np.abs(velocity[-20:, 1]).max() <= 1e-15
    assert (velocity[: int(first * 24), 1] < 0)[1:].all()


def test_sticks_at_the_first_contact():
    """With no resilience and full friction a particle rests exactly where its path meets the plane, and never moves."""
    position, velocity = path([GRAVITY, plane(0, 1)], (0, 1, 0), (2, 0, -1))
    t = np.sqrt(2 / G)
    after = int(t * 24) + 1
    np.testing.assert_allclose(position[after], [2 * t, 0, -t], rtol=0, atol=1e-12)
    assert (position[after:] == position[after]).all() and not velocity[after:].any()


@pytest.mark.parametrize("slope", [0.1, 0.7, 1.2])
def test_slides_down_a_slope(slope):
    """Without friction and resilience a particle slides along a slope with g sin(slope), on the plane."""
    n = np.array([np.sin(slope), np.cos(slope), 0])
    down = np.array([np.cos(slope), -np.sin(slope), 0])
    position, velocity = path([GRAVITY, plane(0, normal=n.tolist())], (0, 0, 0), frames=48)
    t = np.arange(49) / 24
    wanted = np.outer(G * np.sin(slope) * t**2 / 2, down)
    np.testing.assert_allclose(position, wanted, rtol=0, atol=1e-11)
    np.testing.assert_allclose(velocity, np.outer(G * np.sin(slope) * t, down), rtol=0, atol=1e-11)
    assert np.abs(position @ n).max() <= 1e-12


def test_flat_plane_holds_a_sliding_particle():
    """On a level plane without friction a particle that falls on it goes on at its speed along it."""
    position, velocity = path([GRAVITY, plane(0)], (0, 0.5, 0), (3, 0, 1))
    assert position[-1, 1] == 0 and np.allclose(velocity[-1], [3, 0, 1], rtol=1e-14)
    np.testing.assert_allclose(position[-1], [3, 0, 1], rtol=1e-13, atol=1e-13)


def test_corner_reverses_the_velocity():
    """Two planes at right angles with resilience 1 send a particle back the way it came, into the very corner as well."""
    planes = [plane(1, normal=[1, 0, 0]), plane(1, id="floor", normal=[0, 1, 0])]
    for start in ((0.5, 0.4, 0), (0.5, 0.5, 0), (0.3, 0.4, 0)):
        position, velocity = path(planes, start, (-3, -3, 0))
        assert np.abs(velocity[-1] - [3, 3, 0]).max() <= 1e-13
        time = 1.0 - start[0] / 3, 1.0 - start[1] / 3
        np.testing.assert_allclose(position[-1], [3 * time[0], 3 * time[1], 0], rtol=0, atol=1e-12)


def test_friction_takes_its_share_once():
    """At a contact with friction mu and resilience eps: V' = (1 - mu) Vt - eps Vn, whatever the steps."""
    for fps in (24, 60, 240):
        _, velocity = path([plane(0.7, 0.3)], (0, 1, 0), (2, -4, 1), fps=fps, frames=fps)
        np.testing.assert_allclose(velocity[-1], [1.4, 2.8, 0.7], rtol=1e-14)


def test_friction_threshold():
    """Friction does not act on a particle slower than its threshold."""
    for threshold, along in ((10, 2.0), (1, 1.0)):
        _, velocity = path([plane(1, 0.5, friction_threshold=threshold)], (0, 1, 0), (2, -4, 0))
        np.testing.assert_allclose(velocity[-1], [along, 4, 0], rtol=1e-14)


@pytest.mark.parametrize("offset", [0.0, 0.3, 0.9, 0.999])
def test_sphere_reflects_about_its_normal(offset):
    """A particle meets a sphere where the line does, and leaves by the mirror of its velocity."""
    _, velocity = path([{"type": "bounce_sphere", "resilience": 1}], (-3, offset, 0), (5, 0, 0), frames=24)
    n = np.array([-np.sqrt(1 - offset**2), offset, 0])
    np.testing.assert_allclose(velocity[-1], np.array([5, 0, 0]) - 2 * 5 * n[0] * n, rtol=0, atol=1e-11)


def test_sphere_that_is_missed_changes_nothing():
    """A particle that passes by is not deflected."""
    position, velocity = path([{"type": "bounce_sphere", "resilience": 1}], (-3, 1.001, 0), (5, 0, 0))
    assert (velocity == [5, 0, 0]).all() and np.allclose(position[-1], [2, 1.001, 0])


def test_started_inside_is_put_on_the_surface():
    """A particle born inside a solid is put on its surface and answers the contact there."""
    position, velocity = path([plane(0.5)], (1, -0.25, 0), (1, -2, 0), frames=2)
    np.testing.assert_allclose(velocity[1:], [[1, 1, 0]] * 2, rtol=1e-14)
    np.testing.assert_allclose(position[1], [1 + 1 / 24, 1 / 24, 0], rtol=1e-13)


def test_started_on_the_surface_and_leaving():
    """A particle that starts on a surface and leaves it is not held."""
    _, velocity = path([plane(0.5)], (0, 0, 0), (1, 2, 0))
    assert (velocity == [1, 2, 0]).all()


@pytest.mark.parametrize("order", [1, -1])
def test_the_earliest_surface_is_met_first(order):
    """Of two surfaces in one step the nearer answers first, in whatever order the stack names them."""
    near = plane(0, 1, id="near", point=[0, 0.5, 0])
    far = plane(1, id="far")
    position, velocity = path([near, far][::order], (0, 1, 0), (0, -1000, 0), frames=3)
    np.testing.assert_allclose(position[1:], [[0, 0.5, 0]] * 3, rtol=0, atol=1e-12)
    assert not velocity[1:].any()


def test_both_surfaces_in_one_step():
    """A particle that meets a wall and then the floor within a step answers both, at their own instants."""
    surfaces = [plane(1, id="wall", normal=[-1, 0, 0], point=[1, 0, 0]), plane(0.5, id="floor")]
    position, velocity = path(surfaces, (0, 1, 0), (10, -5, 0), fps=1, frames=1)
    np.testing.assert_allclose(velocity[-1], [-10, 2.5, 0], rtol=1e-13)
    np.testing.assert_allclose(position[-1], [2 - 10, (1 - 0.2) * 2.5, 0], rtol=1e-12)


@pytest.mark.parametrize("speed", [1e3, 1e5, 1e8])
def test_fast_particle_does_not_pass_a_plane(speed):
    """However fast, a particle meets the plane where its path does."""
    position, velocity = path([plane(1)], (0, 1, 0), (speed, -speed, 0), frames=2)
    np.testing.assert_allclose(velocity[1:], [[speed, speed, 0]] * 2, rtol=1e-12)
    np.testing.assert_allclose(position[1], [speed / 24, speed / 24 - 1, 0], rtol=1e-9)


@pytest.mark.parametrize("radius, speed", [(1e-3, 1e3), (0.1, 100.0)])
def test_fast_particle_does_not_pass_a_small_sphere(radius, speed):
    """A fast particle that goes straight through a small sphere within a step bounces off it."""
    _, velocity = path([{"type": "bounce_sphere", "sphere_radius": radius, "resilience": 1}], (-speed / 50, 0, 0), (speed, 0, 0))
    np.testing.assert_allclose(velocity[-1], [-speed, 0, 0], rtol=1e-9)


def test_too_many_contacts_are_reported_and_rest():
    """A particle that rattles between two plates more often than is counted rests there, and is reported."""
    plates = [plane(1, id="low"), plane(1, id="high", normal=[0, -1, 0], point=[0, 1e-3, 0])]
    found = effect_of(plates, (0, 5e-4, 0), (0, 10, 0), frames=4)
    simulation = found.simulation()
    for _ in simulation.frames(4):
        pass
    particles = simulation.particles["one"]
    assert particles.unfinished == 1 and particles.store.column("resting")[0].tolist() == [1]
    assert 0 <= particles.store.column("position")[1][0] <= 1e-3


def test_infinitely_many_bounces_end():
    """With a rest speed of 0 a ball with resilience .5 has infinitely many bounces; it ends on the plane, finite."""
    position, velocity = path([GRAVITY, plane(0.5, rest_speed=0)], (0, 1, 0), frames=48)
    assert np.isfinite(position).all() and np.abs(position[-1]).max() <= 1e-9 and np.abs(velocity[-1]).max() <= 1e-6


def test_contact_under_damping_and_turning():
    """With all linear operators at work the contact is on the surface, at the same place for 24 and 240 frames."""
    ops = [GRAVITY, {"type": "damp", "damping": 1.5}, {"type": "spiral", "speed": 4}, plane(0, 1)]
    ends = [path(ops, (0, 2, 0), (1, 1, 0), fps=fps, frames=2 * fps, spiral_axis=[0.2, 1, 0.1])[0][-1] for fps in (24, 240)]
    np.testing.assert_allclose(ends[0], ends[1], rtol=0, atol=1e-11)
    assert abs(ends[0][1]) <= 1e-14


def test_a_contact_at_the_very_end_of_a_frame_is_one():
    """Of 20,000 particles that meet a sphere within the rounding of a frame's end each bounces on, and none is held."""
    count, fps = 20_000, 24
    chance = np.random.default_rng(1)
    polar, azimuth = chance.uniform(0, 1.2, count), chance.uniform(0, 2 * np.pi, count)
    normal = np.stack([np.sin(polar) * np.cos(azimuth), np.cos(polar), np.sin(polar) * np.sin(azimuth)], 1)
    center, velocity = np.array([1.75, 4.85, -0.55]), np.array([-0.1, -8.15, 0.25]) + chance.normal(0, 0.3, (count, 3))
    time = (1 / fps + chance.uniform(-2e-7, 2e-7, count))[:, None]
    start = center + 0.8 * normal - velocity * time + np.array([0, G / 2, 0]) * time**2
    ball = {"type": "bounce_sphere", "center": list(center), "sphere_radius": 0.8, "friction": 0.3}
    *_, simulation = walk([GRAVITY, ball], start, velocity, frames=2, precision=32)
    assert not simulation.particles["one"].store.column("resting")[0][:count].any()
