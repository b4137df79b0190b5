"""Scan, segmented scan, gather, partition."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hn

from graphfx.store import exclusive_scan, gather, offsets, partition, primitives, segmented_scan

THREADS = [1, 2, 7]
EXAMPLES = settings(max_examples=60, deadline=None)
FLOATS = {"float32": np.float32, "float64": np.float64}


@pytest.fixture(autouse=True, scope="module")
def small_grain():
    """Give every few elements a thread, so that small arrays are divided too."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(primitives, "GRAIN", 1)
        yield


@EXAMPLES
@given(hn.arrays(st.sampled_from([np.int32, np.int64, np.uint8, np.bool_]), st.integers(0, 50)))
def test_scan_sums_all_before(values):
    """Element i of an exclusive scan is the sum of elements 0 to i - 1, and `offsets` ends with the total."""
    with np.errstate(over="ignore"):
        sums = np.cumsum(values, dtype=np.int64)
    assert offsets(values).tolist() == [0, *sums.tolist()]
    assert exclusive_scan(values).tolist() == [0, *sums.tolist()][:-1]


def test_scan_does_not_overflow_its_input():
    """Sums of int32 counts pass 2**31."""
    assert offsets(np.full(3, 2**31 - 1, np.int32))[-1] == 3 * (2**31 - 1)


def test_scan_refuses_floats():
    """A float scan is refused, for its result would depend on the order."""
    with pytest.raises(TypeError, match="float32"):
        exclusive_scan(np.ones(3, np.float32))


def fold(values, starts, operation, exclusive):
    """Return a segmented scan by the definition, one NumPy scalar operation at a time."""
    result = np.empty_like(values)
    combine = np.add if operation == "add" else np.multiply
    stops = [*starts[1:], len(values)]
    for start, stop in zip(starts, stops, strict=True):
        total = values.dtype.type(0 if operation == "add" else 1)
        for i in range(start, stop):
            before = total
            total = values[i] if i == start else combine(total, values[i])
            result[i] = before if exclusive else total
    return result


@st.composite
def segments(draw):
    values = draw(hn.arrays(st.sampled_from([np.float32, np.float64, np.int64]), st.integers(0, 40)))
    inner = draw(st.lists(st.integers(0, len(values)), max_size=10))
    return values, np.array(sorted([0, *inner]), np.int64)


@EXAMPLES
@given(segments(), st.sampled_from(["add", "multiply"]), st.booleans(), st.sampled_from(THREADS))
@pytest.mark.filterwarnings("ignore::RuntimeWarning")
def test_segmented_scan_is_the_left_fold(data, operation, exclusive, threads):
    """Each segment is folded from its first row to its last, to the bit, for any number of threads."""
    values, starts = data
    with np.errstate(all="ignore"):
        expected = fold(values, starts, operation, exclusive)
    assert np.array_equal(segmented_scan(values, starts, operation, exclusive, threads), expected, equal_nan=True)


@pytest.mark.parametrize("exclusive", [False, True])
def test_order_of_fold_shows(exclusive):
    """1 + 2**-24 - 1 in float32, folded from the left, is 0: no other order, no wider sum."""
    values = np.array([1, 2.0**-24, -1, 5], np.float32)
    expected = [0, 1, 1, 0] if exclusive else [1, 1, 0, 5]
    assert segmented_scan(values, np.array([0]), exclusive=exclusive).tolist() == expected


def test_negative_zero_stays():
    """A segment's first sum is its first value itself: -0 stays -0."""
    assert math.copysign(1, segmented_scan(np.array([-0.0]), np.array([0]))[0]) == -1


def test_nothing_leaks_from_one_segment_to_the_next():
    """NaN and infinity stay in their segment."""
    values = np.array([np.nan, np.inf, -np.inf, 1, 2], np.float32)
    result = segmented_scan(values, partition(np.array([True, True, False, True, False])))
    assert result[3:].tolist() == [1, 3]


def test_segments_from_flags_or_offsets():
    """Starts may be the rows of flags, or offsets of counts with empty groups among them."""
    values = np.arange(1.0, 7.0)
    flags = np.array([1, 0, 0, 1, 0, 0], np.uint8)
    by_flags = segmented_scan(values, partition(flags), "multiply")
    assert by_flags.tolist() == segmented_scan(values, offsets(np.array([3, 0, 3, 0])), "multiply").tolist()
    assert by_flags.tolist() == [1, 2, 6, 4, 20, 120]


@pytest.mark.parametrize("starts", [[], [1], [0, 3, 2], [0, 5], [-1, 2], [0, -1]])
def test_wrong_starts_are_refused(starts):
    """Starts that leave out rows, go back, or pass the end are refused before anything is read."""
    with pytest.raises(ValueError, match="start"):
        segmented_scan(np.ones(4), np.array(starts, np.int64))


def test_unknown_operation_is_refused():
    """Only sums and products are scanned."""
    with pytest.raises(ValueError, match="'max'; it can be 'add' or 'multiply'"):
        segmented_scan(np.ones(4), np.array([0]), "max")


@pytest.mark.parametrize("threads", THREADS)
def test_segmented_scan_of_a_million(threads):
    """A million rows give the same bytes on any number of threads, one segment of half of them included."""
    rng = np.random.default_rng(3)
    values = rng.random(1_000_000, np.float32)
    starts = np.array([0, *np.sort(rng.integers(500_000, 1_000_000, 20_000))])
    result = segmented_scan(values, starts, threads=threads)
    assert result[:500_000].tobytes() == np.cumsum(values[: starts[1]])[:500_000].tobytes()
    assert result.tobytes() == segmented_scan(values, starts).tobytes()


@EXAMPLES
@given(hn.arrays(np.float32, st.integers(1, 40)), st.data(), st.sampled_from([np.int64, np.uint32, np.int32]))
@pytest.mark.parametrize("threads", THREADS)
def test_gather_takes_rows(threads, values, data, dtype):
    """Gathering is indexing, in any order and with repeats."""
    rows = np.array(data.draw(st.lists(st.integers(0, len(values) - 1), max_size=40)), dtype)
    assert gather(values, rows, threads=threads).tobytes() == values[rows.astype(np.int64)].tobytes()


@pytest.mark.parametrize("dtype", [np.uint8, np.int16, np.int32, np.uint64, np.float32, np.float64])
def test_gather_keeps_type_and_bits(dtype):
    """Elements of every size arrive bit for bit, from views with gaps too."""
    values = np.arange(100).astype(dtype)[::3]
    result = gather(values, np.array([3, 0, 3]))
    assert (result.dtype, result.tolist()) == (dtype, [9, 0, 9])


def test_gather_keeps_payload_of_nan():
    """A NaN with a payload is moved, not computed with."""
    bits = np.array([0x7FA00001, 0xFFC12345], np.uint32)
    assert gather(bits.view(np.float32), np.array([1, 0])).view(np.uint32).tolist() == [0xFFC12345, 0x7FA00001]


@pytest.mark.parametrize("rows", [[3], [-1], [0, 2**40], [-(2**63)]])
@pytest.mark.parametrize("threads", THREADS)
def test_gather_refuses_rows_that_do_not_exist(rows, threads):
    """A row past the end or before the start raises; no memory outside is read."""
    with pytest.raises(IndexError, match="0 to 2"):
        gather(np.ones(3, np.float32), np.array(rows), threads=threads)


def test_gather_refuses_float_rows():
    """Row numbers are integers."""
    with pytest.raises(TypeError):
        gather(np.ones(3), np.array([1.0]))


def test_gather_refuses_a_result_of_another_shape():
    """What `out` holds is checked before it is written."""
    for out in (np.empty(1), np.empty(2, np.float32)):
        with pytest.raises(ValueError, match="out must hold 2 elements of float64"):
            gather(np.ones(3), np.array([0, 1]), out=out)


@EXAMPLES
@given(hn.arrays(st.sampled_from([np.bool_, np.uint8]), st.integers(0, 60)))
def test_partition_lists_true_rows(mask):
    """Partition lists the rows that are not 0, ascending, any uint8 counting as true."""
    assert partition(mask).tolist() == [row for row, flag in enumerate(mask.tolist()) if flag]


def test_partition_refuses_row_numbers():
    """An integer array that is no mask is refused."""
    with pytest.raises(TypeError, match="int64"):
        partition(np.array([3, 4]))
