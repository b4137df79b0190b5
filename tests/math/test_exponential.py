"""Exponentials, logarithms, powers and the phi functions at the ends of their ranges and at exact values."""

import numpy as np
import pytest

from graphfx.math import arithmetic, cosinc, exp, exp2, expm1, log, log2, phi1, phi2, power, sin3, sinc

KINDS = [np.float32, np.float64]
INF, NAN = np.inf, np.nan
FUNCTIONS = [exp2, exp, expm1, log2, log, phi1, phi2, sinc, cosinc, sin3]


def call(function, kind, *arguments):
    with np.errstate(all="ignore"):
        return function(*(kind(x) for x in arguments))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_nan_gives_nan(kind, function):
    """NaN passes through every function, and the precision stays."""
    assert np.isnan(call(function, kind, NAN)) and type(call(function, kind, NAN)) is kind


@pytest.mark.parametrize("kind, least, most", [(np.float32, -126, 128), (np.float64, -1022, 1024)])
def test_exp2_of_whole_numbers_is_exact(kind, least, most):
    """2**n is exact for every n with a normal result, infinite from the top on, 0 below."""
    n = np.arange(least, most)
    assert np.array_equal(exp2(n.astype(kind)), np.ldexp(kind(1), n))
    assert [call(exp2, kind, x) for x in (most, most + 0.5, 1e30, INF)] == [INF] * 4
    assert [call(exp2, kind, x) for x in (least - 0.01, least - 40, -1e30, -INF)] == [0] * 4


@pytest.mark.parametrize("kind, low, high", [(np.float32, -87.3365, 88.7228), (np.float64, -708.396, 709.782)])
def test_exponentials_overflow_and_underflow_at_the_end_of_the_range(kind, low, high):
    """e**x is finite and positive up to both ends of the range; beyond, it is infinite or 0, never stuck at a bound."""
    assert call(exp, kind, high) > np.finfo(kind).max / 1.01 and np.isfinite(call(exp, kind, high))
    assert call(exp, kind, low) < np.finfo(kind).tiny * 1.01 and call(exp, kind, low) > 0
    assert [call(f, kind, x) for f in (exp, expm1) for x in (high + 0.01, 2e4, 3e38, INF)] == [INF] * 8
    assert [call(exp, kind, x) for x in (low - 0.01, -2e4, -3e38, -INF)] == [0] * 4
    assert [call(expm1, kind, x) for x in (-100, -3e38, -INF)] == [-1] * 3


@pytest.mark.parametrize("kind", KINDS)
def test_small_arguments_keep_every_digit(kind):
    """expm1(x) is x for tiny x, denormals and -0 too, and the limits of the phi functions at 0 are reached."""
    for x in (0.0, -0.0, np.finfo(kind).smallest_subnormal, -np.finfo(kind).tiny, 1e-30):
        assert call(expm1, kind, x) == kind(x) and np.signbit(call(expm1, kind, x)) == np.signbit(kind(x))
        limits = [call(f, kind, x) for f in (exp, phi1, phi2, sinc, cosinc, sin3)]
        assert limits == [1, 1, 0.5, 1, 0.5, kind(1 / 6)]


@pytest.mark.parametrize("kind, huge", [(np.float32, 1e36), (np.float64, 1e300)])
def test_phi_functions_of_large_arguments(kind, huge):
    """For very negative x, phi1 and phi2 are -1/x, and 0 at -infinity; at infinity they are infinite."""
    for function in (phi1, phi2):
        assert abs(call(function, kind, -huge) * kind(huge) - 1) <= 2 * np.finfo(kind).eps
        assert call(function, kind, -INF) == 0
        assert [call(function, kind, x) for x in (1e4, huge, INF)] == [INF] * 3


@pytest.mark.parametrize("kind, beyond", [(np.float32, 92.0), (np.float64, 715.0)])
def test_phi_functions_are_finite_where_the_exponential_is_not(kind, beyond):
    """Where e**x overflows but (e**x - 1)/x does not, phi1 has its value."""
    true = np.exp(np.longdouble(beyond) - np.log(np.longdouble(beyond)))
    assert call(exp, kind, beyond) == INF
    assert abs(call(phi1, kind, beyond) / true - 1) < 1e-6 and abs(call(phi2, kind, beyond) * beyond / true - 1) < 1e-6


@pytest.mark.parametrize("function, bound", [(phi1, 1), (phi2, 1), (sin3, 2)])
@pytest.mark.parametrize("kind", KINDS)
def test_no_step_where_formulas_meet(kind, function, bound):
    """The two formulas on either side of a threshold agree there to rounding."""
    for edge in (kind(bound), kind(-bound)):
        values = [function(np.nextafter(edge, kind(0))), function(edge)]
        assert abs(values[1] / values[0] - 1) <= 4 * np.finfo(kind).eps


@pytest.mark.parametrize("kind", KINDS)
def test_logarithms_at_corners(kind):
    """log2 of powers of two is exact, denormal ones too; of 0 it is -infinity; negative numbers have none."""
    least = int(np.log2(np.finfo(kind).smallest_subnormal))
    n = np.arange(least, -least - 30)
    n = n[n < np.finfo(kind).maxexp]
    with np.errstate(all="ignore"):
        assert np.array_equal(log2(np.ldexp(kind(1), n)), n)
    for function in (log2, log):
        assert [call(function, kind, x) for x in (0.0, -0.0, 1, INF)] == [-INF, -INF, 0, INF]
        assert all(np.isnan(call(function, kind, x)) for x in (-1e-30, -1, -INF))


POWERS = [
    (0, 2, 0), (-0.0, 2, 0), (0, -2, INF), (0, 0, 1), (5, 0, 1), (1, 1e30, 1), (1, -3, 1), (INF, 2, INF), (INF, -2, 0),
    (INF, 0, 1), (-1, 2, NAN), (-1, 0.5, NAN), (-INF, 1, NAN), (NAN, 1, NAN), (2, NAN, NAN), (0, NAN, NAN), (2, INF, NAN),
    (2, 10, 1024),
    (4, 0.5, 2), (4, -1.5, 0.125), (1e30, 1e30, INF), (1e30, -1e30, 0), (1.2, 1e30, INF), (0.8, 1e30, 0), (2, 2e4, INF),
    (2, -2e4, 0), (1e-320, 1, 0), (1e-320, -1, INF), (1e-320, 0, 1),
]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("x, y, result", POWERS)
def test_power_at_corners(kind, x, y, result):
    """0, infinity, denormals, negative numbers, NaN and overflow give what the documentation says."""
    assert np.array_equal(call(power, kind, x, y), kind(result), equal_nan=True)


@pytest.mark.parametrize("kind", KINDS)
def test_power_one_is_the_number(kind):
    """power(x, 1) is x to rounding over the whole range of normal numbers."""
    x = (10.0 ** np.random.default_rng(1).uniform(-37, 38, 10_000)).astype(kind)
    assert np.abs(power(x, kind(1)) / x - 1).max() <= 1.2 * np.finfo(kind).eps


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_arrays_give_what_scalars_give(kind, function):
    """One number at a time, the bits are those of many at once."""
    x = np.abs(np.random.default_rng(2).normal(size=100).astype(kind) * kind(3))
    assert [function(v) for v in x] == list(function(x))
    assert [power(v, kind(1.7)) for v in x] == list(power(x, kind(1.7)))


@pytest.mark.parametrize("kind", KINDS)
def test_powers_of_negative_numbers(kind):
    """In expressions a negative number has whole powers, with its sign where they are odd, and no others."""
    for base in (-3.0, -0.5, 2.0):
        for exponent in range(-4, 5):
            assert call(arithmetic.power, kind, base, exponent) == pytest.approx(base**exponent, rel=1e-6)
    assert np.isnan(call(arithmetic.power, kind, -2, 0.5)) and np.isnan(call(arithmetic.power, kind, NAN, 2))
