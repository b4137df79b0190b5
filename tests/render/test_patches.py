"""Patches: memory stays under a budget, and no pixel knows."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphfx.render import renderer
from graphfx.render.camera import Camera
from graphfx.render.patches import Counts, Patch, false_position, patches_within
from graphfx.render.renderer import render
from graphfx.render.slabs import slabs_of
from graphfx.render.streaks import Streaks
from graphfx.render.view import Slab

from .scenes import CAMERA, FLAT, HEIGHT, WIDTH, comets, streaks

ROWS, COLUMNS = 5, 7
ROW, COLUMN = st.integers(0, ROWS - 1), st.integers(0, COLUMNS - 1)
BOXES = st.lists(st.tuples(ROW, ROW, COLUMN, COLUMN))


def counted(boxes) -> tuple[Counts, list[Patch]]:
    """Return the counts of boxes given as two rows and two columns, and the boxes."""
    made = [Patch(min(c, d), min(a, b), max(c, d) + 1, max(a, b) + 1) for a, b, c, d in boxes]
    corners = np.zeros((4, ROWS + 1, COLUMNS + 1), np.int64)
    for box in made:
        for k in range(4):
            corners[k, (box.top, box.bottom)[k // 2], (box.left, box.right)[k % 2]] += 1
    return Counts(corners, 100), made


def common(one: Patch, other: Patch) -> int:
    """Return how many tiles two patches share."""
    wide = min(one.right, other.right) - max(one.left, other.left)
    return max(wide, 0) * max(min(one.bottom, other.bottom) - max(one.top, other.top), 0)


@given(BOXES, BOXES.filter(bool))
def test_counts_are_those_of_overlapping_boxes(boxes, patches):
    """Sums of corners tell how many boxes reach into a rectangle, and into how many of its tiles."""
    counts, made = counted(boxes)
    for patch in counted(patches)[1]:
        areas = [common(patch, box) for box in made if common(patch, box)]
        assert (counts.boxes(patch), counts.members(patch)) == (len(areas), sum(areas))


@given(BOXES, st.integers(0, 3000), st.booleans())
def test_patches_cover_the_picture_once_and_fit(boxes, budget, uncut):
    """Every tile is in just one patch; a patch that is over the budget is a single tile, or a row if rows are not cut."""
    counts, _ = counted(boxes)
    covered = np.zeros((ROWS, COLUMNS), int)
    for left, top, right, bottom in patches_within(counts, Patch(0, 0, COLUMNS, ROWS), budget, uncut):
        covered[top:bottom, left:right] += 1
        tiles = (bottom - top) * (1 if uncut else right - left)
        assert counts.memory(Patch(left, top, right, bottom)) <= budget or tiles == 1
    assert (covered == 1).all()


@given(st.lists(st.integers(0, 50), min_size=1, max_size=60), st.integers(0, 500))
def test_false_position_finds_the_last_that_fits(steps, wanted):
    """It finds what a search one by one finds, for any function that does not fall, in fewer calls."""
    values, calls = np.cumsum(steps), []
    found = false_position(lambda i: calls.append(i) or values[i], 0, len(values) - 1, wanted)
    assert found == max(np.count_nonzero(values <= wanted) - 1, 0)
    assert len(calls) <= 4 + 3 * np.log2(len(values))


def steps_of(scene, memory, camera=CAMERA, size=(WIDTH, HEIGHT), threads=1):
    """Return a film and the names of the steps in which it was made."""
    steps: list[str] = []
    return render(scene, camera, None, *size, threads, steps.append, None, memory), steps


@pytest.fixture
def any_memory(monkeypatch):
    """Let budgets be as small as a few streaks."""
    monkeypatch.setattr(renderer, "LEAST_MEMORY", 1)


@pytest.mark.parametrize("memory, most, least", [(60_000, 8, 2), (12_000, 60, 9), (1_500, 4000, 100), (1, 100_000, 500)])
def test_memory_changes_no_byte(any_memory, memory, most, least):
    """Two streams over a picture of 18 tiles: in bands, in single tiles, in slabs of depth, one streak at a time."""
    scene = [comets(1, 300), streaks(2, 200, blend="add", rows=np.arange(0, 200, 3))]
    whole, steps = steps_of(scene, np.inf)
    assert steps == ["project", "order", "bin", "tiles"]
    part, steps = steps_of(scene, memory, threads=2)
    assert least <= steps.count("tiles") <= most
    assert part.pixels.tobytes() == whole.pixels.tobytes()
    assert (part.fragments, part.dropped) == (whole.fragments, whole.dropped)


def piercing(count: int) -> Streaks:
    """Return streaks that reach through each other in depth, so that lists overflow."""
    draw = np.random.default_rng(5)
    head, tail = draw.uniform(-1, 1, (3, count)), draw.uniform(-1, 1, (3, count))
    head[2], tail[2] = 3.0, -20.0
    return Streaks(head.astype(np.float32), tail.astype(np.float32), 0.3, head_opacity=0.05)


@pytest.mark.parametrize("memory", [3_000, 20_000])
def test_slabs_of_groups_that_are_sorted_whole(any_memory, memory):
    """Where lists overflow, the pending fragments wait from slab to slab."""
    scene = [piercing(400), streaks(3, 100, blend="add")]
    whole, part = (steps_of(scene, each, size=(19, 17))[0] for each in (np.inf, memory))
    assert part.pixels.tobytes() == whole.pixels.tobytes() and part.fragments == whole.fragments


def test_ties_are_cut_by_particle(any_memory):
    """A thousand particles at one depth in one tile, a hundred times the budget: they come in their order."""
    scene = streaks(17, 1000, length=0.0, radius=(0.3, 0.6), spread=0.5)
    scene.head[2] = scene.tail[2] = 0.5
    camera = Camera(position=(0, 0, 6.0))
    whole, part = (steps_of([scene], each, camera, (8, 16))[0] for each in (np.inf, 1600))
    assert part.pixels.tobytes() == whole.pixels.tobytes() and whole.pixels.any()


@pytest.mark.parametrize("camera", [CAMERA, FLAT], ids=["perspective", "orthographic"])
def test_slabs_hold_every_particle_once(camera):
    """Slabs of at most so many follow one another in key and particle, and none is missed."""
    from graphfx.render.scene import make_scene

    stream = streaks(5, 500, radius=(5, 9))
    stream.head[2, 100:300] = stream.tail[2, 100:300] = 1.0
    scene = make_scene([stream], camera, camera, 8, 16, 1, False)
    scene.survey()
    tile, total, last = Patch(0, 0, 1, 1), 0, Slab(True, -1, -1, 0, 0)
    for slab in slabs_of(scene, tile, 40):
        assert slab.low > last.high or (slab[:3] == last[:3] and slab.start == last.stop)
        last = slab
        total += len(scene.slab_segments(tile, slab, 40)[1])
    assert total == len(scene.segments(tile)[1]) > 300


def test_particles_that_are_not_finite_are_counted_once(any_memory):
    """However many patches there are, a NaN is one particle."""
    scene = comets(15, 60)
    scene.head[0, 7] = scene.tail[1, 9] = np.nan
    assert steps_of([scene], 3000)[0].dropped == 2


def test_rows_draw_what_columns_of_those_rows_draw():
    """Drawing some rows of columns is drawing columns of these alone."""
    scene, rows = comets(4, 100), np.arange(3, 100, 7)
    chosen = Streaks(
        scene.head[:, rows], scene.tail[:, rows], scene.head_radius[rows], scene.tail_radius[rows], scene.head_color[:, rows],
        scene.tail_color[:, rows], scene.head_opacity[rows], scene.tail_opacity[rows], scene.share[rows],
    )
    scene.rows = rows
    assert steps_of([scene], np.inf)[0].pixels.tobytes() == steps_of([chosen], np.inf)[0].pixels.tobytes()


def test_samples_come_band_by_band_whatever_the_memory(any_memory):
    """The samples of all rows come from the top, the same for any budget."""
    scene = [comets(1, 200)]

    def bands(memory):
        found = []
        render(scene, CAMERA, None, WIDTH, HEIGHT, 1, sampler=found.append, memory=memory)
        return found

    whole, part = bands(np.inf), bands(2000)
    assert [band.top for band in part] == [band.top for band in whole] == [0, 16, 32]
    for one, other in zip(whole, part, strict=True):
        for name in ("offsets", "depth", "particle"):
            assert (getattr(one, name) == getattr(other, name)).all()
