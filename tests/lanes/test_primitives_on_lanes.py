"""Lanes give the bits of plain Python: operators, primitives, masks, at every width and precision."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.math import absolute, copysign, floor, fma, maximum, minimum, scale2, split2, sqrt, where
from graphfx.program import Bundle

from .blocks import KINDS, WIDTHS, adversarial, in_plain_python, on_lanes, pairs, same_bits, scattered

BUNDLE = Bundle("test_primitives")


@BUNDLE.function("float float", "float float float float")
def four_operations(a, b):
    return a + b, a - b, a * b, a / b


@BUNDLE.function("float float", "float float float float float")
def signs(a, b):
    return -a, +a, absolute(a), copysign(a, b), abs(b)


@BUNDLE.function("float float", "float float float float")
def choices(a, b):
    return minimum(a, b), maximum(a, b), minimum(b, 1.5), maximum(-1.0, a)


@BUNDLE.function("float float", "bool bool bool bool bool bool")
def comparisons(a, b):
    return a < b, a <= b, a > b, a >= b, a == b, a != b


@BUNDLE.function("float float", "float float float")
def roundings(a, b):
    return floor(a), sqrt(a), floor(-b)


@BUNDLE.function("float float float", "float")
def fused(a, b, c):
    return fma(a, b, c)


@BUNDLE.function("float float", "float float float float")
def literals(a, b):
    total = a * 0.1
    total += 1 / 3
    total -= b
    total *= 3
    total /= 7
    return a * 2 + 1, 1.0 / a, total, fma(a, 0.3, -0.7)


@BUNDLE.function("float float", "bool bool bool bool")
def masks(a, b):
    low, high = a < b, a > 0.0
    return low & high, low | high, low ^ high, ~(low & ~high)


@BUNDLE.function("float float bool", "float float float bool float")
def selections(a, b, condition):
    third = where(condition & (a <= 1.0), 0.1, 1.0)
    return where(condition, a, b), where(a > b, a, 0.25), third * a, where(condition, a > b, a < b), where(~(a > b), third, b)


@BUNDLE.function("float float", "float")
def scaled(x, k):
    return scale2(x, k)


@BUNDLE.function("float", "float float")
def halved(x):
    return split2(x)


TWO = [four_operations, signs, choices, comparisons, roundings, literals, masks]


@pytest.mark.parametrize("precision, width", WIDTHS)
@pytest.mark.parametrize("function", TWO, ids=lambda function: function.name)
def test_two_arguments(function, precision, width):
    """For every pair of hostile values, and for random ones, lanes give what one particle gives."""
    hostile = pairs(adversarial(precision)[:: 1 if width == 0 else 3])
    random = scattered(precision, 500, 1), scattered(precision, 500, 2)[::-1]
    columns = [np.concatenate(both) for both in zip(hostile, random, strict=True)]
    same_bits(on_lanes(function, columns, precision, width), in_plain_python(function, columns, precision), columns)


@pytest.mark.parametrize("precision, width", WIDTHS)
def test_fma_rounds_once(precision, width):
    """a b + c is rounded once on lanes, for hostile triples and for products that c nearly cancels."""
    few = adversarial(precision)[::4]
    a, b = pairs(few)
    hostile = [np.tile(a, len(few)), np.tile(b, len(few)), np.repeat(few, len(a))]
    near = [scattered(precision, 600, seed) for seed in (3, 4)]
    with np.errstate(all="ignore"):
        cancelling = [*near, -(near[0] * near[1])]
    columns = [np.concatenate(both) for both in zip(hostile, cancelling, strict=True)]
    same_bits(on_lanes(fused, columns, precision, width), in_plain_python(fused, columns, precision), columns)


@pytest.mark.parametrize("precision, width", WIDTHS)
def test_where_takes_a_mask(precision, width):
    """`where` chooses lane by lane by a stored truth, by a comparison, and between truths."""
    a, b = pairs(adversarial(precision))
    columns = [a, b, np.random.default_rng(5).random(len(a)) < 0.5]
    same_bits(on_lanes(selections, columns, precision, width), in_plain_python(selections, columns, precision), columns)


@pytest.mark.parametrize("precision, width", WIDTHS)
def test_scale2_over_its_whole_range(precision, width):
    """x 2^k is the same at every k that is allowed, its two ends included, and for NaN times NaN."""
    least, most = (-127, 128) if precision == 32 else (-1023, 1024)
    k = np.arange(least, most + 1).astype(KINDS[precision])
    x = np.resize(adversarial(precision), len(k) * 9)
    columns = [x, np.repeat(k, 9)]
    same_bits(on_lanes(scaled, columns, precision, width), in_plain_python(scaled, columns, precision), columns)
    nan = np.full(3, np.nan, KINDS[precision])
    assert all(np.isnan(part).all() for part in on_lanes(scaled, [nan, nan], precision, width))


@pytest.mark.parametrize("precision, width", WIDTHS)
def test_split2_even_where_it_means_nothing(precision, width):
    """The parts of x = m 2^e are the same for all x but NaN: negative, denormal and infinite ones too."""
    values = np.concatenate([adversarial(precision)[:-1], scattered(precision, 2000, 6)])
    same_bits(on_lanes(halved, [values], precision, width), in_plain_python(halved, [values], precision), [values])


def test_wide_and_narrow_registers_agree_on_a_partial_block():
    """Lanes of the last, partial group give what they give in a full one."""
    a, b = scattered(32, 270, 7), scattered(32, 270, 8)
    whole = on_lanes(four_operations, [a, b], 32)
    part = on_lanes(four_operations, [a[:261], b[:261]], 32)
    same_bits(part, [column[:261] for column in whole])
