"""The meaning of polygons, by brute force: every triangle against every sample, in float64.

What a point of a triangle has is found in space, where the ray through the point of the screen meets the whole triangle.
Only coverage and keys follow the documented float formulas (coverage.py, resolve.py, shading.py): a rounding
there moves a sample from one triangle to another.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

F = np.float32
OFFSETS = np.array([((i + 0.5) / 16, (int(f"{i:04b}"[::-1], 2) + 0.5) / 16) for i in range(16)])


@dataclass
class Fragment:
    """What one triangle gives one pixel: key, rank, which of the samples, opacity, colour."""

    key: F
    rank: int
    samples: np.ndarray
    opacity: float
    color: np.ndarray


@dataclass
class Piece:
    """A triangle on the screen: corners (3, 2), keys, and the triangle in space that it is a part of."""

    corners: np.ndarray
    keys: np.ndarray
    whole: np.ndarray
    polygons: Any
    number: int
    perspective: bool

    @property
    def turn(self) -> float:
        (x1, y1), (x2, y2) = self.corners[1] - self.corners[0], self.corners[2] - self.corners[0]
        return x1 * y2 - x2 * y1

    def covers(self, x, y):
        """Return (h, w, 16): whether samples of the pixels with corners (x, y) are inside."""
        inside = np.ones((*x.shape, 16), bool)
        for k in range(3):
            ends = [tuple(self.corners[k]), tuple(self.corners[(k + 1) % 3])]
            (ax, ay), (bx, by) = sorted(ends)
            dx, dy = bx - ax, by - ay
            value = (dx * (y - ay) - dy * (x - ax))[..., None] + (dx * OFFSETS[:, 1] - dy * OFFSETS[:, 0])
            inside &= (value >= 0) == ((self.turn > 0) == (ends == sorted(ends)))
        return inside

    def gradient(self):
        (x1, y1), (x2, y2) = self.corners[1] - self.corners[0], self.corners[2] - self.corners[0]
        inverse = 1 / self.turn
        k1, k2 = self.keys[1:] - self.keys[0]
        return k1 * (y2 * inverse) + k2 * (-y1 * inverse), k1 * (-x2 * inverse) + k2 * (x1 * inverse)

    def key(self, x, y):
        gx, gy = self.gradient()
        return self.keys[0] + (gx * (x - self.corners[0, 0]) + gy * (y - self.corners[0, 1]))

    def point_of_look(self, x, y, px, py):
        """Return the pixel's centre (x, y), or the samples' mean place where that is too far beyond the triangle."""
        inverse = -self.keys if self.perspective else np.ones(3)
        parts = np.linalg.solve(np.vstack([self.corners.T, np.ones(3)]), [x, y, 1.0]) * inverse
        return (x, y) if parts.sum() > 0 and parts.min() >= -0.25 * parts.sum() else (px, py)

    def sample_keys(self, x, y):
        gx, gy = self.gradient()
        slopes = F(gx * OFFSETS[:, 0] + gy * OFFSETS[:, 1])
        keys = F(self.key(x, y))[..., None] + slopes
        return np.clip(keys, F(self.keys.min()), F(self.keys.max()))


def cut(corners, plane, sign):
    """Return what has sign (w - plane) >= 0 of a polygon of points (x, y, w), from its first kept corner on."""
    kept = []
    for i, here in enumerate(corners):
        there = corners[(i + 1) % len(corners)]
        inside, next_inside = sign * (here[2] - plane) >= 0, sign * (there[2] - plane) >= 0
        if inside:
            kept.append(here)
        if inside != next_inside:
            a, b = (here, there) if inside else (there, here)
            point = a + (plane - a[2]) / (b[2] - a[2]) * (b - a)
            point[2] = plane
            kept.append(point)
    return kept


def pieces_of(polygons, camera, width, height):
    """Return the pieces on the screen of all triangles, and how many triangles were dropped."""
    found, dropped = [], 0
    right, up, ahead = camera.axes()
    scale = camera.scale(width)
    for number, triangle in enumerate(polygons.triangles):
        vertices = np.asarray(polygons.vertices, float)[triangle]
        if not np.isfinite(vertices).all():
            dropped += 1
            continue
        offset = vertices - camera.position
        whole = np.stack([scale * (offset @ right), -scale * (offset @ up), offset @ ahead], axis=1)
        corners = list(whole)
        if whole[:, 2].min() < camera.near:
            corners = cut(corners, camera.near, 1) if whole[:, 2].max() >= camera.near else []
        if corners and max(corner[2] for corner in corners) > camera.far:
            corners = cut(corners, camera.far, -1)
        centre = np.array([width / 2, height / 2])
        screen = [corner[:2] / (corner[2] if camera.perspective else 1.0) + centre for corner in corners]
        keys = [-1 / corner[2] if camera.perspective else corner[2] for corner in corners]
        for j in range(1, len(corners) - 1):
            at = [0, j, j + 1]
            piece = Piece(np.array([screen[k] for k in at]), np.array([keys[k] for k in at]), whole, polygons, number,
                          camera.perspective)
            if piece.turn != 0 and (polygons.double_sided or piece.turn < 0):
                found.append(piece)
    return found, dropped


def solved(piece, x, y, camera, width, height):
    """Return how much of each corner of the whole triangle makes the ray through (x, y), at depth 1 in perspective."""
    x, y = x - width / 2, y - height / 2
    rows = piece.whole.T if camera.perspective else np.vstack([piece.whole[:, :2].T, np.ones(3)])
    return np.linalg.solve(rows, np.array([x, y, 1.0]))


def weights_at(piece, x, y, camera, width, height):
    """Return the weights of the whole triangle's corners where the ray through (x, y) meets it."""
    found = solved(piece, x, y, camera, width, height)
    return found / found.sum()


def texel(level, u, v):
    """Return a level of a texture at (u, v) by bilinear interpolation."""
    height, width = level.shape[:2]
    x, y = u % 1 * width - 0.5, v % 1 * height - 0.5
    i, j = int(np.floor(x)), int(np.floor(y))
    s, t = x - i, y - j
    rows = [level[(j + b) % height].astype(float) for b in (0, 1)]
    low, high = (row[i % width] * (1 - s) + row[(i + 1) % width] * s for row in rows)
    return low * (1 - t) + high * t


def textured(texture, coordinates, across, down):
    """Return a texture where its coordinates are these, and change so from pixel to pixel."""
    size = np.array(texture.levels[0].shape[1::-1])
    spans = max(np.linalg.norm(across * size), np.linalg.norm(down * size))
    level = np.clip(np.log2(max(spans, 1e-300)), 0, len(texture.levels) - 1)
    near, far = int(np.floor(level)), int(np.ceil(level))
    share = level - near
    return texel(texture.levels[near], *coordinates) * (1 - share) + texel(texture.levels[far], *coordinates) * share


def light_rows(lighting, camera):
    right, up, ahead = camera.axes()
    if not lighting.lights:
        return [(ahead + 0.5 * right - 0.7 * up, np.full(3, 0.85))]
    return [(np.asarray(light.direction, float), np.asarray(light.color, float)) for light in lighting.lights]


def look_at(piece, x, y, camera, lighting, width, height):
    """Return (opacity, colour) of a piece at a point of the screen."""
    polygons, triangle = piece.polygons, piece.polygons.triangles[piece.number]
    w = weights_at(piece, x, y, camera, width, height)
    color = w @ np.broadcast_to(polygons.color, (len(polygons.vertices), 3))[triangle]
    opacity = w @ np.clip(np.broadcast_to(polygons.opacity, len(polygons.vertices))[triangle], 0, 1)
    if polygons.color_map is not None or polygons.opacity_map is not None:
        step = 1e-4
        at = [weights_at(piece, x + dx, y + dy, camera, width, height) @ polygons.coordinates[piece.number]
              for dx, dy in ((0, 0), (step, 0), (-step, 0), (0, step), (0, -step))]
        place = at[0], (at[1] - at[2]) / (2 * step), (at[3] - at[4]) / (2 * step)
        if polygons.color_map is not None:
            found = textured(polygons.color_map, *place)
            color, opacity = color * found[:3] / max(found[3], 1e-300), opacity * found[3]
        if polygons.opacity_map is not None:
            opacity = opacity * textured(polygons.opacity_map, *place)[3]
    if polygons.shading != "unlit":
        a, b, c = np.asarray(polygons.vertices, float)[triangle]
        face = np.cross(b - a, c - a)
        normal = face if polygons.shading == "flat" else w @ np.asarray(polygons.normals, float)[triangle]
        facing = np.sign(-piece.turn)
        normal = facing * normal / max(np.linalg.norm(normal), 1e-300)
        light = np.array(lighting.ambient, float)
        for direction, strength in light_rows(lighting, camera):
            light += strength * max(-(normal @ direction) / np.linalg.norm(direction), 0)
        color = color * light
    return np.clip(opacity, 0, 1), np.maximum(color, 0)


def fragments_of(given, lighting, camera, width, height):
    """Return a list of fragments for each pixel (height, width), nearest first, and how many triangles were dropped."""
    pieces, dropped = [], 0
    for polygons in given:
        found, lost = pieces_of(polygons, camera, width, height)
        pieces, dropped = pieces + found, dropped + lost
    x, y = np.meshgrid(np.arange(width, dtype=float), np.arange(height, dtype=float))
    covered = [piece.covers(x, y) for piece in pieces]
    depths, owners = np.full((height, width, 16), np.inf, F), np.full((height, width, 16), len(pieces))
    solid = [piece.polygons.opaque and (np.broadcast_to(piece.polygons.opacity, len(piece.polygons.vertices))
                                        [piece.polygons.triangles[piece.number]] >= 1).all() for piece in pieces]
    for rank, piece in enumerate(pieces):
        if solid[rank]:
            keys = piece.sample_keys(x, y)
            nearer = covered[rank] & (keys < depths)
            depths[nearer], owners[nearer] = keys[nearer], rank
    pixels = [[[] for _ in range(width)] for _ in range(height)]
    for rank, piece in enumerate(pieces):
        keys = piece.sample_keys(x, y)
        seen = owners == rank if solid[rank] else covered[rank] & ((keys < depths) | ((keys == depths) & (rank < owners)))
        for row, column in zip(*np.nonzero(seen.any(axis=2)), strict=True):
            samples = seen[row, column]
            px, py = np.array([column, row]) + OFFSETS[samples].mean(axis=0)
            key = F(np.clip(piece.key(px, py), piece.keys.min(), piece.keys.max()))
            px, py = piece.point_of_look(column + 0.5, row + 0.5, px, py)
            look = look_at(piece, px, py, camera, lighting, width, height)
            pixels[row][column].append(Fragment(key, rank, samples, *look))
    for row in pixels:
        for fragments in row:
            fragments.sort(key=lambda fragment: (fragment.key, fragment.rank))
    return pixels, dropped


def composite(fragments, keys, opacities, colors, adds):
    """Return the (4,) pixel of a polygons' fragments and particles', both in order; a polygon goes first at equal keys."""
    pixel, particles, samples = np.zeros(4), 1.0, np.ones(16)
    waiting = list(fragments)
    for key, opacity, color, add in zip([*keys, np.inf], [*opacities, 0], [*colors, np.zeros(3)], [*adds, False], strict=True):
        while waiting and waiting[0].key <= key:
            fragment = waiting.pop(0)
            weight = particles * fragment.opacity * (samples * fragment.samples).mean()
            pixel[:3] += weight * fragment.color
            samples = samples * (1 - fragment.opacity * fragment.samples)
        pixel[:3] += particles * samples.mean() * opacity * color
        particles *= 1 - (0 if add else opacity)
    pixel[3] = 1 - particles * samples.mean()
    return pixel
