"""Every elementary function keeps the error that its documentation states, in both precisions."""

import numpy as np
import pytest

from graphfx.math import acos, atan2, cos, cosinc, exp, exp2, expm1, log, log2, phi1, phi2, power, sin, sin3, sinc

WIDE = np.longdouble
COUNT = {np.float32: 60_000, np.float64: 8_000}
SINGLE, DOUBLE = 0, 1

pytestmark = pytest.mark.skipif(np.finfo(WIDE).nmant < 63, reason="needs 80-bit reference arithmetic")


def uniform(low, high):
    """Return a sampler of numbers between two bounds; a pair of bounds is one for each precision."""

    def sample(draw, kind, which):
        ends = [end[which] if isinstance(end, tuple) else end for end in (low, high)]
        return draw.uniform(*ends, COUNT[kind]).astype(kind)

    return sample


def sizes(low, high):
    """Return a sampler of positive and negative numbers of all magnitudes between two powers of ten."""

    def sample(draw, kind, which):
        return (10.0 ** uniform(low, high)(draw, np.float64, which).repeat(14)[: COUNT[kind]]
                * draw.choice([-1, 1], COUNT[kind])).astype(kind)

    return sample


def positive(sampler):
    """Return a sampler of absolute values."""
    return lambda draw, kind, which: np.abs(sampler(draw, kind, which))


def series(first, ratio):
    """Return the sum of 30 terms, each the last times ratio(x, n)."""

    def total(x):
        term = np.full_like(x, first)
        result = term
        for n in range(30):
            term = term * ratio(x, n)
            result = result + term
        return result

    return total


def split_at(bound, near, far):
    """Return a reference: near for |x| < bound, far elsewhere."""
    return lambda x: np.where(np.abs(x) < bound, near(np.where(np.abs(x) < bound, x, 0)), far(x))


true_phi2 = split_at(0.5, series(WIDE(1) / 2, lambda x, n: x / (n + 3)), lambda x: (np.expm1(x) - x) / x / x)
near_sin3 = series(WIDE(1) / 6, lambda x, n: -x * x / ((2 * n + 4) * (2 * n + 5)))
true_sin3 = split_at(0.5, near_sin3, lambda x: (x - np.sin(x)) / x**3)


def true_sinc(x):
    return np.sin(x) / x


def true_cosinc(x):
    return true_sinc(x / 2) ** 2 / 2


EXP = uniform((-87.3, -708.3), (88.7, 709.7))
SMALL = sizes((-37, -300), 0)
RELATIVE = [
    (sin, np.sin, uniform(-1.5707, 1.5707), 9.5e-8, 1.9e-16),
    (sin, np.sin, SMALL, 9.5e-8, 1.9e-16),
    (exp2, np.exp2, uniform((-126, -1022), (128, 1024)), 8e-8, 1.2e-16),
    (exp2, np.exp2, uniform(-1, 1), 8e-8, 1.2e-16),
    (exp, np.exp, EXP, 9.5e-8, 1.6e-16),
    (exp, np.exp, uniform(-1, 1), 9.5e-8, 1.6e-16),
    (expm1, np.expm1, EXP, 1.3e-7, 2.6e-16),
    (expm1, np.expm1, uniform(-3, 3), 1.3e-7, 2.6e-16),
    (expm1, np.expm1, SMALL, 1.3e-7, 2.6e-16),
    (log2, np.log2, positive(sizes((-44, -320), (38, 308))), 1.2e-7, 1.2e-16),
    (log2, np.log2, uniform(0.5, 2), 1.2e-7, 1.2e-16),
    (log, np.log, positive(sizes((-44, -320), (38, 308))), 1.6e-7, 2.4e-16),
    (log, np.log, uniform(0.99, 1.01), 1.6e-7, 2.4e-16),
    (phi1, lambda x: np.expm1(x) / x, uniform((-87, -708), (93.2, 716.3)), 1.7e-7, 3.3e-16),
    (phi1, lambda x: np.expm1(x) / x, uniform(-3, 3), 1.7e-7, 3.3e-16),
    (phi1, lambda x: np.expm1(x) / x, sizes((-37, -300), (1, 2)), 1.7e-7, 3.3e-16),
    (phi2, true_phi2, uniform((-87, -708), (97.8, 722.9)), 3.1e-7, 5.5e-16),
    (phi2, true_phi2, uniform(-2, 2), 3.1e-7, 5.5e-16),
    (phi2, true_phi2, SMALL, 3.1e-7, 5.5e-16),
    (sinc, true_sinc, uniform(-1.57, 1.57), 1.5e-7, 2.5e-16),
    (sinc, true_sinc, SMALL, 1.5e-7, 2.5e-16),
    (cosinc, true_cosinc, uniform(-3, 3), 2.8e-7, 4.8e-16),
    (cosinc, true_cosinc, SMALL, 2.8e-7, 4.8e-16),
    (sin3, true_sin3, uniform(-4, 4), 2.3e-7, 4.3e-16),
    (sin3, true_sin3, uniform(-1000, 1000), 2.3e-7, 4.3e-16),
    (sin3, true_sin3, SMALL, 2.3e-7, 4.3e-16),
    (acos, np.arccos, uniform(-1, 1), 2.2e-7, 3.6e-16),
    (acos, np.arccos, uniform(0.999, 1), 2.2e-7, 3.6e-16),
]


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("function, reference, sampler, single, double", RELATIVE)
def test_relative_error_is_as_stated(function, reference, sampler, single, double, kind):
    """The greatest relative error over the stated range is below the stated bound."""
    which = SINGLE if kind is np.float32 else DOUBLE
    with np.errstate(all="ignore"):
        x = sampler(np.random.default_rng(1), kind, which)
        got, true = function(x), reference(x.astype(WIDE))
        normal = (np.abs(true) >= np.finfo(kind).tiny) & (np.abs(true) <= np.finfo(kind).max)
        error = np.abs(got - true)[normal] / np.abs(true)[normal]
    assert got.dtype == kind and len(error) > 0.6 * len(x)
    assert error.max() <= (single, double)[which]


@pytest.mark.parametrize("kind, bound, least, most", [(np.float32, 1.4e-7, -37, 37), (np.float64, 2.6e-16, -300, 300)])
def test_relative_error_of_atan2_is_as_stated(kind, bound, least, most):
    """In every direction, for points of any distance."""
    for ends in ((-1, 1), (least, most)):
        draw = np.random.default_rng(2)
        y, x = (sizes(*ends)(draw, kind, 0) for _ in "yx")
        with np.errstate(all="ignore"):
            true = np.arctan2(y.astype(WIDE), x.astype(WIDE))
            error = (np.abs(atan2(y, x) - true) / np.abs(true))[np.abs(true) > np.finfo(kind).tiny]
        assert error.max() <= bound


@pytest.mark.parametrize("kind, span, bound", [(np.float32, 2e5, 7.5e-8), (np.float64, 1e6, 1.3e-16)])
def test_absolute_error_of_sincos_is_as_stated(kind, span, bound):
    """Over the whole range, and at the ends of the quarter turns, where the reduction may choose wrongly."""
    quarters = np.arange(-span, span, np.pi / 2 * (1 if kind is np.float32 else 100))
    anywhere = np.random.default_rng(3).uniform(-span, span, COUNT[kind])
    for x in (anywhere, quarters, quarters + np.pi / 4, np.linspace(-7, 7, 30001)):
        x = x.astype(kind)
        assert np.abs(sin(x) - np.sin(x.astype(WIDE))).max() <= bound
        assert np.abs(cos(x) - np.cos(x.astype(WIDE))).max() <= bound


def power_error(x, y):
    with np.errstate(all="ignore"):
        true = np.power(x.astype(WIDE), y.astype(WIDE))
        got = power(x, y)
    normal = (true >= np.finfo(x.dtype).tiny) & (true <= np.finfo(x.dtype).max)
    return (np.abs(got - true) / true)[normal], (y.astype(WIDE) * np.log2(x.astype(WIDE)))[normal]


@pytest.mark.parametrize("kind, constant, slope", [(np.float32, 1.4e-7, 6e-8), (np.float64, 2e-16, 5e-18)])
@pytest.mark.parametrize("magnitude", [1, 30])
def test_error_of_power_grows_as_stated(kind, constant, slope, magnitude):
    """The relative error is below constant + slope |y log2 x|, up to the ends of the range."""
    draw = np.random.default_rng(4)
    x = positive(sizes(-magnitude, magnitude))(draw, kind, 0)
    reach = (127 if kind is np.float32 else 1000) / np.maximum(np.abs(np.log2(x)), 1e-3)
    y = (draw.uniform(-1, 1, len(x)) * reach * draw.choice([1, 0.1, 0.01], len(x))).astype(kind)
    error, turns = power_error(x, y)
    assert np.all(error <= constant + slope * np.abs(turns))


@pytest.mark.parametrize("y", [0.5, 1, 1.5, 2, 3, -1, -2])
def test_power_of_a_short_exponent_loses_nothing(y):
    """In float32, where y times the exponent is exact, the error does not grow with x."""
    x = positive(sizes(-12, 12))(np.random.default_rng(5), np.float32, 0)
    error, _ = power_error(x, np.full(x.shape, y, np.float32))
    assert error.max() <= 1.4e-7
