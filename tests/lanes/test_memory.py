"""Loads, stores, and questions across lanes."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.lanes import any_lane, compiled, highest, iota, load, lowest, mask_bits, mask_from_bits, splat, store
from graphfx.math import where

LANES = {np.float32: 16, np.float64: 8}


@compiled
def copied(source, target, begin):
    store(target, begin + 1, load(source, begin))


@compiled
def extremes(source):
    return lowest(load(source, 0)), highest(load(source, 0))


@compiled
def bits_above(source, least):
    above = load(source, 0) > splat(least)
    return mask_bits(above), any_lane(above)


@compiled
def chosen(target, bits):
    store(target, 0, where(mask_from_bits(bits), iota(), -1.0))


@pytest.mark.parametrize("kind", LANES)
@pytest.mark.parametrize("begin", [0, 1, 5])
def test_store_writes_what_load_read_and_nothing_else(kind, begin):
    """As many elements as there are lanes move, from any element on, and no others change."""
    source, target = np.arange(40).astype(kind), np.full(40, -1).astype(kind)
    copied(source, target, begin)
    wanted = np.full(40, -1).astype(kind)
    wanted[begin + 1 : begin + 1 + LANES[kind]] = source[begin : begin + LANES[kind]]
    assert np.array_equal(target, wanted)


@pytest.mark.parametrize("kind", LANES)
def test_extremes_over_lanes(kind):
    """The least and the greatest lane are found wherever they stand."""
    values = np.array([3, -7, 5, 1, -2, 9, 0, 4] * 2, kind)
    for shift in range(8):
        assert extremes(np.roll(values, shift)) == (-7, 9)


@pytest.mark.parametrize("kind", LANES)
def test_bit_l_is_lane_l(kind):
    """A comparison's bits count lanes from the lowest bit."""
    values = np.zeros(16, kind)
    values[[1, 6]] = 1
    assert bits_above(values, kind(0.5)) == (0b1000010, True)
    assert bits_above(values, kind(1.5)) == (0, False)


@pytest.mark.parametrize("bits", [0, 1, 0x8000, 0xA5C3, 0xFFFF])
def test_mask_from_bits_is_the_inverse(bits):
    """Lane l is chosen exactly where bit l is on."""
    target = np.zeros(16, np.float32)
    chosen(target, bits)
    assert target.tolist() == [lane if bits >> lane & 1 else -1 for lane in range(16)]
