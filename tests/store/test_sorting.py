"""Stable sorting by radix."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hn

from graphfx.store import sorting, stable_argsort, stable_argsort_words

THREADS = [1, 2, 7]
EXAMPLES = settings(max_examples=60, deadline=None)


@pytest.fixture(autouse=True, scope="module")
def small_grain():
    """Sort even a few keys by radix, on many threads."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sorting, "GRAIN", 1)
        patch.setattr(sorting, "SMALL", 0)
        yield


def float_keys(dtype, bits):
    """Any bit pattern, and often the hard ones: both zeros, denormals, infinities, NaN of both signs, repeats."""
    tiny = float(np.finfo(dtype).smallest_subnormal)
    hard = st.sampled_from([0.0, -0.0, tiny, -tiny, 2 * tiny, np.inf, -np.inf, np.nan, -np.nan, 1.0, -1.0])
    word = np.dtype(f"u{bits // 8}")
    values = st.lists(hard, max_size=40).map(lambda keys: np.array(keys, dtype))
    return st.one_of(values, hn.arrays(word, st.integers(0, 40)).map(lambda words: words.view(dtype)))


@EXAMPLES
@given(st.one_of(float_keys(np.float32, 32), float_keys(np.float64, 64)), st.sampled_from(THREADS))
def test_floats_sort_as_in_numpy(keys, threads):
    """Keys of any bits sort as NumPy's stable sort has it: -0 equals +0, NaN last in the order of their rows."""
    assert stable_argsort(keys, threads).tolist() == np.argsort(keys, kind="stable").tolist()


@EXAMPLES
@given(hn.arrays(st.sampled_from([np.uint32, np.uint64]), st.integers(0, 60)), st.sampled_from(THREADS))
def test_words_sort_as_in_numpy(words, threads):
    """Words of 32 and 64 bits sort as NumPy's stable sort has it."""
    assert stable_argsort_words(words, threads).tolist() == np.argsort(words, kind="stable").tolist()


@pytest.mark.parametrize("bits", [[], [0], [31], [63], [7, 8], [33, 50], [0, 63], [31, 32], [5, 20, 40, 60], list(range(64))])
@pytest.mark.parametrize("threads", THREADS)
def test_only_some_bits_vary(bits, threads):
    """Whichever bits differ between the keys, skipped digits change nothing; equal keys keep their order."""
    chosen = np.random.default_rng(1).integers(0, 2, (500, 64)).astype(np.uint64)
    words = np.full(500, 0x123456789ABCDEF0, np.uint64)
    for bit in bits:
        words ^= chosen[:, bit] << np.uint64(bit)
    assert stable_argsort_words(words, threads).tolist() == np.argsort(words, kind="stable").tolist()


@pytest.mark.parametrize("varying, passes", [(0, 0), (1 << 40, 1), (0xFF, 1), (0x1FF, 2), (0x80000001, 2), (2**64 - 1, 8)])
def test_constant_digits_cost_no_pass(varying, passes):
    """There are only as many passes as the varying bits need."""
    assert len(list(sorting._steps(varying, 8))) == passes


@pytest.mark.parametrize("bits, passes", [((), 0), ((3, 5), 1), ((20, 33, 60), 3)])
def test_bits_that_all_keys_share_cost_no_pass(monkeypatch, bits, passes):
    """Digits that are set but equal in all keys are skipped."""
    moves = []
    move = sorting._Sort._move
    monkeypatch.setattr(sorting._Sort, "_move", lambda *arguments: (moves.append(1), move(*arguments)))
    words = np.full(50, 0x123456789ABCDEF0, np.uint64)
    for bit in bits:
        words[::bit] ^= np.uint64(1 << bit)
    stable_argsort_words(words)
    assert len(moves) == passes


@pytest.mark.parametrize("count", [0, 1, 2])
def test_hardly_any_keys(count):
    """No key, one key, two equal keys: they stay where they are."""
    assert stable_argsort(np.zeros(count, np.float32), 7).tolist() == list(range(count))


@pytest.mark.parametrize("threads", THREADS)
def test_a_million_keys(threads):
    """A million depths, many of them equal, some negative, sort stably on any number of threads."""
    keys = np.random.default_rng(2).normal(size=1_000_000).astype(np.float16).astype(np.float32)
    rows = stable_argsort(keys, threads)
    assert rows.dtype == np.uint32
    ordered = keys[rows]
    assert (ordered[1:] >= ordered[:-1]).all()
    assert (rows[1:] > rows[:-1])[ordered[1:] == ordered[:-1]].all()
    assert np.bincount(rows, minlength=len(keys)).max() == 1


def test_keys_with_gaps_and_read_only():
    """Views with gaps and arrays that must not be written are sorted where they lie."""
    keys = np.arange(3000, 0, -1, np.float32)
    keys.flags.writeable = False
    assert stable_argsort(keys[::3]).tolist() == list(range(999, -1, -1))


def test_small_sorts_agree_with_large(monkeypatch):
    """Short arrays, which NumPy sorts, come out as the radix sort has them."""
    keys = np.array([np.nan, 0.0, -0.0, -1, np.inf, -np.nan, -1], np.float32)
    by_radix = stable_argsort(keys)
    monkeypatch.setattr(sorting, "SMALL", 100)
    by_merge = stable_argsort(keys)
    assert (by_merge.tolist(), by_merge.dtype) == (by_radix.tolist(), by_radix.dtype)
    assert by_radix.tolist() == [3, 6, 1, 2, 4, 0, 5]


@pytest.mark.parametrize("dtype", [np.int32, np.float16, np.uint8])
def test_other_keys_are_refused(dtype):
    """Keys of any other type are refused by name."""
    for sort in (stable_argsort, stable_argsort_words):
        with pytest.raises(TypeError, match=np.dtype(dtype).name):
            sort(np.zeros(3, dtype))
