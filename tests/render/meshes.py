"""Random polygons for the renderer's tests, and how a render with them is held against the reference."""

from __future__ import annotations

import numpy as np

from graphfx.render import Light, Lighting, Polygons, Texture
from graphfx.render.camera import Camera
from graphfx.render.renderer import render

from .reference import reference

CAMERA = Camera(position=(0.3, 0.2, 6.0), target=(0.1, 0.0, 0.0), lens=40.0)
FLAT = Camera(position=(0.0, 0.0, 6.0), projection="orthographic", view_width=5.0, near=-10.0)
SIZE = (29, 35)
"""Not multiples of a tile."""
LIGHTING = Lighting((Light((0.3, -1.0, -0.5), (0.9, 0.8, 0.7)), Light((-1.0, 0.2, -0.4), (0.1, 0.2, 0.3))), (0.05, 0.06, 0.07))


def picture(seed: int, height: int = 11, width: int = 14, opaque: bool = False) -> Texture:
    """Return a random texture, its alpha from 0.3 to 1, or 1."""
    draw = np.random.default_rng(seed)
    texels = draw.random((height, width, 4), np.float32)
    texels[..., 3] = 1.0 if opaque else 0.3 + 0.7 * texels[..., 3]
    texels[..., :3] *= texels[..., 3:]
    return Texture(texels)


def triangles(seed: int, count: int = 20, size: float = 1.0, spread: float = 2.0, **look) -> Polygons:
    """Return loose triangles about the origin, with normals and coordinates."""
    draw = np.random.default_rng(seed)
    middle = draw.uniform(-spread, spread, (count, 1, 3))
    given = {
        "vertices": (middle + draw.normal(0, size, (count, 3, 3))).reshape(-1, 3),
        "triangles": np.arange(3 * count).reshape(-1, 3),
        "normals": draw.normal(0, 1, (3 * count, 3)),
        "coordinates": draw.uniform(-1, 2, (count, 3, 2)),
        "color": draw.random((3 * count, 3)),
    }
    return Polygons(**(given | look))


def film(polygons, *streams, camera=CAMERA, size=SIZE, threads=1, lighting=LIGHTING):
    """Render."""
    return render(list(streams), camera, None, *size, threads, polygons=polygons, lighting=lighting)


def hold(polygons, *streams, camera=CAMERA, size=SIZE, lighting=LIGHTING, tolerance=1e-5):
    """Assert that a render equals the reference; return it."""
    got = film(polygons, *streams, camera=camera, size=size, lighting=lighting)
    pixels, _, dropped = reference(streams, camera, None, *size, polygons, lighting)
    np.testing.assert_allclose(got.pixels, pixels, rtol=0, atol=tolerance)
    assert got.dropped == dropped
    return got
