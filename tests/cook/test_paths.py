"""The ways of particles while the shutter is open: bends at hits, looks along them, whatever runs the programs."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.cook.pictures import draw, window_of
from graphfx.cook.streaks import streaks_of
from graphfx.plan.knots import MOST_KNOTS
from graphfx.render.camera import Camera
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks

from .effects import made
from .exposures import FLOOR, LOOK, ONE, pieces, scene, ways
from .test_reference import MOVING, SURFACES


@pytest.mark.parametrize("streak", ["exposed", "solid"])
@pytest.mark.parametrize("substeps", [1, 3])
def test_bounce_is_the_picture_of_two_straight_pieces(streak, substeps):
    """A bounce halfway through the shutter looks as its two known straight ways do, each for half of the time.

    Solid they are one body, in which each pixel is nearest to one of them.
    """
    found = scene([FLOOR], ONE, look={"streak": streak}, substeps=substeps)
    corners = np.float32([[1.5, 0.75, 0], [1, 0, 1], [0, 0, 0]])
    joints = np.float32([2, 1] if streak == "solid" else [0, 0])
    known = Streaks(corners[:, :2], corners[:, 1:], 0.1, head_opacity=0.5, part=0.5, joined=joints, streak=streak)
    camera = Camera((0, 1, 10), (0, 1, 0), projection="orthographic", view_width=8, near=0.01)
    wanted = render([known], camera, None, 64, 48)
    np.testing.assert_allclose(found.film(2).pixels, wanted.pixels, rtol=0, atol=1e-5)
    assert ways(found, 2) == [((0.75, 0, 0), (1.5, 1, 0), 0.5), ((0, 1, 0), (0.75, 0, 0), 0.5)]


@pytest.mark.parametrize("substeps", [1, 4])
def test_several_bounces_are_as_many_pieces(substeps):
    """Between a floor and a ceiling three hits in a frame make four pieces, whose parts sum to the whole."""
    ceiling = {"type": "bounce_plane", "id": "ceiling", "resilience": 1, "normal": [0, -1, 0], "point": [0, 2, 0]}
    found = scene([FLOOR, ceiling], {"count": 1, "set": LOOK | {"velocity": [1, -12, 0]}}, substeps=substeps)
    told = ways(found, 2)
    assert len(told) == 4 and sum(each[2] for each in told) == pytest.approx(1, abs=3e-4)
    assert [each[1][:2] for each in told] == [(0.5, 1), (0.4167, 0), (0.25, 2), (0.0833, 0)]


def test_many_bounces_keep_the_first_and_the_last():
    """Of more hits than are kept in a run the first ones and the last are exact, and all the time is there."""
    ceiling = {"type": "bounce_plane", "id": "ceiling", "resilience": 1, "normal": [0, -1, 0], "point": [0, 2, 0]}
    found = scene([FLOOR, ceiling], {"count": 1, "set": LOOK | {"velocity": [1, -84, 0]}})
    told = ways(found, 2)
    hits = [1 / 84 + k * 2 / 84 for k in range(21)]
    assert len(told) == MOST_KNOTS + 1
    assert [each[0][0] for each in told[:-1]] == pytest.approx([hits[20], *hits[6::-1]], abs=1e-4)
    assert sum(each[2] for each in told) == pytest.approx(1, abs=1e-3)


def test_pieces_look_as_their_own_particle():
    """Each piece has the radius, colour and opacity of the particle whose way it is part of."""
    own: dict[str, Any] = {"radius": {"rand": [0.02, 0.06]}, "color": {"rand": [[0, 0, 0], [1, 1, 1]]}}
    own["position"] = {"in_box": {"min": [-1, 1, 0]}}
    found = scene([{"type": "gravity"}, FLOOR], {"count": 20, "set": LOOK | own}, 2.5)
    simulation = found.simulation()
    for _ in simulation.frames(4):
        pass
    sky, window = simulation.particles["sky"], window_of(found.plan.images[0], simulation, 4)
    whole = {name: np.stack(sky.store.column(name)) for name in ("radius", "color", "position")}
    for shown in streaks_of(sky, None, {}, window, False):
        if shown.streaks.count:
            np.testing.assert_array_equal(np.atleast_2d(shown.streaks.head_radius), whole["radius"][:, shown.rows])
            np.testing.assert_array_equal(np.stack(shown.streaks.head_color), whole["color"][:, shown.rows])
    assert shown.streaks.count > 40 and (np.diff(shown.rows) >= 0).all()


def test_bends_that_do_not_show_cost_nothing():
    """A hit that a straight way passes within half a radius is left out; a large ball that jumps a little is one streak."""
    half_as_far = {"position": [0, 0.5, 0], "velocity": [1.5, -2, 0]}
    told = [ways(scene([FLOOR], {"count": 1, "set": LOOK | half_as_far | {"radius": radius}}), 2) for radius in (1.1, 0.9)]
    assert [len(each) for each in told] == [1, 2]


@pytest.mark.parametrize("response, count", [("stick", 2), ("die", 1), ("slide", 2)])
def test_what_happens_at_a_hit_is_seen(response, count):
    """What sticks rests for the other half of the time, what dies is gone, and what slides turns the corner."""
    told = ways(scene([{"type": "bounce_plane", "response": response}], ONE), 2)
    assert len(told) == count and told[-1] == ((0, 1, 0), (0.75, 0, 0), 0.5)
    assert response != "stick" or told[0] == ((0.75, 0, 0), (0.75, 0, 0), 0.5)
    assert response != "slide" or told[0] == ((0.75, 0, 0), (1.5, 0, 0), 0.5)


def test_solid_streak_that_stops_is_no_brighter_there():
    """The stop of a solid streak lies in its cap, and is not drawn again."""
    assert len(ways(scene([{"type": "bounce_plane", "response": "stick"}], ONE, look={"streak": "solid"}), 2)) == 1


@pytest.mark.parametrize("falloff", ["linear", "gaussian", "disc"])
def test_total_light_of_a_bouncing_particle_is_that_of_a_still_one(falloff):
    """Exposed, whatever the particle does while the shutter is open sends the same light."""
    look = {"blend": "add", "falloff": falloff}
    lights = []
    for op, velocity in ((FLOOR, [3, -4, 0]), (FLOOR, [0, 0, 0]), (FLOOR | {"resilience": 0.5, "friction": 0.5}, [3, -4, 0])):
        emit = {"count": 1, "set": LOOK | {"velocity": velocity, "radius": 0.25}}
        lights.append(scene([op], emit, look=look).film(2).pixels[..., 0].sum(dtype=float))
    assert lights == pytest.approx([lights[1]] * 3, rel=0.02)


def test_colours_run_along_all_pieces():
    """What the tail has of its own runs evenly in time from tail to head, through the bend."""
    ops = [FLOOR, {"type": "set", "set": {"tail.radius": 0.3, "tail.opacity": 0.1}}]
    (both,) = pieces(scene(ops, ONE), 2)
    told = [both.head_radius, both.tail_radius, both.head_opacity, both.tail_opacity]
    np.testing.assert_allclose(told, [[0.1, 0.2], [0.2, 0.3], [0.5, 0.3], [0.3, 0.1]], atol=1e-6)


def test_moving_camera_sees_a_bend_as_it_stands_then():
    """A particle that bounces in its own place, seen by a camera that goes aside, bends in the picture's middle in time."""
    camera = {"position": {"keys": [[0, [0, 1, 10]], [1, [4, 1, 10]]]}, "target": {"keys": [[0, [0, 1, 0]], [1, [4, 1, 0]]]}}
    emit = {"count": 1, "set": LOOK | {"velocity": [0, -4, 0]}}
    alpha = scene([FLOOR], emit, camera=camera).film(2).pixels[..., 3]
    columns = np.flatnonzero(alpha.max(axis=0) > 0)
    lowest = np.unravel_index(np.argmax(np.arange(48)[:, None] * (alpha > 0.01)), alpha.shape)
    assert columns.min() in (14, 15) and columns.max() in (32, 33) and abs(lowest[1] - 24) <= 1


CASES = {
    "bounces": (SURFACES, {"rate": 200, "life": {"rand": [0.02, 0.2]}, "set": MOVING}, {"shutter": 0.9}),
    "three frames": (
        [*SURFACES, {"type": "recycle"}], {"rate": 100, "life": {"rand": [0.02, 0.3]}, "set": MOVING}, {"shutter": 2.6},
    ),
    "phases": (SURFACES, {"rate": 100, "life": {"rand": [0.1, 0.3]}, "set": MOVING}, {"shutter": 0.7, "phase": 0.55}),
    "set": (
        [
            {"type": "transform", "angle": {"expr": "time * 300"}},
            {"type": "set", "only": {"expr": "age > 0.1"}, "set": {"radius": 0.2}},
        ],
        {"rate": 100, "life": {"rand": [0.05, 0.3]}, "set": MOVING}, {"shutter": 1.6, "phase": 0.1},
    ),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("precision", [32, 64])
def test_machine_and_plain_python_give_the_same_streaks(case, precision):
    """Every number of every streak has the same bits by both ways, on any threads."""
    ops, emit, image = CASES[case]
    found = made(ops, emit, {"fps": 12, "frames": [1, 6], "substeps": 2, "precision": precision}, image)
    for frame in (2, 6):
        told = [
            [column.tobytes() for streaks in pieces(found, frame, **how) for column in streaks.columns(0, streaks.count)]
            for how in ({"threads": 2}, {"reference": True})
        ]
        assert told[0] == told[1] and any(told[0])


def test_threads_change_no_byte_of_a_film():
    """Pictures of bent ways over frames are the same on any threads."""
    ops, emit, image = CASES["three frames"]
    found = made(ops, emit, {"fps": 12, "frames": [1, 6]}, image)
    assert len({found.film(6, threads=threads).pixels.tobytes() for threads in (1, 2, 5)}) == 1


@pytest.mark.parametrize("name", ["position", "radius", "color", "opacity", "tail.radius", "tail.color"])
def test_not_finite_particles_are_dropped_once(name):
    """A particle of which a number is none is dropped and counted once, however many pieces its way would have."""
    value = {"expr": "vec(1, 1, 1) / (time - time)" if name in ("position", "color", "tail.color") else "sqrt(time - time - 1)"}
    wrong = {"type": "set", "only": {"share": {"fraction": 0.5}}, "set": {name: value}}
    found = made(
        [{"type": "gravity"}, FLOOR, wrong], {"rate": 40, "set": LOOK}, {"fps": 4, "frames": [1, 4]}, {"shutter": 2.5}
    )
    simulation = found.simulation()
    for _ in simulation.frames(4):
        pass
    film = draw(found.plan.images[0], simulation, 4, 1)
    broken = sum(~np.isfinite(simulation.particles["sky"].store.column(name)[0]))
    assert 0 < film.dropped == broken


def test_nothing_is_seen_before_the_beginning():
    """While the shutter closes before the simulation begins there is nothing; then the particle's way begins at its birth."""
    found = scene([], ONE, shutter=0.5, phase=3, frames=6)
    assert [bool(film.pixels.any()) for film in (found.film(frame) for frame in range(1, 7))] == [False] * 3 + [True] * 3
