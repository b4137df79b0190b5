"""Processor sets: rows are added, copied, killed and closed up."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphfx.errors import LimitError
from graphfx.store import BLOCK, Column, ProcessorSet, primitives, processors

THREADS = [1, 2, 7]
COLUMNS = {
    "position": Column("vec3"), "color": Column("color", (1, 0.5, 0)), "id": Column("id"), "birth": Column("time"),
    "radius": Column("float", 0.25), "hits": Column("count", -1), "on": Column("mask"),
}


@pytest.fixture(autouse=True, scope="module")
def small_grain():
    """Give every few elements a thread, so that small sets are divided too."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(primitives, "GRAIN", 1)
        patch.setattr(processors, "GRAIN", 1)
        yield


def filled(count, threads=1, **options):
    """Return a set whose every array tells the row."""
    particles = ProcessorSet(COLUMNS, threads=threads, **options)
    rows = particles.allocate(count)
    number(particles, rows, np.arange(1, count + 1))
    return particles


def number(particles, rows, numbers):
    for name in particles.columns:
        for offset, array in enumerate(particles.column(name)):
            array[rows] = (numbers + offset) % 251 if name == "on" else numbers + offset


def numbers(particles):
    """Return what each row tells, having checked that all its arrays agree and the padding is 0."""
    told = particles.column("id")[0].astype(np.int64)
    for name in particles.columns:
        for offset, array in enumerate(particles.arrays(name)):
            assert len(array) == particles.capacity
            expected = (told + offset) % 251 if name == "on" else told + offset
            assert array[: particles.count].tolist() == expected.tolist()
            assert not array[particles.count :].any()
    return told.tolist()


@pytest.mark.parametrize("precision, real", [(32, np.float32), (64, np.float64)])
def test_types_of_columns(precision, real):
    """Reals have the set's precision, all else a type of its own; a row's bytes are their sum."""
    particles = ProcessorSet(COLUMNS, precision)
    types = {name: [array.dtype for array in particles.column(name)] for name in COLUMNS}
    assert types == {
        "position": [real] * 3, "color": [real] * 3, "id": [np.uint64], "birth": [np.float64],
        "radius": [real], "hits": [np.int32], "on": [np.uint8],
    }
    word = precision // 8
    assert particles.bytes_by_column == {
        "position": 3 * word, "color": 3 * word, "id": 8, "birth": 8, "radius": word, "hits": 4, "on": 1,
    }
    assert particles.bytes_per_row == 7 * word + 21


def test_new_rows_hold_defaults():
    """New rows hold the columns' defaults; the padding holds 0, defaults or not."""
    particles = ProcessorSet(COLUMNS)
    assert particles.allocate(2) == slice(0, 2)
    assert particles.allocate(1) == slice(2, 3)
    assert [array.tolist() for array in particles.column("color")] == [[1, 1, 1], [0.5, 0.5, 0.5], [0, 0, 0]]
    assert particles.arrays("radius")[0].tolist() == [0.25] * 3 + [0] * 253
    assert particles.column("hits")[0].tolist() == [-1, -1, -1]


def test_rows_used_again_hold_defaults():
    """Rows that the dead have left hold defaults when they are allocated again, nothing of the dead."""
    particles = filled(10)
    particles.kill(np.arange(10))
    particles.compact()
    particles.allocate(10)
    assert not any(array.any() for array in particles.column("position"))
    assert particles.column("radius")[0].tolist() == [0.25] * 10


@pytest.mark.parametrize("count", [0, 1, 255, 256, 257, 9999])
def test_capacity_is_whole_blocks(count):
    """The capacity is a multiple of the block, and an empty set takes no memory."""
    particles = ProcessorSet(COLUMNS)
    particles.allocate(count)
    assert particles.capacity % BLOCK == 0
    assert count <= particles.capacity <= count * 33 / 32 + BLOCK
    assert len(particles) == particles.count == count


@pytest.mark.parametrize("threads", THREADS)
@pytest.mark.parametrize("rows", [[], [0], [4, 4, 4], [9, 0, 5], list(range(10)) * 60])
def test_duplicate_copies_state(rows, threads):
    """Copies stand at the end, in the order asked for, equal to their rows in every column."""
    particles = filled(10, threads)
    assert particles.duplicate(np.array(rows, np.int64)) == slice(10, 10 + len(rows))
    assert numbers(particles) == [*range(1, 11), *(row + 1 for row in rows)]


DEAD = {
    "none": lambda row: False, "all": lambda row: True, "first": lambda row: row == 0, "last": lambda row: row == 999,
    "every other": lambda row: row % 2 == 0, "all but one": lambda row: row != 500, "a run": lambda row: 300 <= row < 600,
}


@pytest.mark.parametrize("piece", [1 << 18, 64, 7])
@pytest.mark.parametrize("threads", THREADS)
@pytest.mark.parametrize("dead", DEAD.values(), ids=DEAD)
def test_compact_keeps_survivors_in_order(dead, threads, piece, monkeypatch):
    """The survivors stay in order, in every column, however many rows are looked at together; the rows behind them are 0."""
    monkeypatch.setattr(processors, "PIECE", piece)
    particles = filled(1000, threads)
    mask = np.array([dead(row) for row in range(1000)])
    particles.kill(mask)
    assert particles.compact() == mask.sum()
    assert numbers(particles) == [row + 1 for row in range(1000) if not mask[row]]
    assert particles.compact() == 0


def test_compact_moves_nothing_before_the_first_dead(monkeypatch):
    """Rows before the first dead one are not even read."""
    particles = filled(1000)
    moved = []
    kernel = processors._move_down
    monkeypatch.setattr(processors, "_move_down", lambda values, rows, *rest: (moved.append(rows), kernel(values, rows, *rest)))
    particles.kill(np.array([900, 950]))
    particles.compact()
    assert moved and min(rows.min() for rows in moved) == 901


@settings(max_examples=60, deadline=None)
@given(st.data(), st.sampled_from(THREADS))
def test_any_history_matches_a_list(data, threads):
    """After any sequence of births, copies, deaths and compactions the set tells what a plain list tells."""
    particles, model, dead = filled(0, threads), [], set()
    for _ in range(data.draw(st.integers(1, 12))):
        act = data.draw(st.sampled_from(["allocate", "duplicate", "kill", "mask", "compact"]))
        some = data.draw(st.lists(st.integers(0, len(model) - 1), max_size=300)) if model else []
        if act == "allocate":
            n = data.draw(st.integers(0, 700))
            first = particles.take_ordinals(n) + 1
            number(particles, particles.allocate(n), np.arange(first, first + n))
            model += range(first, first + n)
        elif act == "duplicate":
            particles.duplicate(np.array(some, np.int64))
            model += [model[row] for row in some]
        elif act == "kill":
            particles.kill(np.array(some, np.int64))
            dead |= set(some)
        elif act == "mask":
            particles.kill(np.isin(np.arange(len(model)), some).astype(np.uint8))
            dead |= set(some)
        else:
            assert particles.compact() == len(dead)
            model, dead = [told for row, told in enumerate(model) if row not in dead], set()
        assert numbers(particles) == model


def test_the_dead_stay_until_compaction():
    """Killing moves nothing; a copy of a dead row lives; killing twice removes once."""
    particles = filled(3)
    particles.kill(np.array([0]))
    particles.duplicate(np.array([0]))
    particles.kill(np.array([True, False, False, False]))
    assert numbers(particles) == [1, 2, 3, 1]
    assert particles.compact() == 1
    assert numbers(particles) == [2, 3, 1]


@pytest.mark.parametrize("threads", THREADS)
def test_a_million_rows(threads):
    """A million rows with every third dead close up the same on any number of threads."""
    particles = ProcessorSet({"id": Column("id"), "radius": Column("float")}, threads=threads)
    particles.allocate(1_000_000)
    for name in particles.columns:
        particles.column(name)[0][:] = np.arange(1_000_000)
    particles.kill(np.arange(0, 1_000_000, 3))
    particles.compact()
    survivors = np.flatnonzero(np.arange(1_000_000) % 3)
    for name in particles.columns:
        assert (particles.column(name)[0] == survivors).all()
        assert not particles.arrays(name)[0][len(survivors) :].any()


def test_ordinals_are_never_used_again():
    """Birth numbers go on after deaths and compaction."""
    particles = filled(0)
    assert particles.take_ordinals(3) == 0
    particles.allocate(3)
    particles.kill(np.arange(3))
    particles.compact()
    assert (particles.take_ordinals(2), particles.next_ordinal) == (3, 5)


def test_limit_is_a_clear_refusal():
    """A set that would pass its limit says so and stays as it was; just reaching it is allowed."""
    particles = filled(900, limit_rows=1000)
    with pytest.raises(LimitError) as refusal:
        particles.allocate(101)
    assert str(refusal.value) == (
        "there would be 1,001 particles, and the limit is 1,000: raise the limit, or make fewer (rate, life, count)"
    )
    with pytest.raises(LimitError):
        particles.duplicate(np.zeros(101, np.int64))
    assert numbers(particles) == list(range(1, 901))
    assert particles.allocate(100) == slice(900, 1000)


@pytest.mark.parametrize("rows", [[10], [-1], [0, 2**40]])
def test_rows_that_do_not_exist_are_refused(rows):
    """Rows outside the set are refused, the padding's too, and the set stays as it was."""
    particles = filled(10)
    for act in (particles.kill, particles.duplicate):
        with pytest.raises(IndexError, match="there are 0 to 9"):
            act(np.array(rows))
    assert particles.compact() == 0
    assert numbers(particles) == list(range(1, 11))


def test_wrong_calls_are_refused():
    """A mask of another length, a negative number of rows, an unknown type: each is named."""
    particles = filled(10)
    with pytest.raises(ValueError, match="the mask has 256 rows, and the set 10"):
        particles.kill(np.zeros(256, np.bool_))
    with pytest.raises(ValueError, match="cannot add -1 rows"):
        particles.allocate(-1)
    with pytest.raises(ValueError, match="no column type 'vec2'; there are float, vec3"):
        Column("vec2")
    with pytest.raises(ValueError, match="a float column takes 1 numbers"):
        Column("float", (1, 2, 3))
    with pytest.raises(ValueError, match="precision is 16; it can be 32 or 64"):
        ProcessorSet({}, 16)


def test_a_set_without_columns():
    """A set of rows without any state still counts them."""
    particles = ProcessorSet({})
    particles.allocate(5)
    particles.kill(np.array([1]))
    assert (particles.compact(), particles.count, particles.bytes_per_row) == (1, 4, 0)


def test_memory_is_given_back():
    """When most rows have died the capacity follows; small losses leave it alone."""
    particles = filled(100_000)
    capacity = particles.capacity
    particles.kill(np.arange(10_000))
    particles.compact()
    assert particles.capacity == capacity
    particles.kill(np.arange(80_000))
    particles.compact()
    assert particles.capacity <= 10_000 * 33 / 32 + BLOCK
    assert numbers(particles) == list(range(90_001, 100_001))
