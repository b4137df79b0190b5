"""From a signed distance to a mesh file: marching cubes on a fine grid, decimation, and a step back onto the surface.

Needs scikit-image and fast-simplification; graphfx itself needs neither.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

Field = Callable[[np.ndarray], np.ndarray]
COARSE = 4


def sampled(field: Field, low: np.ndarray, cells: np.ndarray, step: float) -> np.ndarray:
    """Return the field at the nodes of a grid (cells + 1, each a multiple of COARSE), exact only where the surface is near."""
    coarse = _nodes(low, cells // COARSE + 1, step * COARSE)
    rough = field(coarse.reshape(-1, 3)).reshape(coarse.shape[:3])
    whole = rough
    for axis in range(3):
        whole = np.repeat(whole, COARSE, axis=axis)
    half = COARSE // 2
    whole = whole[half : half + cells[0] + 1, half : half + cells[1] + 1, half : half + cells[2] + 1].copy()
    close = np.argwhere(np.abs(whole) < 2.5 * COARSE * step)
    for part in np.array_split(close, len(close) // 400_000 + 1):
        whole[tuple(part.T)] = field((low + part * step).astype(np.float32))
    return whole


def _nodes(low: np.ndarray, counts: np.ndarray, step: float) -> np.ndarray:
    lines = [low[axis] + step * np.arange(counts[axis]) for axis in range(3)]
    return np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).astype(np.float32)


def triangulated(field: Field, low: np.ndarray, high: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices (n, 3) [m] and triangles (m, 3) of the field's surface, of the size of the step."""
    from skimage.measure import marching_cubes

    low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
    cells = (np.ceil((high - low) / (COARSE * step)) * COARSE).astype(int)
    values = sampled(field, low, cells, step)
    values = np.copysign(np.maximum(np.abs(values), 0.02 * step), values)  # two vertices never at one node
    vertices, triangles, _, _ = marching_cubes(values, 0.0)
    return low + vertices * step, triangles


def decimated(vertices: np.ndarray, triangles: np.ndarray, count: int, focus: Focus) -> tuple[np.ndarray, np.ndarray]:
    """Return the mesh with about so many triangles, smaller where it is bent, and about the focus; closed."""
    from fast_simplification import simplify

    large = focus.magnified(vertices).astype(np.float32)
    for haste in (4, 5, 3, 6, 7):
        points, faces = simplify(large, triangles.astype(np.int32), target_count=count, agg=haste)
        if len(faces) < 1.05 * count and is_closed(faces):
            return focus.restored(points.astype(float)), faces
    raise ValueError(f"brought down to {count} triangles, the surface is not closed; take more, or a smaller step")


def is_closed(triangles: np.ndarray) -> bool:
    """Return whether each edge is met by two triangles, once in each direction."""
    edges = np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    there = np.unique(edges, axis=0)
    return len(there) == len(edges) and np.array_equal(there, np.unique(edges[:, ::-1], axis=0))


@dataclass(frozen=True)
class Focus:
    """A place [m] that is to be finer: as it is decimated, it is magnified: r' = r (1 + gain exp(-(r / size)^2)), gain < 2."""

    center: tuple[float, float, float]
    size: float
    gain: float

    def magnified(self, points: np.ndarray) -> np.ndarray:
        """Return the points with the focus magnified."""
        r = np.linalg.norm(points - self.center, axis=1)[:, None]
        return self.center + (points - self.center) * (1 + self.gain * np.exp(-((r / self.size) ** 2)))

    def restored(self, points: np.ndarray) -> np.ndarray:
        """Return where the points were before."""
        table = np.linspace(0, 20 * self.size, 20001)
        far = table * (1 + self.gain * np.exp(-((table / self.size) ** 2)))
        r = np.linalg.norm(points - self.center, axis=1)[:, None]
        return self.center + (points - self.center) * (np.interp(r, far, table) / np.maximum(r, 1e-9))


def settled(field: Field, vertices: np.ndarray, steps: int = 3) -> np.ndarray:
    """Return the vertices moved onto the surface: p - f(p) g / |g|^2 with the gradient g, again and again."""
    offset = 1e-3
    for _ in range(steps):
        here = field(vertices.astype(np.float32)).astype(float)
        ahead = [field((vertices + offset * axis).astype(np.float32)) for axis in np.eye(3)]
        behind = [field((vertices - offset * axis).astype(np.float32)) for axis in np.eye(3)]
        slope = (np.stack(ahead, axis=1) - np.stack(behind, axis=1)).astype(float) / (2 * offset)
        way = here[:, None] * slope / np.maximum((slope * slope).sum(axis=1), 0.25)[:, None]
        vertices = vertices - np.clip(way, -2 * offset, 2 * offset)
    return vertices


def write(path: Path, title: str, vertices: np.ndarray, triangles: np.ndarray, digits: int) -> None:
    """Write an OBJ file, with so many digits after the point."""
    if len(np.unique(vertices.round(digits), axis=0)) < len(vertices):
        raise ValueError(f"{path.name}: two vertices are the same to {digits} digits; take fewer triangles, or more digits")
    lines = [f"# {title}"]
    lines += [f"v {x:.{digits}f} {y:.{digits}f} {z:.{digits}f}" for x, y, z in vertices]
    lines += [f"f {a} {b} {c}" for a, b, c in triangles + 1]
    path.write_text("\n".join(lines) + "\n")
