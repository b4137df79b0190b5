"""Trails: children along the paths of their parents, evenly in time, whatever the frames are."""

from __future__ import annotations

import numpy as np
import pytest

from .effects import effect, graph

RATES = [(24, 1), (10, 2), (7, 1), (60, 1)]
THROW = {"count": 1, "rate": 0, "set": {"position": [0, 1, 0], "velocity": [1, 2, 0]}}
GRAVITY = {"type": "gravity", "acceleration": [0, -10, 0]}
FLOOR = {"type": "bounce_plane", "resilience": 0.5}


def trail(ops=(GRAVITY,), emit=THROW, fps=24, substeps=1, seconds=1.0, spawn=None, nodes=None, **time):
    """Return what a trail of 100 a second, that stays where it is left, has after some seconds: times and places in order."""
    last = round(fps * seconds) + 1
    own = {"dust": {"type": "spawn", "from": "act", "rate": 100, "life": 9, "set": {"velocity": [0, 0, 0]}, **(spawn or {})}}
    time = {"fps": fps, "substeps": substeps, "frames": [1, last], "precision": 64} | time
    found = effect(graph(list(ops), emit, time, {"from": ["dust", *(nodes or {})]}, {**(nodes or {}), **own})).simulate(last)[
        "dust"
    ]
    order = np.argsort(found["birth"], kind="stable")
    return found["birth"][order], found["position"][order]


@pytest.mark.parametrize("fps, substeps", RATES)
def test_trail_lies_on_the_parabola(fps, substeps):
    """The k-th is born at k / 100 s, at y = 1 + 2 t - 5 t^2; the last of them a frame's rounding before 1 s."""
    times, places = trail(fps=fps, substeps=substeps)
    assert len(times) in (99, 100)
    np.testing.assert_allclose(times, np.arange(1, len(times) + 1) / 100, rtol=0, atol=1e-12)
    np.testing.assert_allclose(places, np.stack([times, 1 + 2 * times - 5 * times**2, 0 * times], axis=1), rtol=0, atol=1e-12)


@pytest.mark.parametrize("fps, substeps", RATES)
def test_trail_follows_through_a_bounce(fps, substeps):
    """After the contact at 1 s / 2 it goes on from there: a parent that bounces within a frame is followed."""
    emit = THROW | {"set": {"position": [0, 1, 0], "velocity": [1, -2, 0]}}
    listens = {"splash": {"type": "spawn", "from": "act", "when": "hit", "life": 1}}
    for more in ({}, listens):
        times, places = trail([{"type": "gravity", "acceleration": [0, 0, 0]}, FLOOR], emit, fps, substeps, nodes=more)
        height = np.where(times < 0.5, 1 - 2 * times, times - 0.5)
        np.testing.assert_allclose(places[:, 1], height, rtol=0, atol=1e-12)
        np.testing.assert_allclose(np.diff(times), 0.01, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    "ops, emit, end",
    [
        ([GRAVITY], THROW | {"life": 0.333}, 0.333),
        (
            [{"type": "bounce_plane", "response": "die"}],
            THROW | {"set": {"position": [0, 0.666, 0], "velocity": [0, -2, 0]}},
            0.333,
        ),
        (
            [{"type": "bounce_plane"}, {"type": "kill", "when": "hit"}],
            THROW | {"set": {"position": [0, 0.666, 0], "velocity": [0, -2, 0]}},
            0.333,
        ),
        (
            [{"type": "bounce_plane"}, {"type": "set", "when": "hit", "set": {"life": {"expr": "age"}}}],
            THROW | {"set": {"position": [0, 0.666, 0], "velocity": [0, -2, 0]}},
            0.333,
        ),
        ([{"type": "kill", "only": {"expr": "time > 0.45"}}], THROW, 0.5),
    ],
)
def test_the_dead_leave_no_trail(ops, emit, end):
    """A parent that ends within a frame leaves nothing after its end."""
    for fps in (4, 10):
        times, _ = trail([{"type": "gravity", "acceleration": [0, 0, 0]}, *ops], emit, fps)
        assert end - 0.01 - 1e-9 <= times.max() <= end + 1e-9


@pytest.mark.parametrize("fps", [1, 10, 24])
def test_each_life_leaves_a_trail_of_its_own(fps):
    """Lives of 0.155 s leave 15 each, the k-th k / 100 s after the birth."""
    times, places = trail([GRAVITY, {"type": "recycle"}], THROW | {"life": 0.155}, fps)
    wanted = np.array([n * 0.155 + k / 100 for n in range(7) for k in range(1, 16)])
    np.testing.assert_allclose(times, wanted[wanted < 1], rtol=0, atol=1e-12)
    np.testing.assert_allclose(places[:, 0], np.tile(np.arange(1, 16) / 100, 7)[: len(times)], rtol=0, atol=1e-12)


@pytest.mark.parametrize("fps", [1, 10, 24])
def test_what_is_spawned_within_a_frame_leaves_a_trail_from_then_on(fps):
    """A rocket that joins the emitter at 0.155 s leaves its first spark at 0.165 s."""
    rocket = {"rocket": {"type": "spawn", "from": "sky", "when": "death", "into": "sky", "generations": 1, "life": 0.5}}
    times, _ = trail(emit=THROW | {"life": 0.155}, fps=fps, nodes=rocket)
    np.testing.assert_allclose(times, [*np.arange(1, 16) / 100, *(0.155 + np.arange(1, 51) / 100)], rtol=0, atol=1e-12)


@pytest.mark.parametrize("fps", [1, 10, 24])
def test_during_limits_a_trail_within_frames(fps):
    """Only what is born from 0.125 s on and before 0.275 s is left."""
    times, _ = trail(fps=fps, spawn={"during": [0.125, 0.275]})
    np.testing.assert_allclose(times, np.arange(13, 28) / 100, rtol=0, atol=1e-12)


@pytest.mark.parametrize("rate", [0, {"expr": "0 / 0"}, {"expr": "-1 - age"}, {"expr": "0 * mass"}])
def test_no_rate_no_trail(rate):
    """A rate of nothing, or less, or that is no number, leaves nothing."""
    assert len(trail(spawn={"rate": rate})[0]) == 0


def test_rate_may_differ_by_parent():
    """Each parent leaves its own number, in order of time."""
    emit = {"count": 50, "rate": 0, "set": {"position": {"in_box": {}}, "mass": {"rand": [10, 60]}}}
    last = {"frames": [1, 25], "precision": 64}
    own = {"dust": {"type": "spawn", "from": "act", "rate": {"expr": "mass"}, "life": 9}}
    parents = {"type": "set", "set": {"radius": {"expr": "mass"}}}
    found = effect(graph([GRAVITY, parents], emit, last, {"from": ["dust", "act"]}, own)).simulate(25)
    assert len(found["dust"]["birth"]) == np.floor(found["sky"]["radius"]).sum()


@pytest.mark.parametrize("preroll", [0.25, 0.13])
def test_trail_begins_with_the_preroll(preroll):
    """The parent is born as the preroll begins, its trail follows at once."""
    times, _ = trail(preroll=preroll, seconds=0.5)
    np.testing.assert_allclose(times, -preroll + np.arange(1, len(times) + 1) / 100, rtol=0, atol=1e-12)
    assert len(times) >= 100 * (0.5 + preroll) - 1


def test_path_that_bends_at_surfaces_has_no_gaps():
    """Ten balls that bounce for two seconds leave 200 sparks each, all above the floor."""
    emit = {
        "count": 10,
        "rate": 0,
        "set": {"position": {"in_box": {"min": [-1, 0.5, -1]}}, "velocity": {"in_sphere": {"radius": 2}}},
    }
    times, places = trail([GRAVITY, FLOOR | {"friction": 0.1}], emit, seconds=2)
    assert len(times) in range(1990, 2001) and places[:, 1].min() > -1e-9
