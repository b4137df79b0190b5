"""The ways of particles while the shutter is open: bends, births and deaths, several frames, phases."""

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

from .effects import effect, graph, made
from .test_reference import MOVING, SURFACES

FLOOR = {"type": "bounce_plane", "resilience": 1}
SIDE = {"type": "camera", "projection": "orthographic", "view_width": 8, "position": [0, 1, 10], "target": [0, 1, 0]}
LOOK = {"position": [0, 1, 0], "velocity": [3, -4, 0], "radius": 0.1, "opacity": 0.5}
ONE = {"count": 1, "set": LOOK}


def scene(ops, emit, shutter=1.0, phase=0.0, look=None, camera=None, frames=9, fps=2, **time):
    """Return the effect of a stack seen from the side, two frames a second."""
    image = {
        "from": {"stream": "act" if ops else "sky", **(look or {})}, "camera": "side", "size": [64, 48],
        "shutter": shutter, "phase": phase,
    }
    time = {"fps": fps, "frames": [1, frames], "precision": 64, **time}
    return effect(graph(ops, {"rate": 0, **emit}, time, image, {"side": {**SIDE, **(camera or {})}}))


def pieces(found, frame, **how) -> list[Streaks]:
    """Return the streaks of a frame's picture."""
    simulation = found.simulation(**how)
    for _ in simulation.frames(frame):
        pass
    window, image = window_of(found.plan.images[0], simulation, frame), found.plan.images[0]
    both = [simulation.particles["sky"]] + [past for past in [simulation.particles["sky"].past] if past is not None]
    made = [shown.streaks for each in both for shown in streaks_of(each, None, image.streams[0].looks, window, False)]
    return [streaks for streaks in made if streaks.count]


def ways(found, frame) -> list[tuple[Any, ...]]:
    """Return (tail, head, share of the shutter) of every streak of a frame, the earliest last, rounded."""
    rows = []
    for streaks in pieces(found, frame):
        columns = [np.broadcast_to(column, streaks.count) for column in streaks.columns(0, streaks.count)]
        for i in range(streaks.count):
            numbers = [float(column[i]) for column in columns]
            ends = [tuple(round(number, 4) for number in numbers[first : first + 3]) for first in (3, 0)]
            rows.append((*ends, round(numbers[16] * numbers[17], 4)))
    return rows


@pytest.mark.parametrize("streak", ["exposed", "solid"])
@pytest.mark.parametrize("substeps", [1, 3])
def test_bounce_is_the_picture_of_two_straight_pieces(streak, substeps):
    """A bounce halfway through the shutter looks as its two known straight ways do, each for half of the time.

    Solid they are one body, in which each pixel is nearest to one of them.
    """
    found = scene([FLOOR], ONE, look={"streak": streak}, substeps=substeps)
    corners = [np.float32([[x], [y], [0]]) for x, y in ((1.5, 1), (0.75, 0), (0, 1))]
    look: dict[str, Any] = {"head_radius": 0.1, "head_opacity": 0.5, "part": 0.5, "streak": streak}
    joints = [{"joined": 2.0, "behind": corners[2]}, {"joined": 1.0, "ahead": corners[0]}] if streak == "solid" else [{}, {}]
    known = [Streaks(corners[k], corners[k + 1], **look, **joints[k]) for k in range(2)]
    camera = Camera((0, 1, 10), (0, 1, 0), projection="orthographic", width_of_view=8, near=0.01)
    wanted = render(known, camera, None, 64, 48)
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
    emit = {"count": 1, "set": LOOK | {"radius": 2.5}}
    assert len(ways(scene([FLOOR], emit), 2)) == 1
    assert len(ways(scene([FLOOR], {"count": 1, "set": LOOK | {"radius": 1.5}}), 2)) == 2


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


@pytest.mark.parametrize("shutter, phase", [(1.5, 0), (2.0, 0), (3.7, 0), (0.5, 0.25), (0.5, 1.0), (1.2, 0.7), (0.0, 0.6)])
@pytest.mark.parametrize("substeps", [1, 3])
@pytest.mark.parametrize("preroll", [0, 0.7])
def test_uniform_motion_is_the_known_streak(shutter, phase, substeps, preroll):
    """From phase + shutter frames ago to phase frames ago; what was before the beginning or the birth is not."""
    found = scene([], {"rate": 2, "set": LOOK}, shutter, phase, frames=7, preroll=preroll, substeps=substeps)
    births = np.arange(0, 4 + preroll, 0.5) - preroll
    for frame in (1, 2, 3, 7):
        now = (frame - 1) / 2
        closing, opening = (max(now - back / 2, -preroll) for back in (phase, phase + shutter))
        wanted = []
        for birth in births[births <= closing + 1e-9]:
            first, last = max(opening, birth), closing
            share = (last - first) / (closing - opening) if closing > opening else 1.0
            ends = [(3 * (time - birth), 1 - 4 * (time - birth), 0) for time in (first, last)]
            if share > 1e-9:
                wanted.append([*ends[0], *ends[1], share])
        told = [[*tail, *head, share] for tail, head, share in ways(found, frame)]
        np.testing.assert_allclose(sorted(told), sorted(wanted), rtol=0, atol=2e-4)


def test_shutter_of_several_frames_bends_in_each():
    """Under gravity the way goes through the places of the frames before, and through the hits between them."""
    gravity, emit = {"type": "gravity", "acceleration": [0, -8, 0]}, {"count": 1, "set": LOOK | {"velocity": [1, 0, 0]}}
    told = ways(scene([gravity], emit, 2.5), 5)
    assert [(each[0][0], each[2]) for each in told] == [(1.5, 0.4), (1.0, 0.4), (0.75, 0.2)]
    told = ways(scene([gravity, FLOOR], emit | {"set": LOOK | {"velocity": [1, 0, 0], "position": [0, 2.25, 0]}}, 3), 4)
    assert [each[1][:2] for each in told] == [(1.5, 2.25), (1.0, 1.25), (0.75, 0), (0.5, 1.25)]


def test_straight_ways_of_many_frames_are_one_streak():
    """Even motion over four frames is drawn once, not in five pieces."""
    assert len(ways(scene([], ONE, 3.5), 8)) == 1


def test_those_who_died_frames_ago_are_still_exposed():
    """With a shutter of two frames a particle that died 1.5 frames ago is seen for the half frame before, and then gone."""
    emit = {"count": 1, "life": 1.25, "set": LOOK}
    told = [ways(scene([], emit, 2), frame) for frame in (3, 4, 5, 6)]
    assert [round(sum(each[2] for each in frame), 4) for frame in told] == [1, 0.75, 0.25, 0]
    assert told[2] == [((3, -3, 0), (3.75, -4, 0), 0.25)]


def test_reborn_particle_does_not_streak_across_the_scene():
    """One that dies and lives again elsewhere is seen in both places, each for its time, and nowhere between."""
    ops = [{"type": "recycle"}]
    emit = {"count": 1, "life": 0.75, "set": LOOK}
    for shutter in (1.0, 2.0):
        told = ways(scene(ops, emit, shutter), 3)
        assert sum(each[2] for each in told) == pytest.approx(1)
        assert ((0, 1, 0), (0.75, 0, 0), 0.5 / shutter) in told
        assert max(abs(head[0] - tail[0]) for tail, head, _ in told) < 3


def test_recycled_twice_within_the_shutter():
    """Each of several lives in one frame has its own streak."""
    told = ways(scene([{"type": "recycle"}], {"count": 1, "life": 0.2, "set": LOOK}), 2)
    assert sorted(each[2] for each in told) == pytest.approx([0.2, 0.4, 0.4], abs=1e-3)
    assert {each[0] for each in told} == {(0, 1, 0)}


def test_newborn_and_dying_on_a_path_set_each_frame():
    """Where a path is followed, a streak begins where the particle was born on it and ends where it died."""
    ops = [{"type": "set", "set": {"position": {"expr": "vec(time, time * time, 0)"}}}]
    emit = {"count": 1, "life": 0.5, "during": [0.25, 1], "set": {"position": [9, 9, 9], "radius": 0.1}}
    assert ways(scene(ops, emit), 2) == [((0.25, 0.0625, 0), (0.5, 0.25, 0), 0.5)]
    assert ways(scene(ops, emit), 3) == [((0.5, 0.25, 0), (0.75, 0.5625, 0), 0.5)]
    told = ways(scene(ops, emit, 1.5), 3)
    assert told[-1][0] == (0.25, 0.0625, 0) and told[0][1] == (0.75, 0.5625, 0)


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


def test_not_finite_particles_are_dropped_once():
    """A particle whose place is not a number is dropped and counted once, however many pieces its way would have."""
    wrong = {"type": "set", "only": {"share": {"fraction": 0.5}}, "set": {"position": {"expr": "position / (time - time)"}}}
    found = made(
        [{"type": "gravity"}, FLOOR, wrong], {"rate": 40, "set": LOOK}, {"fps": 4, "frames": [1, 4]}, {"shutter": 2.5}
    )
    simulation = found.simulation()
    for _ in simulation.frames(4):
        pass
    film = draw(found.plan.images[0], simulation, 4, 1)
    broken = sum(~np.isfinite(simulation.particles["sky"].store.column("position")[0]))
    assert 0 < film.dropped == broken
