"""Random numbers from counters: known answers, and independence of everything that should not matter."""

import itertools

import numpy as np
import pytest

from graphfx.math.random import counter_of, key_of, philox4x32, spawned_id, uniform

ONES = 0xFFFFFFFF
KNOWN = [  # the vectors published with Random123, kat_vectors
    ((0, 0, 0, 0), (0, 0), (0x6627E8D5, 0xE169C58D, 0xBC57AC4C, 0x9B00DBD8)),
    ((ONES,) * 4, (ONES,) * 2, (0x408F276D, 0x41C83B0E, 0xA20BC7C6, 0x6D5451FD)),
    (
        (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344),
        (0xA4093822, 0x299F31D0),
        (0xD16CFE09, 0x94FDCCEB, 0x5001E420, 0x24126EA1),
    ),
]
COUNT = 100_000


def draws(ids=0, life=0, cell=0, key=(1, 2)):
    """Return the four columns of uniform numbers for arrays of ids, lives or cells."""
    return [uniform(word) for word in philox4x32(counter_of(ids, life, cell), key)]


def along(which):
    """Return 4 columns of draws along ids, lives, cells or keys, all else held."""
    steps = np.arange(COUNT, dtype=np.uint64)
    if which == "keys":
        drawn = [philox4x32((5, 0, 0, 0), key_of(7, "snow", n)) for n in range(COUNT // 10)]
        return [uniform(np.array(column)) for column in zip(*drawn, strict=True)]
    return draws(**{which: steps})


STREAMS = pytest.mark.parametrize("which", ["ids", "life", "cell", "keys"])


@pytest.mark.parametrize("counter, key, words", KNOWN)
def test_known_answers(counter, key, words):
    """Philox4x32-10 gives the published words, from integers and from arrays."""
    assert philox4x32(counter, key) == words
    together = philox4x32(tuple(np.array([word], np.uint32) for word in counter), key)
    assert [int(column[0]) for column in together] == list(words)


def test_arrays_give_what_integers_give():
    """Many draws at once are the draws one at a time, for ids of 64 bits."""
    ids = np.array([0, 1, 2**32 - 1, 2**32, 2**63 + 5, 2**64 - 1], np.uint64)
    together = philox4x32(counter_of(ids, 3, 9), key_of("a"))
    alone = [philox4x32(counter_of(int(i), 3, 9), key_of("a")) for i in ids]
    assert list(zip(*(column.tolist() for column in together), strict=True)) == alone


def test_uniform_is_the_stated_fraction():
    """float32 is (bits >> 8) 2**-24 and float64 bits 2**-32: from 0 to below 1, the one the other cut short."""
    bits = np.array([0, 255, 256, 2**31, 2**32 - 1], np.uint64)
    single, double = uniform(bits, np.float32), uniform(bits, np.float64)
    assert single.dtype == np.float32 and double.dtype == np.float64
    assert single.tolist() == [0, 0, 2.0**-24, 0.5, 1 - 2.0**-24]
    assert double.tolist() == [0, 255 * 2.0**-32, 2.0**-24, 0.5, 1 - 2.0**-32]
    assert [uniform(int(b), np.float32) for b in bits] == single.tolist() and type(uniform(5, np.float32)) is np.float32


@STREAMS
def test_moments_are_those_of_a_uniform(which):
    """Along ids, lives, cells and keys, the first four moments lie within 4 standard deviations."""
    for column in along(which):
        for power in (1, 2, 3, 4):
            deviation = np.sqrt((1 / (2 * power + 1) - 1 / (power + 1) ** 2) / len(column))
            assert abs((column**power).mean() - 1 / (power + 1)) < 4 * deviation


@STREAMS
def test_draws_fill_the_interval_evenly(which):
    """Chi-square over 256 bins, of the high bits and of the low ones, is within 4.5 standard deviations."""
    for column in along(which):
        for values in (column, column * 2**16 % 1):
            counts = np.bincount((values * 256).astype(int), minlength=256)
            expected = len(column) / 256
            assert abs(((counts - expected) ** 2 / expected).sum() - 255) < 4.5 * np.sqrt(2 * 255)


@STREAMS
def test_neighbours_do_not_correlate(which):
    """Neither the four numbers of a draw nor draws 1, 2 or 16 apart are correlated, alone or in pairs' chi-square."""
    columns = along(which)
    pairs = [(columns[i], columns[j]) for i in range(4) for j in range(i)]
    pairs += [(column[:-lag], column[lag:]) for column in columns for lag in (1, 2, 16)]
    for a, b in pairs:
        assert abs(np.corrcoef(a, b)[0, 1]) < 4.5 / np.sqrt(len(a))
        counts = np.bincount((a * 8).astype(int) * 8 + (b * 8).astype(int), minlength=64)
        assert abs(((counts - len(a) / 64) ** 2 / (len(a) / 64)).sum() - 63) < 4.5 * np.sqrt(2 * 63)


def test_one_bit_anywhere_changes_half_of_the_bits():
    """Flipping any bit of the id, life, cell or key flips each result bit with probability one half."""
    counter, key = [11, 22, 33, 44], [55, 66]
    flips = []
    for trial in range(20):
        before = philox4x32((trial, *counter[1:]), tuple(key))
        for word in range(6):
            for bit in range(32):
                changed = [trial, *counter[1:], *key]
                changed[word] ^= 1 << bit
                after = philox4x32(tuple(changed[:4]), tuple(changed[4:]))
                flips.append(sum((a ^ b).bit_count() for a, b in zip(before, after, strict=True)))
    assert abs(np.mean(flips) - 64) < 0.5 and min(flips) > 30


def test_keys_tell_their_parts_apart():
    """Parts of another kind, at another boundary or in another order make another key."""
    parts = [(), (0,), ("",), (0, 0), ("", ""), (1,), ("1",), (-1,),
             (255,), (2**64,), ("ab", "c"), ("a", "bc"), ("abc",), ("asb",), ("a", "b"),
             ("c", "ab"), (1, "a"), ("a", 1), (0x61,), ("snow/fall", "speed"), ("snow", "fall/speed")]
    assert len({key_of(*p) for p in parts}) == len(parts)


def test_keys_are_the_same_everywhere():
    """A key depends on its parts alone: two words, fixed for ever."""
    assert key_of(7, "sky", "position") == key_of(np.int64(7), "sky", "position") == (0x6A494F21, 0x1DB90428)
    assert all(0 <= word <= ONES for word in key_of("x"))


@pytest.mark.parametrize("part", [1.5, None, True, b"x"])
def test_key_refuses_what_has_no_one_encoding(part):
    """Only integers and strings make keys."""
    with pytest.raises(TypeError, match=r"key_of takes integers and strings, not .* of type"):
        key_of("a", part)


def test_spawned_ids_are_distinct_and_no_ordinals():
    """Every (parent, life, event, number) has an id of its own, with the highest bit that no ordinal has."""
    asked = list(itertools.product((0, 1, 2**32, 2**63 + 1), range(5), range(5), range(20)))
    ids = {spawned_id(*births) for births in asked}
    assert len(ids) == len(asked)
    assert all(2**63 <= i < 2**64 for i in ids)
    parents = np.array([3, 2**40], np.uint64)
    assert spawned_id(parents, 1, 2, 3).tolist() == [spawned_id(int(p), 1, 2, 3) for p in parents]


def test_spawned_ids_do_not_depend_on_siblings():
    """The id of copy 3 is the same whether or not there are others, and is fixed for ever."""
    assert spawned_id(12, 0, 5, 3) == 0xD3D2EE7FE4391426
