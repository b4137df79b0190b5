"""The method `auto`: the error that it promises is kept, by all particles, at the least cost that was found."""

import re

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.cook.matching import matched, size
from graphfx.cook.pilot import PARTICLES, planned
from graphfx.cook.trial import Trials
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from graphfx.plan.make import make_plan
from graphfx.plan.method import Choice

from .effects import graph

LIBRARY = Library(library_roots())
START = {
    "position": {"in_sphere": {"center": [3, 0, 0], "radius": 1}},
    "velocity": {"in_sphere": {"radius": 2}},
    "spiral_axis": {"on_sphere": {}},
}
SCENES = {
    "mild": [{"type": "gravity"}, {"type": "vortex", "magnitude": 0.2}],
    "attractors": [
        {"type": "attract", "strength": 10, "softening": 0.3},
        {"type": "attract", "id": "other", "center": [1, 1, 0], "strength": 5, "softening": 0.3},
    ],
    "stiff": [{"type": "attract", "strength": 10, "softening": 0.2}, {"type": "spring", "frequency": 200, "damping_ratio": 0.2}],
    "storm": [{"type": "vortex"}, {"type": "vortex", "id": "other", "center": [2, 0, 0], "axis": [0, 0, 1]}, {"type": "spiral"}],
    "ball": [{"type": "gravity"}, {"type": "bounce_plane", "point": [0, -1, 0]}, {"type": "attract", "softening": 0.5}],
}
TOLERANCES = (1e-2, 1e-4, 1e-6)
COUNT = 1500


def flat_of(scene: str, tolerance: float, **time):
    """Return a scene as a flat graph."""
    emit = {"rate": 0, "count": COUNT, "life": 100, "set": START}
    time = {"method": "auto", "tolerance": tolerance, "frames": [1, 25], "precision": 64, **time}
    return flatten(document_of(graph(SCENES[scene], emit, time, {"shutter": 0})), LIBRARY)


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("tolerance", TOLERANCES)
def test_the_promise_is_kept_by_all_particles(scene, tolerance):
    """Of all particles 95 % are within the tolerance, and the error told of those tried is right within a factor of 2, or
    of 4 where it is far within the tolerance."""
    flat = flat_of(scene, tolerance)
    chosen = planned(flat).emitters["sky"]
    told = re.search(r"95 % of 256 tried are within (\S+) m, \S+ % over the (\S+) m allowed", chosen.reason)
    assert PARTICLES == 256 and float(told[2]) == tolerance, chosen.reason
    frames = [5, 9, 13, 17, 21, 25]
    choice = {"sky": Choice(chosen.method, "", chosen.motion.scheme)}
    fine = {"sky": Choice("adaptive", "", type(chosen.motion.scheme)((1, 2, 3, 4), tolerance * 1e-4))}
    found, true = (Trials(flat, choices=each).run(frames).states["sky"] for each in (choice, fine))
    errors = []
    for frame in frames:
        rows, theirs = matched(true[frame], found[frame])
        assert len(rows) == COUNT
        errors.append(size(found[frame].position[theirs] - true[frame].position[rows]))
    measured = np.quantile(np.concatenate(errors), 0.95)
    assert measured <= tolerance
    estimate = float(told[1])
    factor = 2 if max(estimate, measured) > tolerance / 10 else 4
    assert estimate / factor <= measured <= estimate * factor or measured < tolerance * 1e-3


def test_what_is_exact_is_not_tried():
    """Linear motion is exact under `auto`, as without trying."""
    flat = flatten(document_of(graph([{"type": "gravity"}], None, {"method": "auto"})), LIBRARY)
    assert planned(flat).emitters["sky"].method == "exact"


def test_a_mild_scene_takes_one_step_and_a_stiff_one_more():
    """The cheapest setting is taken: one symmetric step where that is enough."""
    mild = planned(flat_of("mild", 1e-2)).emitters["sky"]
    assert (mild.method, mild.motion.scheme.counts) == ("strang", (1,))
    assert planned(flat_of("attractors", 1e-6)).emitters["sky"].method == "adaptive"


def test_the_choice_is_the_same_each_time():
    """Two plans of one graph choose the same, and say the same."""
    one, other = (planned(flat_of("storm", 1e-4)).emitters["sky"] for _ in range(2))
    assert (one.reason, one.motion.scheme) == (other.reason, other.motion.scheme)


def test_the_plan_of_an_effect_is_the_tried_one():
    """An effect is cooked with what was chosen; a plan that nothing was tried for takes one symmetric step."""
    flat = flat_of("attractors", 1e-6)
    assert Effect(flat).plan.emitters["sky"].method == "adaptive"
    assert make_plan(flat).emitters["sky"].motion.scheme.counts == (1,)


def test_what_32_bits_cannot_tell_is_said():
    """A tolerance that 32 bits cannot keep is not promised: the error told is that of rounding, and the way out is named."""
    chosen = planned(flat_of("attractors", 1e-9, precision=32)).emitters["sky"]
    told = re.search(r"95 % of 256 tried are within (\S+) m", chosen.reason)
    assert 1e-8 < float(told[1]) < 1e-3
    assert chosen.reason.endswith('and "precision": 64, as 32 bits tell no more of places so far out')


def test_a_tolerance_that_nothing_keeps_is_told_once(tmp_path):
    """A cook warns with its first frame, at the emitter, how near the best comes; what is kept is not told of."""
    reports = []
    for tolerance in (1e-12, 1e-2):
        emit = {"rate": 0, "count": 20, "set": START}
        time = {"method": "auto", "tolerance": tolerance, "frames": [1, 3], "precision": 32}
        flat = flatten(document_of(graph(SCENES["attractors"], emit, time, {"shutter": 0, "size": [8, 8]})), LIBRARY)
        Effect(flat).cook(tmp_path, report=reports.append)
    (told,), *others = (report.warnings for report in reports)
    assert not any(others) and told.path == "nodes.sky" and told.location.line > 0
    assert re.fullmatch(r"no way tried of computing its motion keeps time.tolerance, 1e-12 m: the best leaves 95 % of "
                        r"particles within \S+e-07 m; allow as much, or see `graphfx study`, and \"precision\": 64, as 32 bits "
                        r"tell no more of places so far out", told.message)
