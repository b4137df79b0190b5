"""Particles that would leave the numbers stay where they were, and are told of; nobody else is touched."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from graphfx.plan.overflow import growing

from .bursts import burst, carried, places
from .many_particles import effect_of, states

GROWING: dict[str, list[Any]] = {
    "undamp": [{"type": "undamp", "rate": 50}],
    "damp below 0 with a threshold": [{"type": "damp", "damping": -50, "threshold": 1e6}],
    "what follows the velocity": [{"type": "gravity", "acceleration": {"expr": "velocity * 1000"}}],
    "gravity and undamp": [{"type": "gravity"}, {"type": "undamp", "rate": 50}],
    "a matrix": [{"type": "scale", "rate": 50}, {"type": "gravity"}],
    "an attractor and undamp": [{"type": "attract", "strength": 1e12}, {"type": "undamp", "rate": 50}],
    "a repelling line and damp below 0": [{"type": "attract_line", "strength": -1e12}, {"type": "damp", "damping": -50}],
    "turbulence and undamp": [{"type": "turbulence"}, {"type": "undamp", "rate": 50}],
    "noise and scale": [{"type": "curl_noise"}, {"type": "scale", "rate": 50}],
    "spiral and damp below 0": [{"type": "spiral"}, {"type": "damp", "damping": -50}],
    "a mirror and scale": [{"type": "bounce_sphere"}, {"type": "scale", "rate": 50}],
    "a mirror and damp below 0": [{"type": "bounce_box"}, {"type": "damp", "damping": -50}],
}
"""Motions that grow without end: in 32 bits within a second or two, in 64 bits in steps of a thousand."""
MILD: dict[str, list[Any]] = {
    "free flight": [],
    "what falls, slowed down": [{"type": "gravity"}, {"type": "damp", "damping": 2}, {"type": "wind"}],
    "what depends on each": [{"type": "gravity", "acceleration": {"expr": "vec(0, mass * -9, 0)"}}, {"type": "damp"}],
    "springs": [{"type": "spring", "frequency": {"rand": [1, 9]}}, {"type": "spiral"}, {"type": "random_acceleration"}],
}


@pytest.mark.parametrize("name", GROWING)
def test_what_grows_without_end_stays_where_it_was_and_is_counted(name):
    """At every frame all places and speeds are finite; whose step would lead beyond the numbers stands still, and is counted."""
    for precision, fps in ((32, 1), (64, 1e-3)):
        effect = burst(GROWING[name], 20, {"method": "strang", "precision": precision, "fps": fps, "frames": [0, 40]})
        simulation = effect.simulation()
        particles, seen = simulation.particles["some"], []
        for _ in simulation.frames(40):
            lost = particles.lost - (seen[-1][1] if seen else 0)
            seen.append((places(simulation), particles.lost, lost))
            every = np.stack([np.asarray(part)[:20] for n in ("position", "velocity") if n in particles.store.columns
                              for part in particles.store.column(n)])
            assert np.isfinite(every).all()
        assert particles.lost > 0
        still = [int((before == after).all(axis=1).sum()) for (before, *_), (after, *_) in pairwise(seen)]
        assert all(count >= lost for count, (_, _, lost) in zip(still, seen[1:], strict=True))


@pytest.mark.parametrize("name", GROWING)
def test_plain_python_gives_the_same_bits_and_counts(name):
    """By both ways the same particles stay where they were: the same bits, and as many steps that were not taken."""
    both = []
    for how in ({"threads": 2}, {"reference": True}):
        effect = burst(GROWING[name], 5, {"method": "strang", "precision": 32, "fps": 1, "frames": [0, 6], "substeps": 2})
        simulation = carried(effect, **how)
        both.append((places(simulation).tobytes(), simulation.particles["some"].lost))
    assert both[0] == both[1] and both[0][1] > 0


def test_nobody_else_is_touched():
    """Beside particles that are given up the others move as they do where none is."""
    found = []
    for least in (0.5, 0.0):
        ops = [{"type": "undamp", "rate": {"expr": f"0.1 if mass >= {least} else 50"}}, {"type": "gravity"}]
        effect = burst(ops, 300, {"method": "strang", "precision": 32, "fps": 1, "frames": [0, 5]}, mass={"rand": [0, 1]})
        simulation = carried(effect)
        found.append((places(simulation), simulation.particles["some"]))
    (mixed, particles), (alone, others) = found
    mild = np.asarray(particles.store.column("mass")[0])[:300] >= 0.5
    assert 100 < mild.sum() < 200 and particles.lost > 0 and others.lost == 0
    assert mixed[mild].tobytes() == alone[mild].tobytes()


def test_newborn_particles_are_kept_too():
    """Who would be led beyond the numbers by its first step, a part of a frame, stays where it was born."""
    emit = {"rate": 40, "set": {"position": {"in_box": {}}, "velocity": {"in_sphere": {"radius": 1e25}}}}
    simulation = effect_of([{"type": "undamp", "rate": 50}], 0, fps=1, frames=1, emit=emit, precision=32).simulation()
    for _ in simulation.frames(1):
        pass
    position, velocity = states(simulation)
    *here, last = (np.abs(position) <= 1).all(axis=1)
    assert np.isfinite(velocity).all() and last, "the last is born as the frame ends"
    assert 0 < sum(here) == simulation.particles["one"].lost < 40 == len(here)


@pytest.mark.parametrize("name", MILD)
def test_what_cannot_grow_is_not_looked_at(name):
    """Where all that acts is a constant, slows down or pulls back, no step is looked at; where it may grow, each is."""
    mild, grows = (burst(ops, 5, {"method": "strang"}).plan.emitters["some"].main for ops in (MILD[name], GROWING["undamp"]))
    assert mild.program.rejects is None and grows.program.rejects is not None


def test_rates_are_known_by_their_values():
    """damp and scale may drive away where their constants say so, or where they vary and are declared to reach below 0."""
    def causes(*ops):
        return [mover.node.path for mover in growing(burst(list(ops), 5, {"method": "strang"}).plan.emitters["some"].motion)]

    assert causes({"type": "damp", "damping": 3}, {"type": "scale", "rate": -2}, {"type": "spring"}, {"type": "drag"}) == []
    assert causes({"type": "damp", "damping": -3}, {"type": "gravity"}) == ["act/damp"]
    assert causes({"type": "damp", "damping": {"rand": [1, 2]}}, {"type": "scale", "rate": 2}) == ["act/damp", "act/scale"]


@pytest.mark.parametrize("text", ["1 / (mass - 1)", "sqrt(0.5 - mass)", "log(mass - 1)", "exp(mass * 1e9)"])
def test_a_parameter_that_is_no_number_moves_nobody(text):
    """What is linear is looked at where a parameter may be infinite or no number; nobody moves under it."""
    effect = burst([{"type": "gravity", "acceleration": {"expr": f"vec(0, {text}, 0)"}}], 9, {"method": "strang"})
    simulation = carried(effect)
    born, *_ = (places(each) for each in [effect.simulation()] for _ in each.frames(0))
    assert simulation.particles["some"].lost == 9 * 24 and (places(simulation) == born).all()


def test_who_was_kept_goes_on_when_nothing_drives_it_any_more():
    """Particles that stood still go on as soon as they are led to numbers again: nothing of the step not taken is left."""
    ops = [{"type": "gravity"}, {"type": "undamp", "rate": 50, "during": [0, 3000]}]
    effect = burst(ops, 9, {"method": "strang", "fps": 1e-3, "frames": [0, 6]})
    assert effect.plan.emitters["some"].motion.keeps, "what rounding takes from places"
    simulation, seen = effect.simulation(), []
    for _ in simulation.frames(6):
        seen.append((places(simulation), simulation.particles["some"].lost))
    (before, lost), (after, again) = seen[-2:]
    assert lost == again == 18 and (after != before).any(axis=1).all()


def test_what_a_graph_itself_sets_is_not_a_step():
    """A place that a graph sets to no number is told of where it is drawn, and counts as no step."""
    simulation = carried(burst([{"type": "vortex"}], 9, {"method": "strang"}, position={"expr": "vec(0, 1, 0) / (mass - 1)"}))
    assert simulation.particles["some"].lost == 0 and not np.isfinite(places(simulation)).any()
