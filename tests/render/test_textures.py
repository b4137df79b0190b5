"""Textures: exact in what is known exactly."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphfx.render.textures import Texture, textured

from .test_polygons import flat, sheet


def map_of(values, **given) -> Texture:
    return textured(np.asarray(values, np.float32), **given)


@pytest.mark.parametrize("shape", [(1, 1), (2, 2), (7, 5), (64, 64), (33, 100), (1, 9)])
def test_all_levels_have_one_mean(shape):
    """Halving keeps the mean, of odd sizes too."""
    texels = np.random.default_rng(1).random((*shape, 3))
    levels = map_of(texels).levels
    assert levels[-1].shape == (1, 1, 4)
    for level in levels:
        np.testing.assert_allclose(level.mean(axis=(0, 1))[:3], texels.mean(axis=(0, 1)), rtol=2e-6)


def test_texel_shows_as_it_is():
    """Where texels are as large as pixels and lie on them, each pixel is a texel; the first row is the highest."""
    texels = np.random.default_rng(2).random((64, 64, 3), np.float32)
    pixels = flat(sheet(width=64, height=64, color_map=map_of(texels)))
    np.testing.assert_allclose(pixels[..., :3], texels, atol=1e-6)


def test_between_texels_it_is_bilinear():
    """Eight pixels to a texel: linear between the centres of texels, and the other side beyond the last."""
    texels = np.random.default_rng(3).random((8, 8, 3))
    pixels = flat(sheet(width=64, height=64, color_map=map_of(texels)))[..., :3]
    at = (np.arange(64) + 0.5) / 8 - 0.5
    first, share = np.floor(at).astype(int) % 8, at - np.floor(at)
    rows = texels[first] * (1 - share)[:, None, None] + texels[(first + 1) % 8] * share[:, None, None]
    expected = rows[:, first] * (1 - share)[None, :, None] + rows[:, (first + 1) % 8] * share[None, :, None]
    np.testing.assert_allclose(pixels, expected, atol=1e-6)


def test_clamped_texture_goes_on_as_at_its_border():
    """From the centres of its outmost texels on it is they, exactly, within the picture and far beyond it."""
    texels = np.random.default_rng(3).random((8, 8, 3), np.float32)
    texture = replace(map_of(texels), clamped=True)
    corners = np.array([[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]], float)
    near = flat(sheet(width=64, height=64, coordinates=corners, color_map=texture))[..., :3]
    for row, column in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
        np.testing.assert_allclose(near[row, column], texels[row, column], atol=1e-7)
    np.testing.assert_allclose(near[0], near[3], atol=1e-7)
    within = flat(sheet(width=64, height=64, coordinates=corners, color_map=map_of(texels)))[..., :3]
    np.testing.assert_array_equal(near[4:60, 4:60], within[4:60, 4:60])
    far = flat(sheet(width=64, height=64, coordinates=corners + np.array([0.0, 50.0]), color_map=texture))[..., :3]
    np.testing.assert_allclose(far, near[:1].repeat(64, axis=0), atol=1e-6)
    far = flat(sheet(width=64, height=64, coordinates=corners - np.array([50.0, 0.0]), color_map=texture))[..., :3]
    np.testing.assert_allclose(far, near[:, :1].repeat(64, axis=1), atol=1e-6)


@pytest.mark.parametrize("times", [1, 2, 4, 32])
def test_checker_seen_from_afar_is_its_mean(times):
    """Where a pixel spans the picture, it shows the mean; where two texels, that of four."""
    checker = (np.indices((64, 64)).sum(axis=0) % 2).astype(float)
    pixels = flat(sheet(width=64 / times, height=64 / times, color_map=map_of(checker[..., None].repeat(3, 2))))
    expected = checker if times == 1 else 0.5
    whole = pixels[32 - 32 // times : 32 + 32 // times, 32 - 32 // times : 32 + 32 // times]
    np.testing.assert_allclose(whole[..., 0], expected, atol=1e-6)


def test_blend_of_two_levels():
    """One texel and a half to a pixel is log2(1.5) of the way to the next level."""
    texels = np.zeros((64, 64, 3))
    texels[:, ::2] = 1.0
    coordinates = np.array([[[0, 0], [1.5, 0], [1.5, 1.5]], [[0, 0], [1.5, 1.5], [0, 1.5]]], float)
    pixels = flat(sheet(width=64, height=64, coordinates=coordinates, color_map=map_of(texels)))[20, :, 0]
    places = (np.arange(64) + 0.5) * 1.5 - 0.5
    share = np.log2(1.5)
    lower = np.abs(np.abs(places % 2 - 1))
    np.testing.assert_allclose(pixels, lower * (1 - share) + 0.5 * share, atol=1e-5)


def test_alpha_of_a_colour_map_is_opacity():
    """It multiplies the polygons' and the opacity map's, and colours do not darken by it."""
    colors = np.zeros((4, 4, 4))
    colors[...] = (0.8, 0.4, 0.2, 0.5)
    scene = sheet(color_map=map_of(colors), opacity=0.5, opacity_map=map_of(np.full((3, 3), 0.6), color=False))
    np.testing.assert_allclose(flat(scene)[32, 32], np.array([0.8, 0.4, 0.2, 1.0]) * 0.15, rtol=1e-6)


def test_colours_beside_holes_are_clean():
    """What a transparent texel would show has no part in the colour beside it, on any level."""
    colors = np.zeros((8, 8, 4))
    colors[:, ::2] = (1, 1, 1, 1)
    colors[:, 1::2] = (1, 0, 0, 0)
    for times in (0.3, 1, 2, 8):
        pixels = flat(sheet(width=64 / times, height=64 / times, color_map=map_of(colors)))
        np.testing.assert_allclose(pixels[..., 1], pixels[..., 3], atol=1e-6)


def test_opaque_map_hides():
    """A colour map whose alpha is 1 throughout leaves polygons opaque: what is behind is not seen at all."""
    colors = np.random.default_rng(4).random((5, 7, 3))
    assert map_of(colors).opaque
    pixels = flat(sheet(color_map=map_of(colors)), sheet(-1, color=(1e6, 0, 0)))
    assert pixels[..., 0].max() <= 1.0 and (pixels[..., 3] == 1.0).all()


@pytest.mark.parametrize("wrong", [np.zeros((4, 4)), np.zeros((0, 4, 4)), np.zeros((2, 2, 3))])
def test_what_is_no_picture_is_refused(wrong):
    """Texels are (height, width, 4)."""
    with pytest.raises(ValueError, match="a texture is"):
        Texture(wrong)
