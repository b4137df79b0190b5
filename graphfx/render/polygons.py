"""What is rendered besides particles: polygons with colours, maps and light.

    colour = color map (ambient + sum_i light_i max(n . l_i, 0))        l_i: from the surface to the light, unit
    colour = color map                                                  unlit

n is turned to the viewer: seen from behind, a surface has its normal the other way round. [Lambert 1760]
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphfx.render.textures import Texture

Vector = Sequence[float] | np.ndarray
SHADINGS = ("flat", "smooth", "unlit")
AMBIENT = (0.15, 0.15, 0.15)
"""Light from all sides, unless it is given."""
SHOULDER = 0.85
"""Strength of the light from over the camera's shoulder, which shines where no light is given."""


@dataclass
class Polygons:
    """Triangles of one look.

    | field | unit | meaning |
    |---|---|---|
    | `vertices` | m | (n, 3) |
    | `triangles` | | (m, 3) numbers of vertices, counter-clockwise seen from outside |
    | `normals` | | (n, 3) of the vertices, for `smooth` |
    | `coordinates` | | (m, 3 corners, 2): places (u, v) in the maps, v upwards |
    | `color` | linear RGB | one (r, g, b), or (n, 3) of the vertices; at least 0 |
    | `opacity` | 0 to 1 | one number, or (n,) of the vertices; exactly 1 hides what is behind |
    | `shading` | | `flat`: one normal for a triangle; `smooth`: normals of the vertices; `unlit`: no light needed |
    | `color_map`, `opacity_map` | | multiply colour and opacity; the alpha of a colour map multiplies opacity too |
    | `double_sided` | | whether triangles are seen from behind |

    Fragments of the same depth are in the order of polygons and of triangles within them, and before those of particles.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    normals: np.ndarray | None = None
    coordinates: np.ndarray | None = None
    color: Vector = (1.0, 1.0, 1.0)
    opacity: float | np.ndarray = 1.0
    shading: str = "flat"
    color_map: Texture | None = None
    opacity_map: Texture | None = None
    double_sided: bool = True

    def __post_init__(self) -> None:
        """Refuse what does not fit together."""
        if self.shading not in SHADINGS:
            raise ValueError(f"shading is {self.shading!r}; it must be one of {', '.join(SHADINGS)}")
        if self.shading == "smooth" and self.normals is None:
            raise ValueError("smooth shading needs the normals of the vertices")
        if self.coordinates is None and (self.color_map is not None or self.opacity_map is not None):
            raise ValueError("a map needs the coordinates of the triangles' corners")

    @property
    def opaque(self) -> bool:
        """Return whether no map lets light through; colour and opacity may yet."""
        return all(texture is None or texture.opaque for texture in (self.color_map, self.opacity_map))


@dataclass(frozen=True)
class Light:
    """Light from far away: `direction` is the way in which it travels, `color` linear RGB with its strength."""

    direction: Vector
    color: Vector = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Lighting:
    """All light of a scene. Without lights one shines from over the camera's left shoulder."""

    lights: Sequence[Light] = ()
    ambient: Vector = AMBIENT

    def rows(self, axes: np.ndarray) -> np.ndarray:
        """Return (1 + lights, 6): ambient colour first, then (unit vector to the light, colour); `axes` are the camera's."""
        right, up, ahead = axes
        lights = self.lights or (Light(ahead + 0.5 * right - 0.7 * up, (SHOULDER,) * 3),)
        rows = np.zeros((1 + len(lights), 6))
        rows[0, 3:] = self.ambient
        for row, light in zip(rows[1:], lights, strict=True):
            direction = np.asarray(light.direction, np.float64)
            size = np.linalg.norm(direction)
            row[:3] = -direction / size if np.isfinite(size) and size > 0.0 else 0.0
            row[3:] = light.color
        return rows
