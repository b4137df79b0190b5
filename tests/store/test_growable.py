"""Arrays that grow without being copied."""

import sys

import numpy as np
import pytest

from graphfx.store.growable import GrowableArray


def grown(*lengths, dtype=np.float32):
    growable = GrowableArray(dtype)
    for length in lengths:
        growable.resize(length)
    return growable


@pytest.mark.parametrize("lengths", [(5,), (5, 10_000), (10_000, 5, 3000), (7, 0, 9), (2000, 1500, 2000)])
def test_new_elements_are_zero(lengths):
    """Whatever was there before a shrink, elements that growing adds are 0, and kept ones stay."""
    growable = GrowableArray(np.int32)
    kept = np.empty(0, np.int32)
    for length in lengths:
        growable.resize(length)
        least = min(length, len(kept))
        assert growable.array.tolist() == [*kept[:least].tolist(), *[0] * (length - least)]
        growable.array[:] = np.arange(1, length + 1)
        kept = growable.array.copy()


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux can resize a mapping")
def test_growing_does_not_copy():
    """Nothing is copied while nobody else looks at the array."""
    assert grown(*range(1000, 1_000_000, 10_000)).copies == 0


def test_an_old_view_stays_readable():
    """A view kept over a resize shows what was, and no longer what is; the array itself is right."""
    growable = grown(1000)
    growable.array[:] = 7
    view = growable.array[:]
    growable.resize(2_000_000)
    growable.array[:] = 8
    assert (view == 7).all()
    growable.resize(10)
    assert (view == 7).all()
    assert growable.array.tolist() == [8] * 10
