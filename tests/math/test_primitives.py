"""The primitives: precision, IEEE cases, and the definitions that the block machine must match."""

import warnings

import numpy as np
import pytest

from graphfx.math import (
    Vec3,
    absolute,
    by_precision,
    copysign,
    floor,
    maximum,
    minimum,
    scale2,
    split2,
    sqrt,
    where,
)

KINDS = [np.float32, np.float64]
ODD_VALUES = [0.0, -0.0, 1.5, -1.5, np.inf, -np.inf, np.nan, 1e-40, 1e30]


@pytest.mark.parametrize("kind", KINDS)
def test_results_keep_the_precision(kind):
    """Every primitive gives the precision of its lane arguments, literals beside them or not."""
    x = kind(1.25)
    results = [where(x > 0, x, 0.0), where(x < 0, x, 0.0), floor(x), sqrt(x), minimum(x, 2.0), maximum(x, 2.0), maximum(2.0, x),
               absolute(x), copysign(x, -1.0), copysign(1.0, x), scale2(x, kind(3)), scale2(1.0, kind(3)), *split2(x)]
    assert {type(result) for result in results} == {kind}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("x", ODD_VALUES)
def test_floor_and_sqrt_are_quiet(kind, x):
    """floor and sqrt answer NaN, infinities and negative numbers as IEEE does, without a warning."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        value = kind(x)
        root, whole = sqrt(value), floor(value)
        assert np.array_equal(sqrt(np.array([value])), [root], equal_nan=True)
    assert np.array_equal(whole, np.floor(value), equal_nan=True)
    if x < 0 or np.isnan(x):
        assert np.isnan(root)
    else:
        assert root == kind(np.sqrt(value)) and np.signbit(root) == np.signbit(x)


def test_single_square_root_is_correctly_rounded():
    """The float32 root from a double is the one that the processor's float32 instruction gives."""
    values = np.random.default_rng(1).integers(0, 0x7F800000, 5000, dtype=np.uint32).view(np.float32)
    assert np.array_equal([sqrt(x) for x in values], np.sqrt(values))


@pytest.mark.parametrize("a", ODD_VALUES)
@pytest.mark.parametrize("b", ODD_VALUES)
def test_minimum_and_maximum_choose_by_one_comparison(a, b):
    """minimum is `a if a < b else b`, maximum `a if a > b else b`: the second where either is NaN."""
    a, b = np.float32(a), np.float32(b)
    for function, expected in ((minimum, a if a < b else b), (maximum, a if a > b else b)):
        got = function(a, b)
        assert got.view(np.uint32) == expected.view(np.uint32)
        assert function(np.array([a]), np.array([b])).view(np.uint32)[0] == expected.view(np.uint32)


def test_where_refuses_what_is_no_comparison():
    """`~` of a Python bool is -2, which would count as true: where refuses whole numbers."""
    with pytest.raises(TypeError) as raised:
        where(-2, np.float32(1), np.float32(2))
    wanted = "where takes a comparison, or comparisons joined by & | ~, of lane values; not -2 of type int"
    assert str(raised.value) == wanted


def test_where_keeps_literals_weak():
    """A choice between two literals is still a literal."""
    assert type(np.float32(1) * where(True, 2.0, 3.0)) is np.float32


@pytest.mark.parametrize("kind, least, most", [(np.float32, -127, 128), (np.float64, -1023, 1024)])
def test_scale2_multiplies_by_a_power_of_two(kind, least, most):
    """scale2 is exact inside the range, 0 at its lower end and infinite at its upper end, as its bits say."""
    exponents = np.arange(least, most + 1).astype(kind)
    shift, bits = (23, np.uint32) if kind is np.float32 else (52, np.uint64)
    factors = ((exponents.astype(np.int64) - least).astype(bits) << bits(shift)).view(kind)
    assert np.array_equal(scale2(np.full(exponents.shape, 1.5, kind), exponents), 1.5 * factors)
    assert np.array_equal([scale2(kind(1.5), k) for k in exponents], 1.5 * factors)


@pytest.mark.parametrize("kind", KINDS)
def test_split2_takes_a_number_apart(kind):
    """x is m * 2**e exactly, with m from sqrt(1/2) to sqrt(2), for positive normal x."""
    bits = np.random.default_rng(2).integers(0, 2**64, 20000, dtype=np.uint64).view(kind)
    x = np.abs(bits[np.isfinite(bits) & (np.abs(bits) >= np.finfo(kind).tiny)])
    m, e = split2(x)
    assert np.array_equal(np.ldexp(m.astype(np.longdouble), e.astype(int)), x.astype(np.longdouble))
    assert m.min() >= 0.70710675 and m.max() < 1.4142136
    assert [split2(v) for v in x[:100]] == list(zip(m[:100], e[:100], strict=True))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("x", [0.0, -0.0, -3.0, np.inf, -np.inf, np.nan, 1e-42])
def test_split2_of_other_numbers_stays_in_bounds(kind, x):
    """Of zeros, negative numbers, infinities and NaN, m and e are finite and m is in its range."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        m, e = split2(kind(x))
    assert 0.70710675 <= m < 1.4142136 and abs(e) <= 2048


def test_by_precision_chooses_by_the_first_argument():
    """float32 runs the one, float64 and Python floats the other; the name and the documentation are the first's."""

    def half_single(x):
        """Half of x."""
        return "single"

    half = by_precision(half_single, lambda x: "double")
    single = [np.float32(1), np.ones(2, np.float32), Vec3(np.float32(1), 0.0, 0.0)]
    assert [half(x) for x in single] == ["single"] * 3
    assert [half(x) for x in (np.float64(1), 1.0)] == ["double"] * 2
    assert (half.__name__, half.__doc__, half.single) == ("half", "Half of x.", half_single)
