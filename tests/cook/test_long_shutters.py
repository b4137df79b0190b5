"""Shutters of several frames, their phases, and the births and deaths within them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from .effects import effect, graph
from .exposures import FLOOR, LOOK, ONE, SIDE, scene, ways


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


def test_bends_stay_with_their_particles_as_others_die():
    """Rows close up as particles are removed, and what is known of their ways moves along; what is long past is forgotten."""
    found = scene([FLOOR], {"rate": 2, "life": 0.625, "set": LOOK}, 2)
    told = [(tail, head) for tail, head, _ in ways(found, 8)]
    places = [(0, 1, 0), (0.75, 0, 0), (1.5, 1, 0), (1.875, 1.5, 0)]
    assert set(told) <= {*pairwise(places), (places[1], places[3])} and len(told) >= 5
    simulation = found.simulation()
    for _ in simulation.frames(9):
        pass
    assert simulation.particles["sky"].past.store.count <= 2 and len(simulation.particles["sky"].bends.rows) <= 3


def test_hits_of_long_ago_are_forgotten():
    """However long a particle bounces, the hits that are kept are those that a picture may show."""
    simulation = scene([FLOOR, {"type": "gravity"}], {"count": 1, "set": LOOK}, 1, frames=30).simulation()
    kept = [len(simulation.particles["sky"].bends.rows) for _ in simulation.frames(30)]
    assert max(kept) <= 2 and sum(kept) > 10


def test_trails_leave_no_bends():
    """Copies of particles that are carried along to leave a trail do not disturb the ways of those born after."""
    dust = {"dust": {"type": "spawn", "from": "act", "rate": 40, "life": 0.1}}
    emit = {"rate": 4, "life": 3, "set": LOOK | {"velocity": {"in_box": {"min": [1, -4, 0], "max": [3, -2, 0]}}}}
    image = {"from": ["act", "dust"], "camera": "side", "size": [64, 48], "shutter": 2.5}
    plain, time = scene([FLOOR], emit, 2.5), {"fps": 2, "frames": [1, 9], "precision": 64}
    trailing = effect(graph([FLOOR], emit, time, image, {"side": SIDE, **dust}))
    assert ways(trailing, 6) == ways(plain, 6) and ways(trailing, 9) == ways(plain, 9)


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
