"""Random numbers on lanes: Philox4x32-10, the same bits as `graphfx.math.random`."""

from __future__ import annotations

from functools import cache

from graphfx.lanes import inlined
from graphfx.lanes.cache import engine_digest
from graphfx.lanes.memory import FLOAT_LANES
from graphfx.lanes.operands import multiply_high_low, word_constant
from graphfx.lanes.types import Real
from graphfx.machine.kernels import DTYPES, Kernel, compile_source
from graphfx.math.random import PHILOX_MULTIPLIERS, PHILOX_WEYL

FIRST, SECOND = PHILOX_MULTIPLIERS
WEYL_FIRST, WEYL_SECOND = PHILOX_WEYL

SOURCE = """def kernel(S, C, M):
    first, second = read_number(C, 8), read_number(C, 9)
    for l in range(0, 256, {width}):
        on = read_mask(R, M, C, 0, l)
        if any_lane(on):
            i, n, c = read_id(R, S, C, 1, l), read_word(R, S, C, 3, l), read_word(R, S, C, 5, l)
            w = draw(R, i[0], i[1], n[0], c[0], first, second)
            write_draw(R, S, C, 7, l, on, (uniform_of(R, w[0]), uniform_of(R, w[1]), uniform_of(R, w[2]), uniform_of(R, w[3])))
"""
"""Operands: mask, id, life, cell, the result, the two words of the key."""


@inlined
def philox_lanes(model, a, b, c, d, first_key, second_key):
    """Return four words per lane from a counter of four words and a key of two."""
    for turn in range(10):
        high0, low0 = multiply_high_low(a, FIRST)
        high1, low1 = multiply_high_low(c, SECOND)
        a = high1 ^ b ^ word_constant(model, first_key + turn * WEYL_FIRST)
        c = high0 ^ d ^ word_constant(model, second_key + turn * WEYL_SECOND)
        b, d = low1, low0
    return a, b, c, d


@cache
def draw_kernel(precision: int = 32) -> Kernel:
    """Return the kernel that draws four numbers for each particle."""
    dtype = DTYPES[precision]
    width = FLOAT_LANES[dtype]
    stamp = engine_digest("math", "lanes", "machine")
    return compile_source("draw", SOURCE.format(width=width), {"draw": philox_lanes}, Real(dtype, width), stamp)
