"""Light becomes numbers as the display transforms say, rounded to the nearest."""

from __future__ import annotations

from decimal import Decimal, getcontext

import numpy as np
import pytest

from graphfx.output.display import BAND, DISPLAYS, displayed, filmic, over, shown, srgb, straight

HALF = np.array([[[0.25, 0.125, 0.0, 0.5]]], np.float32)
"""One pixel, half covered by (0.5, 0.25, 0)."""
BLACK = (0.0, 0.0, 0.0)


def greys(light) -> np.ndarray:
    """Return a row of opaque pixels of these greys."""
    light = np.asarray(light, np.float32)
    return np.stack([light, light, light, np.ones_like(light)], axis=-1)[None]


def test_srgb_of_known_values():
    """0, 1 and middle grey are where IEC 61966-2-1 has them; the curve has no step and never falls."""
    np.testing.assert_allclose(srgb(np.array([-1, 0, 0.214041, 1, 7.0])), [0, 0, 0.5, 1, 1], atol=1e-6)
    curve = srgb(np.linspace(0, 1, 100001))
    assert (np.diff(curve) > 0).all() and np.diff(curve).max() < 2e-4


def test_background_shows_through():
    """Film + (1 - alpha) background, linear; of a picture, each pixel's own."""
    np.testing.assert_allclose(over(HALF, (1, 1, 0.5)), [[[0.75, 0.625, 0.25]]])
    picture = np.array([[[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]], np.float32)
    np.testing.assert_allclose(over(np.repeat(HALF, 2, axis=1), picture), HALF[..., :3] + 0.5 * picture)


def test_transparent_colours_are_divided_by_alpha():
    """Premultiplied (0.25, 0.125, 0, 0.5) is (0.5, 0.25, 0) at alpha 0.5; nothing is nothing."""
    np.testing.assert_allclose(straight(HALF), [[[0.5, 0.25, 0.0, 0.5]]])
    assert not straight(np.zeros((1, 1, 4), np.float32)).any()


def test_flames_keep_their_light_over_black():
    """Light without alpha gets the alpha to show: colour times alpha is the light."""
    flame = np.array([[[0.3, 0.2, 0.1, 0.0], [3.0, 2.0, 0.1, 0.0]]], np.float32)
    picture = straight(flame)
    np.testing.assert_allclose(picture[..., :3] * picture[..., 3:], flame[..., :3], rtol=1e-6)
    assert list(picture[0, :, 3]) == [np.float32(0.3), 1.0]


@pytest.mark.parametrize(("bits", "most"), [(8, 255), (16, 65535)])
def test_alpha_is_rounded_to_the_nearest(bits, most):
    """Alpha of k / most is the number k, for every k."""
    film = np.zeros((1, most + 1, 4), np.float32)
    film[0, :, 3] = np.arange(most + 1) / most
    assert (displayed(film, None, "srgb", bits)[0, :, 3] == np.arange(most + 1)).all()


def exact_srgb(value: float) -> Decimal:
    getcontext().prec = 40
    c = Decimal(float(np.float32(value)))
    return c * Decimal("12.92") if c <= Decimal("0.0031308") else Decimal("1.055") * c ** (1 / Decimal("2.4")) - Decimal("0.055")


def test_sixteen_bits_are_the_nearest():
    """Of 3000 lights every number is the one nearest to 65535 sRGB(light), as decimals of 40 digits have it."""
    light = np.concatenate([np.random.default_rng(1).random(2000) ** 3, np.linspace(0, 0.004, 1000)]).astype(np.float32)
    got = displayed(greys(light), BLACK, "srgb", 16)[0, :, 1]
    assert all(abs(exact_srgb(c) * 65535 - int(n)) <= Decimal("0.5000001") for c, n in zip(light, got, strict=True))


def test_bytes_are_the_nearest():
    """To a thirtieth of a level."""
    light = np.random.default_rng(2).random(3000).astype(np.float32) ** 3
    got = displayed(greys(light), BLACK)[0, :, 1]
    assert all(abs(exact_srgb(c) * 255 - int(n)) <= Decimal("0.53") for c, n in zip(light, got, strict=True))


@pytest.mark.parametrize(("bits", "most"), [(8, 255), (16, 65535)])
def test_raw_is_light_itself(bits, most):
    """k / most is k; what is beyond 1 is white, what is below 0 black."""
    light = np.concatenate([np.arange(most + 1) / most, [7.0, 1e30, -0.5]])
    got = displayed(greys(light), BLACK, "raw", bits)[0, :, 0]
    assert list(got[:-3]) == list(range(most + 1)) and list(got[-3:]) == [most, most, 0]


def test_filmic_keeps_middle_grey_and_rolls_off():
    """0.18 stays, black is black, the curve never falls and has its end at 10."""
    np.testing.assert_allclose(filmic(np.array([0.0, 0.18, 10.0, 1e30])), [0.0, 0.18, 1.0, 1.0], atol=1e-4)
    curve = filmic(np.geomspace(1e-6, 9.9, 10001))
    assert (np.diff(curve) > 0).all() and curve[-1] < 1.0
    assert filmic(np.array([1.0]))[0] < 0.75 and filmic(np.array([4.0]))[0] > 0.9


def test_filmic_is_narkowicz_curve():
    """x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) at known places, x the light times 0.7231708."""
    light = np.array([0.05, 0.5, 2.0])
    x = 0.7231708 * light
    np.testing.assert_allclose(filmic(light), x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), rtol=1e-6)


def test_filmic_tells_lights_beyond_one_apart():
    """What sRGB shows as one yellow turns to white through its hues."""
    sparks = np.array([[[2.0, 0.7, 0.1, 1.0], [8.0, 2.8, 0.4, 1.0]]], np.float32)
    clipped, rolled = displayed(sparks, BLACK, "srgb"), displayed(sparks, BLACK, "filmic")
    assert clipped[0, 0, 0] == clipped[0, 1, 0] == 255
    assert rolled[0, 0, 0] < rolled[0, 1, 0] and rolled[0, 0, 1] < rolled[0, 1, 1] < 255


@pytest.mark.parametrize("display", DISPLAYS)
@pytest.mark.parametrize("background", [None, (0.1, 0.2, 0.3), "picture"])
@pytest.mark.parametrize("bits", [8, 16])
def test_threads_and_bands_change_nothing(display, background, bits):
    """Any number of threads gives the numbers that a row alone has."""
    draw = np.random.default_rng(3)
    film = draw.normal(0.4, 0.7, (3 * BAND + 5, 6, 4)).astype(np.float32)
    film[..., 3] = draw.random(film.shape[:2])
    behind = draw.random((*film.shape[:2], 3)).astype(np.float32) if background == "picture" else background
    one, four = (displayed(film, behind, display, bits, threads) for threads in (1, 4))
    np.testing.assert_array_equal(one, four)
    row = BAND + 3
    alone = displayed(film[row : row + 1], behind[row : row + 1] if background == "picture" else behind, display, bits)
    np.testing.assert_array_equal(one[row], alone[0])


@pytest.mark.parametrize("display", DISPLAYS)
def test_transparent_pictures_agree_with_opaque_ones(display):
    """Where alpha is 1, they show the same colour."""
    film = greys(np.linspace(0, 20, 50)).astype(np.float32)
    np.testing.assert_allclose(shown(film, None, display)[..., :3], shown(film, BLACK, display), rtol=1e-6)


@pytest.mark.parametrize("background", [None, (0.1, 0.2, 0.3)])
def test_scale_is_of_the_films_light(background):
    """It multiplies the particles' light, and neither their alpha nor the background; the film is left as it is."""
    film = np.random.default_rng(4).random((5, 6, 4), np.float32)
    before, brighter = film.copy(), film * np.array([2, 2, 2, 1], np.float32)
    np.testing.assert_array_equal(displayed(film, background, scale=2.0), displayed(brighter, background))
    np.testing.assert_array_equal(film, before)
