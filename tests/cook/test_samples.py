"""A sample of a graph's particles: who is in it, and that each moves as it does among all."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphfx.cook.sample import ordinals_of
from graphfx.cook.trial import States, Trials, sample_of, spread_frames

from .effects import effect, graph, made

POPULATION = {
    "rate": 130, "count": 40, "every": 0.2, "life": {"rand": [0.1, 0.6]},
    "set": {"position": {"in_box": {"min": [-1, 0.2, -1], "max": [1, 1, 1]}}, "velocity": {"in_sphere": {}}},
}
OPERATORS = [
    {"type": "gravity"}, {"type": "attract", "strength": {"rand": [1, 3]}, "center": [0, 2, 0]},
    {"type": "random_acceleration", "strength": 3}, {"type": "bounce_plane", "resilience": 0.5},
    {"type": "recycle", "only": {"share": {"fraction": 0.5}}},
]
FAMILY = {
    "splash": {"type": "spawn", "from": "act", "when": "hit", "count": 3, "life": 0.3, "spread": 1},
    "trail": {"type": "spawn", "from": "act", "rate": 60, "life": 0.2},
    "smoke": {"type": "spawn", "from": "splash", "when": "death", "count": 2, "life": 0.2},
    "again": {"type": "spawn", "from": "act", "when": "death", "into": "sky", "probability": 0.3},
}


def family() -> dict:
    """Return a graph of bursts, a rate, later lives, splashes, trails, grandchildren and children among their parents."""
    return graph(OPERATORS, POPULATION, {"fps": 30, "frames": [1, 30]}, {"from": ["act", "splash", "trail", "smoke"]}, FAMILY)


def keys(states: States) -> set[tuple[int, int]]:
    return set(zip(states.ids.tolist(), states.lives.tolist(), strict=True))


def rows(states: States) -> dict[tuple[int, int], bytes]:
    """Return the bits of position and velocity by id and life."""
    told = zip(states.ids.tolist(), states.lives.tolist(), states.position, states.velocity, strict=True)
    return {(id_, life): position.tobytes() + velocity.tobytes() for id_, life, position, velocity in told}


@pytest.mark.parametrize("method, substeps", [("strang", 1), ("strang", 3), ("sims", 2)])
def test_each_moves_as_it_does_among_all(method, substeps):
    """Particles, their later lives, their children and grandchildren are bit for bit those of the whole graph."""
    flat = effect(family()).flat
    flat = replace(flat, time=replace(flat.time, method=method, substeps=substeps))
    frames = [5, 17, 30]
    whole, some = Trials(flat).run(frames), Trials(flat, sample_of(flat, 25, 30)).run(frames)
    for path in whole.states:
        for frame in frames:
            among_all, alone = rows(whole.states[path][frame]), rows(some.states[path][frame])
            assert alone.items() <= among_all.items()
    assert all(0 < len(some.states[path][30]) < len(whole.states[path][30]) / 2 for path in ("sky", "splash", "trail", "smoke"))


def test_a_trial_moves_as_a_cook_does():
    """What is measured of particles is what is drawn of them, though nothing is drawn."""
    found = effect(family())
    cooked, trial = found.simulate(20), Trials(found.flat).run([20])
    for path in ("sky", "splash", "trail"):
        assert cooked[path]["position"].tobytes() == trial.states[path][20].position.astype(np.float32).tobytes()


def test_a_sample_is_no_larger_than_asked():
    """Of each emitter at most N births are there, and of each source at most N of their children."""
    flat = effect(family()).flat
    sample = sample_of(flat, 25, 30)
    trial = Trials(replace(flat, time=replace(flat.time, method="strang")), sample).run(range(1, 31))
    for source, states in trial.states.items():
        ever = {id_ for frame in states.values() for id_, _ in keys(frame)}
        born, spawned = {id_ for id_ in ever if id_ < 1 << 63}, {id_ for id_ in ever if id_ >= 1 << 63}
        assert len(born) <= 25 and len(spawned) <= 25, source


def test_all_are_taken_where_there_are_few():
    """A sample that is larger than the graph leaves nobody out."""
    flat = effect(family()).flat
    whole, some = Trials(flat).run([30]), Trials(flat, sample_of(flat, 100_000, 30)).run([30])
    assert all(rows(whole.states[path][30]) == rows(some.states[path][30]) for path in whole.states)


def test_a_sample_depends_on_the_graph_alone():
    """Neither method, steps nor precision change who is chosen."""
    flat = effect(family()).flat
    first = sample_of(flat, 20, 30)
    other = sample_of(replace(flat, time=replace(flat.time, method="sims", substeps=4, precision=64)), 20, 30)
    assert {path: each.tolist() for path, each in first.ordinals.items()} == {
        path: each.tolist() for path, each in other.ordinals.items()}


def test_births_are_spread_over_all():
    """One of each of N equal parts of the births is chosen: ascending, none twice, none left out where all fit."""
    chosen = ordinals_of(3, "sky", 1_000_003, 1000)
    assert len(np.unique(chosen)) == 1000 and (np.abs(chosen - 1000.003 * np.arange(1000)) < 1002).all()
    for count in (1001, 1400, 1999, 2001, 2500):
        few = ordinals_of(3, "sky", count, 1000)
        assert len(few) == 1000 and (np.diff(few) > 0).all() and few[0] >= 0 and few[-1] < count
    assert ordinals_of(3, "sky", 7, 1000).tolist() == list(range(7))
    assert ordinals_of(3, "sky", 1_000_003, 1000).tolist() != ordinals_of(4, "sky", 1_000_003, 1000).tolist()


def test_a_trial_needs_no_reader():
    """Ids, places and velocities are measured where no picture and no operator reads them; what stands still is told too."""
    trial = Trials(made((), {"rate": 0, "count": 3, "set": {"position": [1, 2, 3]}}).flat).run([4])
    states = trial.states["sky"][4]
    assert states.ids.tolist() == [0, 1, 2] and states.position.tolist() == [[1, 2, 3]] * 3 and not states.velocity.any()


def test_frames_are_spread():
    """The last is always among them, and all are where they are few."""
    assert spread_frames(range(1, 101), 4) == [25, 50, 75, 100]
    assert spread_frames([3, 1, 2], 9) == [1, 2, 3]
