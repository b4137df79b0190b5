"""Held noise: one draw for each particle and 1/24 s, whatever the frames and steps are."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from graphfx.errors import GraphError
from graphfx.math import on_unit_sphere
from graphfx.math.random import counter_of, key_of, philox4x32, uniform
from graphfx.motion.clock import Clock, cell_time, most_cells

from . import one_particle
from .one_particle import path
from .test_linear import array
from .test_machine import effect_of

PUSH = {"type": "random_acceleration", "strength": 5.0}
SHIFT = {"type": "random_translate", "speed": 2.0}
GRAVITY = {"type": "gravity"}
STACKS: dict[str, list[Any]] = {
    "push": [PUSH],
    "shift": [SHIFT],
    "both, damped and sprung": [PUSH, SHIFT, GRAVITY, {"type": "damp"}, {"type": "spring", "frequency": 20}],
    "under a spiral": [PUSH, {"type": "spiral", "speed": 5}],
}


@pytest.mark.parametrize("fps", [24, 30, 7])
@pytest.mark.parametrize("name", STACKS)
def test_steps_do_not_matter(name, fps):
    """With substeps from 1 to 64 a second ends at the same state, to 1e-13."""
    ends = [path(STACKS[name], (0, 1, 0), (1, 0, 0), fps, int(fps), substeps=n) for n in (1, 2, 3, 5, 16, 64)]
    for position, velocity in ends[1:]:
        np.testing.assert_allclose(position[-1], ends[0][0][-1], rtol=0, atol=1e-13)
        np.testing.assert_allclose(velocity[-1], ends[0][1][-1], rtol=0, atol=1e-13 * 20)


@pytest.mark.parametrize("name", STACKS)
def test_frames_do_not_matter(name):
    """At 1, 10, 12, 24, 25, 30, 60 and 1000 frames a second a particle is at the same place after a second, to 1e-12."""
    ends = [path(STACKS[name], (0, 1, 0), (1, 0, 0), fps, fps)[0][-1] for fps in (24, 1, 10, 12, 25, 30, 60, 1000)]
    for end in ends[1:]:
        np.testing.assert_allclose(end, ends[0], rtol=0, atol=1e-12)


@pytest.mark.parametrize("fps, preroll", [(24, 0.37), (30, 0.1), (10, 1 / 3), (25, 2.0)])
def test_preroll_shifts_nothing(fps, preroll):
    """Cells are counted from time 0, before it too: with a preroll that is no whole number of frames, steps do not matter."""
    ends = [
        effect_of([PUSH, SHIFT], {"fps": fps, "preroll": preroll, "precision": 64, "substeps": n}, life=9).simulate(8)["sky"]
        for n in (1, 2, 7)
    ]
    for end in ends[1:]:
        np.testing.assert_allclose(end["position"], ends[0]["position"], rtol=0, atol=1e-12)


def test_particles_that_bounce_keep_their_noise():
    """A particle that takes its steps by itself, up to a contact and on, is pushed by the same draws."""
    floor = {"type": "bounce_plane", "point": [0, -1000, 0]}
    wall = {"type": "bounce_plane", "id": "wall", "normal": [-1, 0, 0], "point": [0.4, 0, 0], "resilience": 1}
    free, bounced = (path([PUSH, surface], (0, 0, 0), (1, 0, 0), fps=10, frames=10) for surface in (floor, wall))
    np.testing.assert_allclose(bounced[1][-1][1:], free[1][-1][1:], rtol=0, atol=1e-12)
    np.testing.assert_allclose(bounced[0][-1][1:], free[0][-1][1:], rtol=0, atol=1e-12)
    assert bounced[0][:, 0].max() <= 0.4 < free[0][:, 0].max()


def push_of(life: int, cell: int) -> np.ndarray:
    """Return the push of the first particle of `one` in a life and a cell: 5 on_unit_sphere(u, v) w^(1/3)."""
    words = philox4x32(counter_of(0, life, cell), key_of(0, "one", "act/random_acceleration"))
    u, v, w, _ = (uniform(word) for word in words)
    return array(on_unit_sphere(u, v)) * 5 * w ** (1 / 3)


def test_draws_are_philox_of_seed_path_id_and_cell():
    """The push of the first 1/24 s is what the counter (id, life 0, cell 0) gives, and that of the next cell 1's."""
    _, velocity = path([PUSH], (0, 0, 0), frames=2)
    for cell in (0, 1):
        np.testing.assert_allclose((velocity[cell + 1] - velocity[cell]) * 24, push_of(0, cell), rtol=1e-12)


def test_another_life_has_its_own_pushes():
    """Who begins a second life at 1/40 s, within the first cell, is pushed by the counter (id, life 1, cell 0) from there."""
    _, velocity = path([PUSH, {"type": "recycle"}], (0, 0, 0), frames=1, emit={"life": 1 / 40})
    np.testing.assert_allclose(velocity[1] * 60, push_of(1, 0), rtol=1e-9)


def test_pushes_fill_the_ball_evenly():
    """Pushes of many particles are uniform in the ball: no mean, E r^2 = 0.6 R^2, a third of it along each axis, all within R."""
    time = {"fps": 24, "frames": [0, 1], "precision": 64}
    found = effect_of([PUSH], time, rate=480_000, set={}, during=[-1, 1e-9 + 1 / 24], life=9).simulate(1)["sky"]
    assert len(found["velocity"]) > 19_000
    born = found["birth"]
    push = (found["velocity"] / (1 / 24 - born)[:, None])[born < 0.04]
    square = (push**2).sum(axis=1)
    count = len(push)
    assert square.max() <= 25 * (1 + 1e-9)
    assert np.abs(push.mean(axis=0)).max() <= 4 * np.sqrt(5 / count)
    assert abs(square.mean() / 15 - 1) <= 4 * np.sqrt((3 / 7 - 0.36) / 0.36 / count)
    assert np.abs((push**2).mean(axis=0) / 5 - 1).max() <= 0.04
    assert abs(np.corrcoef(push[:-1, 0], push[1:, 0])[0, 1]) <= 4 / np.sqrt(count)


def test_cells_are_independent():
    """The spread of velocities after n cells is strength sqrt(0.6 n) / 24."""
    found = effect_of([PUSH], {"fps": 24, "frames": [0, 48], "precision": 64}, rate=48_000, set={}, during=[-1, 0.02], life=9)
    spread = np.sqrt((found.simulate(48)["sky"]["velocity"] ** 2).sum(axis=1).mean())
    assert abs(spread / (5 * np.sqrt(0.6 * 47.8) / 24) - 1) <= 0.05


def test_shift_leaves_the_velocity_alone():
    """A random translation is an applied velocity."""
    position, velocity = path([SHIFT | {"along": [1, 0, 2]}], (0, 3, 0), (0, 0, 0))
    assert not velocity.any() and (position[:, 1] == 3).all() and np.abs(position[:, 2]).max() > 0


def test_every_instance_has_its_own_noise():
    """Two of a kind, another seed_key or another graph seed push otherwise; the same seed_key pushes alike."""
    keys = ({}, {"id": "other"}, {"seed_key": "a"}, {"id": "b", "seed_key": "a"})
    ends = [path([PUSH | more], (0, 0, 0))[0][-1] for more in keys]
    assert (ends[2] == ends[3]).all()
    assert len({tuple(end) for end in ends}) == 3


CASES = [(24, 0, 1), (24, 0, 4), (12, 0, 1), (30, 0, 1), (30, 0, 5), (1, 0, 1), (10, 0.17, 3), (23.976, 1.5, 2), (60, 0, 1)]
CASES += [(3, 0, 4), (6, 0, 2), (2.4, 0, 6)]  # their steps begin at cells, but for rounding


@pytest.mark.parametrize("fps, preroll, substeps", CASES)
def test_cells_cover_every_step(fps, preroll, substeps):
    """The cells that a step is told fill it without gap or overlap, and each piece lies in the cell of its number."""
    cells = most_cells(fps, preroll, substeps)
    assert cells <= 24 / Fraction(fps).limit_denominator(10**6) / substeps + 2
    for interval in Clock(fps, 0, preroll).intervals(40):
        length = interval.length / substeps
        for step in (k * length for k in range(substeps)):
            end = step
            for number in range(cells):
                given = interval.start, step, length, number, cells
                word, first, last = (cell_time(kind, *given) for kind in ("cell", "cell begin", "cell end"))
                begin, finish = (step, step + length) if cells == 1 else (max(first, step), min(last, step + length))
                if finish - begin <= 1e-9:
                    continue
                assert begin == pytest.approx(end, abs=1e-12)
                cell = np.floor((interval.start + begin) * 24 + 1e-6)
                assert cell % 2**32 == word and (interval.start + finish) * 24 <= cell + 1 + 1e-6
                end = finish
            assert end == pytest.approx(step + length, abs=1e-12)


def test_whole_steps_in_a_cell_are_not_split():
    """At 24 frames a second, and at 12 with 2 steps, a step meets one cell; at 30 it may meet two, and at 1 it meets 24."""
    assert [most_cells(*given) for given in ((24, 0, 1), (24, 0, 8), (12, 0, 2), (30, 0, 1), (1, 0, 1), (24, 0.1, 1))] == [
        1, 1, 1, 2, 24, 2,
    ]  # fmt: skip


def test_too_many_cells_in_a_step_are_refused():
    """A step of thousands of cells of noise is refused at its operator, with what to do; one of 240 is not."""
    with pytest.raises(GraphError) as caught:
        one_particle.effect_of([{"type": "random_acceleration"}], (0, 0, 0), fps=0.01).plan  # noqa: B018
    assert caught.value.problems[0].message == (
        "its noise is drawn anew every 1/24 s, 2,400 times in a step of this graph, and 240 are the most; "
        "take more frames a second, or more substeps"
    )
    assert one_particle.effect_of([{"type": "random_acceleration"}], (0, 0, 0), fps=0.1).plan.emitters
