"""What a triangle looks like in a pixel: key, opacity and lit colour.

    q_i = b_i / w_i,  S = sum_i q_i,  lambda_i = q_i / S      b: barycentric on the screen; orthographic: w = 1
    d lambda_i / dx = (d q_i / dx - lambda_i dS / dx) / S     gives the slope of the texture's coordinates
    key = k_0 + (g_x (x - x_0) + g_y (y - y_0)), between the corners' keys, in float64; rounded to float32

The key is that at the mean place of the samples that are seen. The look is that at the pixel's centre, also a little
beyond the edge (lambda_i >= -1/4), so that two triangles of one surface look alike where they meet in a pixel; farther
beyond, where small triangles would be seen as they are nowhere, it is that at the mean place too.
See polygons.py for light, textures.py for maps.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from graphfx.lanes.inner import inner
from graphfx.render.coverage import ALL, SAMPLE_X, SAMPLE_Y, SAMPLES
from graphfx.render.textures import sample
from graphfx.render.triangles import GREATEST, LOOK

COLOR_MAP, COLOR_LEVELS, OPACITY_MAP, OPACITY_LEVELS, LIT = 0, 1, 2, 3, 4
"""Places in a look's row: the first level and the number of levels of its maps, 0 where it has none, and whether it is lit."""
BEYOND = -0.25
"""Least weight of a corner at the pixel's centre for which the look is taken there."""
F = np.float32


class Looks(NamedTuple):
    """What all triangles share: a row for each look, the light (see Lighting.rows) and the levels of all textures."""

    rows: np.ndarray
    light: np.ndarray
    levels: np.ndarray
    perspective: bool


class Plane(NamedTuple):
    """How barycentric coordinates and key run over the screen, from corner 0."""

    x: np.float64
    y: np.float64
    b1x: np.float64
    b1y: np.float64
    b2x: np.float64
    b2y: np.float64
    key: np.float64
    kx: np.float64
    ky: np.float64
    nearest: np.float64
    farthest: np.float64


@inner
def twice_area(place):
    """Return twice the area of a triangle on the screen, above 0 where it turns clockwise."""
    return (place[2] - place[0]) * (place[5] - place[1]) - (place[4] - place[0]) * (place[3] - place[1])


@inner
def plane_of(place):
    """Return the plane of a triangle."""
    inverse = 1.0 / twice_area(place)
    x1, y1, x2, y2 = place[2] - place[0], place[3] - place[1], place[4] - place[0], place[5] - place[1]
    b1x, b1y, b2x, b2y = y2 * inverse, -x2 * inverse, -y1 * inverse, x1 * inverse
    k1, k2 = place[7] - place[6], place[8] - place[6]
    return Plane(
        place[0], place[1], b1x, b1y, b2x, b2y, place[6], k1 * b1x + k2 * b2x, k1 * b1y + k2 * b2y,
        min(place[6], min(place[7], place[8])), max(place[6], max(place[7], place[8])),
    )


@inner
def key_at(plane, x, y):
    """Return the key at a point, unbounded."""
    return plane.key + (plane.kx * (x - plane.x) + plane.ky * (y - plane.y))


@inner
def middle(bits):
    """Return the mean place of some samples in their pixel."""
    if bits == ALL:
        return 0.5, 0.5
    x, y, count = 0.0, 0.0, 0
    for i in range(SAMPLES):
        if bits >> i & 1:
            x, y, count = x + SAMPLE_X[i], y + SAMPLE_Y[i], count + 1
    return x / count, y / count


@inner
def _parts(plane, inverses, x, y, least):
    """Return q_i of the corners at a point, b_i being at least `least`."""
    across, down = x - plane.x, y - plane.y
    b1, b2 = across * plane.b1x + down * plane.b1y, across * plane.b2x + down * plane.b2y
    return max(1.0 - b1 - b2, least) * inverses[0], max(b1, least) * inverses[1], max(b2, least) * inverses[2]


@inner
def _seen_from_centre(parts):
    """Return whether the weights that belong to these parts are those of a point that is not too far beyond."""
    total = parts[0] + parts[1] + parts[2]
    return total > 0.0 and min(parts[0], min(parts[1], parts[2])) >= BEYOND * total


@inner
def _weights(place, plane, centre, mean, perspective):
    """Return the corners' weights, at the pixel's centre or at the samples' mean place, and their derivatives along x and y."""
    i0, i1, i2 = 1.0, 1.0, 1.0
    if perspective:
        i0, i1, i2 = -place[6], -place[7], -place[8]
    q = _parts(plane, (i0, i1, i2), centre[0], centre[1], -np.inf)
    if not _seen_from_centre(q):
        q = _parts(plane, (i0, i1, i2), mean[0], mean[1], 0.0)
    total = q[0] + q[1] + q[2]
    if not total > 0.0:
        return (1.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    inverse = 1.0 / total
    w = q[0] * inverse, q[1] * inverse, q[2] * inverse
    d0, d1, d2 = -(plane.b1x + plane.b2x) * i0, plane.b1x * i1, plane.b2x * i2
    s = d0 + d1 + d2
    wx = (d0 - w[0] * s) * inverse, (d1 - w[1] * s) * inverse, (d2 - w[2] * s) * inverse
    d0, d1, d2 = -(plane.b1y + plane.b2y) * i0, plane.b1y * i1, plane.b2y * i2
    s = d0 + d1 + d2
    return w, wx, ((d0 - w[0] * s) * inverse, (d1 - w[1] * s) * inverse, (d2 - w[2] * s) * inverse)


@inner
def _mixed(row, at, step, w):
    return w[0] * row[at] + w[1] * row[at + step] + w[2] * row[at + 2 * step]


@inner
def _light(looks, x, y, z):
    """Return the light that falls on a surface with this normal, of any length."""
    length = math.sqrt(x * x + y * y + z * z)
    inverse = 1.0 / length if length > 0.0 else 0.0
    red, green, blue = looks.light[0, 3], looks.light[0, 4], looks.light[0, 5]
    for i in range(1, looks.light.shape[0]):
        lamp = looks.light[i]
        facing = max((x * lamp[0] + y * lamp[1] + z * lamp[2]) * inverse, 0.0)
        red, green, blue = red + facing * lamp[3], green + facing * lamp[4], blue + facing * lamp[5]
    return red, green, blue


@inner
def _maps(looks, row, places, weights):
    """Return the colour of the maps of a look, and what they leave of its opacity."""
    w, wx, wy = weights
    u, v = _mixed(places, 0, 2, w), _mixed(places, 1, 2, w)
    slope = _mixed(places, 0, 2, wx), _mixed(places, 1, 2, wx), _mixed(places, 0, 2, wy), _mixed(places, 1, 2, wy)
    red, green, blue, opacity = 1.0, 1.0, 1.0, 1.0
    if row[COLOR_LEVELS]:
        found = sample(looks.levels, row[COLOR_MAP], row[COLOR_LEVELS], u, v, slope)
        opacity = found[3]
        inverse = 1.0 / opacity if opacity > 0.0 else 0.0
        red, green, blue = found[0] * inverse, found[1] * inverse, found[2] * inverse
    if row[OPACITY_LEVELS]:
        opacity *= sample(looks.levels, row[OPACITY_MAP], row[OPACITY_LEVELS], u, v, slope)[3]
    return red, green, blue, opacity


@inner
def _bounded(value):
    return F(min(max(value, 0.0), GREATEST))


@inner
def shade(triangles, looks, t, centre, mean, values):
    """Write the opacity, red, green and blue of triangle t to `values`; return its key.

    `centre` is that of the pixel, `mean` the mean place of the samples that are seen.
    """
    place, look, row = triangles.places[t], triangles.looks[t], looks.rows[triangles.look[t]]
    plane = plane_of(place)
    weights = _weights(place, plane, centre, mean, looks.perspective)
    w, _, _ = weights
    red, green, blue = _mixed(look, 3, LOOK, w), _mixed(look, 4, LOOK, w), _mixed(look, 5, LOOK, w)
    opacity = _mixed(look, 6, LOOK, w)
    if row[COLOR_LEVELS] or row[OPACITY_LEVELS]:
        map_red, map_green, map_blue, share = _maps(looks, row, triangles.coordinates[t], weights)
        red, green, blue, opacity = red * map_red, green * map_green, blue * map_blue, opacity * share
    if row[LIT]:
        light = _light(looks, _mixed(look, 0, LOOK, w), _mixed(look, 1, LOOK, w), _mixed(look, 2, LOOK, w))
        red, green, blue = red * light[0], green * light[1], blue * light[2]
    values[0] = F(1.0) if triangles.opaque[t] else F(min(max(opacity, 0.0), 1.0))
    values[1], values[2], values[3] = _bounded(red), _bounded(green), _bounded(blue)
    return F(min(max(key_at(plane, mean[0], mean[1]), plane.nearest), plane.farthest))
