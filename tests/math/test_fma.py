"""fma rounds once: against exact fractions."""

from fractions import Fraction

import numpy as np
import pytest

from graphfx.math import fma

KINDS = [np.float32, np.float64]
MOST = 1e30  # stands for the largest finite value of the precision
BITS = {np.float32: (np.uint32, 24), np.float64: (np.uint64, 53)}


def rounded(exact, kind):
    """Return the value of the kind that is nearest a non-zero fraction, ties to even: chosen among neighbours."""
    largest = Fraction(float(np.finfo(kind).max))
    half_step = largest / (2 ** BITS[kind][1] - 1) / 2
    if abs(exact) >= largest + half_step:
        return kind(np.inf if exact > 0 else -np.inf)
    guess = kind(float(max(-largest, min(largest, exact))))
    with np.errstate(over="ignore"):
        around = np.nextafter(guess, kind(-np.inf)), np.nextafter(guess, kind(np.inf))
    near = [v for v in (guess, *around) if np.isfinite(v)]
    return min(near, key=lambda v: (abs(Fraction(float(v)) - exact), int(v.view(BITS[kind][0])) & 1))


def expected(a, b, c, kind):
    exact = Fraction(float(a)) * Fraction(float(b)) + Fraction(float(c))
    return rounded(exact, kind) if exact else kind(0)


def random_bits(count, kind, seed):
    """Return finite values with every bit random: all exponents, denormals too."""
    bits = np.random.default_rng(seed).integers(0, 2 ** (8 * np.dtype(kind).itemsize), 3 * count, dtype=BITS[kind][0])
    values = bits.view(kind)
    return values[np.isfinite(values)][:count]


def hostile(kind):
    """Return triples that cancel, tie, overflow or underflow, by turns."""
    digits, draw = BITS[kind][1], np.random.default_rng(7)
    info, step = np.finfo(kind), 2.0 ** (1 - BITS[kind][1])
    for _ in range(250):
        a, b = kind(draw.uniform(1, 2)), kind(draw.uniform(1, 2))
        small = kind(2.0 ** -int(draw.integers(digits - 3, 3 * digits)) * draw.choice([-1, 1]))
        yield a, b, -(a * b)
        yield a, b, kind(float(-(a * b)) * (1 + step * int(draw.integers(-2, 3))))
        yield kind(1 + step), kind(1 + step * int(draw.integers(0, 8))), small
        yield kind(1 + 2.0 ** -(digits // 2)), kind(1 + 2.0 ** -(digits - digits // 2)), small
        yield info.max, kind(1), kind(float(info.max) * step * draw.choice([0.2, 0.25, 0.26, -0.25]))
        yield info.max, info.max, -info.max
        yield info.tiny * a, kind(step * b), info.tiny * kind(draw.uniform(-1, 1))
        least = info.smallest_subnormal
        yield least, kind(draw.choice([0.25, 0.5, 0.75, 1.5])), least * kind(draw.integers(-2, 3))


@pytest.mark.parametrize("kind", KINDS)
def test_any_finite_values_round_once(kind):
    """The result is the representable value nearest the exact one, whatever the exponents."""
    triples = zip(*(random_bits(3000, kind, seed) for seed in (1, 2, 3)), strict=True)
    wrong = [t for t in triples if fma(*t) != expected(*t, kind)]
    assert wrong == []


@pytest.mark.parametrize("kind", KINDS)
def test_hostile_values_round_once(kind):
    """Cancellation, ties, overflow and underflow are rounded once too, and the precision is kept."""
    with np.errstate(all="ignore"):
        triples = list(hostile(kind))
    wrong = [t for t in triples if fma(*t) != expected(*t, kind) or type(fma(*t)) is not kind]
    assert wrong == []


@pytest.mark.parametrize("kind", KINDS)
def test_arrays_give_what_scalars_give(kind):
    """An array of triples gives, to the bit, what one triple at a time gives."""
    with np.errstate(all="ignore"):
        triples = list(hostile(kind)) + list(zip(*(random_bits(2000, kind, seed) for seed in (4, 5, 6)), strict=True))
    together = fma(*(np.array(column, kind) for column in zip(*triples, strict=True)))
    alone = np.array([fma(*triple) for triple in triples], kind)
    assert together.dtype == kind
    assert np.array_equal(together.view(BITS[kind][0]), alone.view(BITS[kind][0]))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "a, b, c, result",
    [
        (np.inf, 2, 1, np.inf), (-np.inf, 2, np.inf, np.nan), (0, np.inf, 1, np.nan), (1, 1, np.nan, np.nan),
        (MOST, MOST, -np.inf, -np.inf), (MOST, -MOST, np.inf, np.inf), (2, 3, np.inf, np.inf),
        (0, 1, -0.0, 0.0), (-0.0, 1, -0.0, -0.0), (2, 3, -6, 0.0), (-2, 3, 6, 0.0),
    ],
)
def test_special_values_follow_ieee(kind, a, b, c, result):
    """Infinities, NaN and the signs of zeros are those of IEEE 754's fused operation."""
    values = [np.finfo(kind).max * kind(np.sign(v)) if abs(v) == MOST else kind(v) for v in (a, b, c)]
    with np.errstate(all="ignore"):
        got = fma(*values)
        together = fma(*(np.array([v]) for v in values))[0]
    for value in (got, together):
        assert np.array_equal(value, kind(result), equal_nan=True)
        assert np.isnan(result) or np.signbit(value) == np.signbit(result)


def test_literals_take_the_lane_precision():
    """A Python float beside float32 is rounded to float32 before it is used."""
    assert fma(np.float32(3), 0.1, 0.2) == fma(np.float32(3), np.float32(0.1), np.float32(0.2))
    assert type(fma(0.1, np.float32(3), 0.2)) is np.float32
    assert type(fma(0.1, np.float64(3), 0.2)) is np.float64
