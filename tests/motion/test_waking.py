"""A particle at rest lets go when what presses it on the surface changes, and only then is it asked."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.program import Call

from .many_particles import carried, effect_of, states, walk
from .test_machine import bits

STICKY = {"type": "bounce_plane", "resilience": 0.5, "friction": 1}
TURNING = {"type": "gravity", "acceleration": {"keys": [[0, [0, -10, 0]], [2, [0, 10, 0]]]}}


def heights(ops: list[Any], frames: int = 48, up: float = 0.0, **more: Any) -> np.ndarray:
    """Return the height at every frame of a particle that is born on the plane y = 0."""
    return np.array([states(each)[0][0, 1] for each in walk(ops, (0.5, 0, 0), (0, up, 0), frames=frames, **more)])


@pytest.mark.parametrize("substeps", [1, 3])
def test_it_lifts_off_when_gravity_turns(substeps):
    """Under gravity that turns round at 1 s it lies still until then, and rises by 10 t^3 / 6 after."""
    found = heights([TURNING, STICKY], substeps=substeps)
    after = np.arange(25) / 24
    assert (found[:25] == 0).all()
    np.testing.assert_allclose(found[24:], 10 * after**3 / 6, rtol=0, atol=2e-3 / substeps**2)


def test_it_follows_an_attractor_that_begins_to_pull():
    """An attractor above that begins at 1 s and is stronger than gravity lifts it; a weaker one does not."""
    for strength, lifted in ((2.0, False), (20.0, True)):
        pull = {"type": "attract", "center": [0.5, 1, 0], "strength": strength, "falloff": 0, "during": [1, 9]}
        found = heights([{"type": "gravity"}, pull, STICKY], frames=30)
        assert (found[:25] == 0).all() and (found[-1] > 0.1) == lifted and (lifted or found[-1] == 0)


def test_it_falls_when_the_surface_goes():
    """A surface that holds only until 1 s lets fall what rests on it."""
    found = heights([{"type": "gravity"}, STICKY | {"during": [-1, 1]}], frames=36)
    assert (found[:25] == 0).all()
    np.testing.assert_allclose(found[-1], -9.81 * 0.5**2 / 2, rtol=1e-12)


@pytest.mark.parametrize("friction", [0, 1])
def test_a_floor_that_moves_carries_what_lies_on_it(friction):
    """What lies on a floor that rises and stands is on it at every frame, and never under it where it sinks."""
    height = {"keys": [[0, [0, 0, 0]], [0.5, [0, 1, 0]], [1, [0, 1, 0]], [2, [0, 0.3, 0]]]}
    found = heights([{"type": "gravity"}, STICKY | {"resilience": 0.3, "friction": friction, "point": height}])
    wanted = np.interp(np.arange(49) / 24, [0, 0.5, 1, 2], [0, 1, 1, 0.3])
    np.testing.assert_allclose(found[:25], wanted[:25], rtol=0, atol=1e-12)
    assert (found >= wanted - 1e-12).all() and found[-1] < 0.5


def test_what_is_stuck_stays():
    """A surface with the response stick holds for ever what it has caught, on its under side too."""
    ceiling = {"type": "bounce_plane", "normal": [0, -1, 0], "response": "stick"}
    assert not heights([TURNING, ceiling], up=1.0).any()


def test_it_does_not_cling_to_a_ceiling():
    """What comes to rest on a ceiling, without resilience, falls from it."""
    ceiling = {"type": "bounce_plane", "normal": [0, -1, 0], "resilience": 0, "friction": 1}
    position, velocity = carried([{"type": "gravity"}, ceiling], (0, -0.1, 0), (1, 2, 0), frames=12)
    rise = (2 - np.sqrt(4 - 2 * 9.81 * 0.1)) / 9.81
    left = 0.5 - rise
    np.testing.assert_allclose(position[0], [rise, -9.81 * left**2 / 2, 0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(velocity[0], [0, -9.81 * left, 0], rtol=0, atol=1e-12)


def asked(ops: list[Any]) -> int:
    """Return how many instructions of whole steps ask who is held."""
    main = effect_of(ops, 1).plan.emitters["one"].main
    assert main is not None
    return sum(isinstance(each, Call) and "held at rest" in each.note for each in main.program.walk())


def test_nobody_is_asked_where_nothing_changes():
    """Where all that drives and holds particles is the same for ever, rest is for ever too, and costs nothing."""
    constant = [{"type": "gravity"}, {"type": "attract"}, {"type": "damp"}, {"type": "spring"}]
    assert asked([*constant, STICKY]) == 0 and asked([TURNING, {"type": "bounce_plane", "response": "slide"}]) == 0
    for change in (TURNING, {"type": "gravity", "during": [0, 1]}, {"type": "random_acceleration"}):
        assert asked([*constant, change, STICKY]) > 0


@pytest.mark.parametrize("precision", [32, 64])
def test_machine_is_plain_python(precision):
    """Particles that come to rest and wake have the same bits by both ways."""
    emit = {"set": {"position": {"in_box": {"min": [-1, 0, -1], "max": [1, 0.2, 1]}}, "velocity": {"in_box": {}}}}
    keys = {"keys": [[0, [0, -10, 0]], [0.5, [0, 10, 0]], [1, [0, -10, 0]]]}
    ops = [{"type": "gravity", "acceleration": keys}, STICKY, {"type": "bounce_disc", "center": [0, 0.5, 0], "friction": 1}]
    found = effect_of(ops, 6, fps=12, frames=12, emit=emit, precision=precision)
    machine, plain = found.simulate(12, threads=2)["one"], found.simulate(12, reference=True)["one"]
    assert bits(machine) == bits(plain) and np.isfinite(machine["position"]).all()


def test_a_condition_ends_a_particle_at_rest():
    """Who is at rest is killed on a condition as any other is."""
    kill = {"type": "kill", "when": "step", "only": {"expr": "time > 0.9"}}
    steps = walk([{"type": "gravity"}, STICKY, kill], (0, 0, 0), (0, 0, 0), frames=26)
    counts = [each.particles["one"].store.count for each in steps]
    assert counts[20] == 1 and counts[-1] == 0


@pytest.mark.parametrize(("fps", "substeps"), [(24, 1), (10, 1), (7, 3)])
def test_it_is_let_go_at_its_instant(fps, substeps):
    """An applied velocity turns upward at 1.013 s: from then on, and not before, the particle goes with all of it."""
    let_go = 1.013
    velocity = {"keys": [[0, [2, -1.5 * let_go, 0]], [2, [2, 1.5 * (2 - let_go), 0]]]}
    ops = [{"type": "translate", "rate": velocity}, STICKY]
    found = np.array([states(each)[0][0] for each in walk(ops, (0, 0, 0), (0, 0, 0), fps=fps, substeps=substeps, frames=2 * fps)])
    after = np.maximum(np.arange(2 * fps + 1) / fps - let_go, 0)
    np.testing.assert_allclose(found[:, 0], 2 * after, rtol=0, atol=1e-11)
    np.testing.assert_allclose(found[:, 1], 1.5 * after**2 / 2, rtol=0, atol=1e-11)


@pytest.mark.parametrize("lift", [1.0, 100.0])
def test_a_force_lets_it_go_at_its_instant(lift):
    """Under gravity that turns round within a frame it rises by jerk t^3 / 6 after, to the error of the middle of steps."""
    let_go = 0.987
    pull = {"keys": [[0, [0, -lift * let_go, 0]], [2, [0, lift * (2 - let_go), 0]]]}
    for fps in (10, 40):
        found = heights([{"type": "gravity", "acceleration": pull}, STICKY], fps=fps, frames=2 * fps)
        after = np.maximum(np.arange(2 * fps + 1) / fps - let_go, 0)
        np.testing.assert_allclose(found, lift * after**3 / 6, rtol=0, atol=lift / fps**2 / 10)


def test_a_gust_lets_it_go_at_an_instant_of_the_true_motion():
    """Two vortices that pass lift a particle: whole steps find where they carry it to order 2, own steps at once."""

    def vortex(name: str, height: float, magnitude: float) -> dict[str, Any]:
        center = {"keys": [[0, [0, height, -3]], [2, [8, height, -3]]]}
        shape = {"axis": [0, 0, 1], "tightness": 1.2, "range": 5}
        return {"type": "vortex", "id": name, "center": center, "magnitude": magnitude, **shape}

    def place(**time: Any) -> np.ndarray:
        ops = [vortex("lower", 2, -7), vortex("upper", 5.2, 7), STICKY | {"resilience": 0}]
        return carried(ops, (4, 0, 0.3), (0, 0, 0), fps=24, frames=30, **time)[0][0]

    true = place(method="adaptive", order=8, tolerance=1e-9)
    assert np.linalg.norm(true - (4, 0, 0.3)) > 0.5
    off = [np.linalg.norm(place(method="strang", substeps=count) - true) for count in (2, 4, 16)]
    assert off[0] > 3 * off[1] > 30 * off[2]
    for tolerance in (1e-3, 1e-5, 1e-7):
        assert np.linalg.norm(place(method="adaptive", order=4, tolerance=tolerance) - true) < 0.2 * tolerance
