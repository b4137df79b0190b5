"""Letters as meshes: outlines by fontTools, filled by mapbox_earcut; both are imported only here."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from graphfx.errors import GraphError, Problem, how_to_install
from graphfx.geometry.mesh import Mesh

FONT = Path(__file__).with_name("fonts") / "DejaVuSans-Bold.ttf"
"""The font that comes with graphfx: Latin letters of DejaVu Sans Bold, whose licence lies beside it."""
LINE = 1.2
"""From one line to the next, in ems."""
MOST_LETTERS = 2000


def letters(text: str, size: float, depth: float, font: str, align: str, tracking: float, curve_steps: int) -> Mesh:
    """Return extruded text: it stands on y = 0, looks towards +z and is half its depth to either side of z = 0.

    Pictures are put on from the front, once for each em.
    """
    if not text.strip():
        raise GraphError(Problem("the text has nothing to show"))
    if len(text) > MOST_LETTERS:
        raise GraphError(Problem(f"the text has {len(text)} letters; the most is {MOST_LETTERS}"))
    face = _Face(Path(font) if font else FONT, curve_steps)
    flats: list[tuple[np.ndarray, list[int]]] = []
    for row, line in enumerate(text.split("\n")):
        across = [0.0]
        for letter in line:
            across.append(across[-1] + face.advance(letter) + tracking)
        width = across[-1] - tracking if line else 0.0
        begin = {"left": 0.0, "center": -width / 2, "right": -width}[align]
        for letter, x in zip(line, across[:-1], strict=True):
            flats += [(points + np.array([begin + x, -LINE * row]), ends) for points, ends in face.shapes(letter)]
    if not flats:
        raise GraphError(Problem("the text has no letter with an outline"))
    solids = [_extruded(points * size, ends, depth, face.fill) for points, ends in flats]
    starts = np.cumsum([0, *(len(solid.vertices) for solid in solids)])
    vertices = np.concatenate([solid.vertices for solid in solids])
    triangles = np.concatenate([solid.triangles + start for solid, start in zip(solids, starts[:-1], strict=True)])
    return Mesh(vertices, triangles, None, vertices[triangles][..., :2] / (size or 1.0))


class _Face:
    """A font: letters as rings of points, in ems."""

    def __init__(self, file: Path, curve_steps: int):
        try:
            from fontTools.ttLib import TTFont
        except ImportError as error:
            raise GraphError(Problem(f"text needs fonttools, {how_to_install(error, 'text')}")) from error
        try:
            import mapbox_earcut
        except ImportError as error:
            raise GraphError(Problem(f"text needs mapbox_earcut, {how_to_install(error, 'text')}")) from error
        try:
            font = TTFont(file, lazy=True)
            self.glyphs, self.names, self.em = font.getGlyphSet(), font.getBestCmap(), font["head"].unitsPerEm
        except Exception as error:  # whatever is wrong with a font
            raise GraphError(Problem(f"the font {file.name} cannot be read: {error}")) from error
        self.file, self.curve_steps, self.fill = file, curve_steps, mapbox_earcut.triangulate_float64

    def glyph(self, letter: str) -> Any:
        """Return a letter's glyph; raise GraphError for a letter that the font has not."""
        if ord(letter) not in self.names:
            raise GraphError(Problem(f"the font {self.file.name} has no letter {letter!r}; give one that has it"))
        return self.glyphs[self.names[ord(letter)]]

    def advance(self, letter: str) -> float:
        """Return the width of a letter."""
        return float(self.glyph(letter).width) / self.em

    def shapes(self, letter: str) -> list[tuple[np.ndarray, list[int]]]:
        """Return a letter's shapes: points of an outer ring and of the holes in it, and where each ring ends."""
        pen = _pen(self.glyphs, self.curve_steps)
        self.glyph(letter).draw(pen)
        rings = [ring for points in pen.rings if len(ring := _simple(np.array(points) / self.em)) > 2]
        if not rings:
            return []
        areas = [_area(ring) for ring in rings]
        sign = np.sign(max(areas, key=abs))
        outer = [k for k, area in enumerate(areas) if area * sign > 0]
        holes: dict[int, list[np.ndarray]] = {k: [] for k in outer}
        for k, area in enumerate(areas):
            around = [j for j in outer if area * sign < 0 and _within(rings[k][0], rings[j])]
            if around:
                holes[min(around, key=lambda j: abs(areas[j]))].append(rings[k])
        return [_joined(rings[k], holes[k]) for k in outer]


def _pen(glyphs: Any, steps: int) -> Any:
    """Return a fontTools pen that notes outlines as rings of points, with so many straight pieces to a curve."""
    from fontTools.pens.basePen import BasePen

    class Rings(BasePen):
        def __init__(self) -> None:
            super().__init__(glyphs)
            self.rings: list[list[tuple[float, float]]] = []

        def _moveTo(self, point: Any) -> None:
            self.rings.append([point])

        def _lineTo(self, point: Any) -> None:
            self.rings[-1].append(point)

        def _curveToOne(self, first: Any, second: Any, end: Any) -> None:
            start = self._getCurrentPoint()
            for k in range(1, steps + 1):
                t = k / steps
                s = 1 - t
                weights = (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)
                parts = zip(start, first, second, end, strict=True)
                self.rings[-1].append(tuple(sum(w * c for w, c in zip(weights, part, strict=True)) for part in parts))

    return Rings()


def _simple(ring: np.ndarray) -> np.ndarray:
    """Return a ring without points that repeat or lie on the line between their neighbours."""
    while len(ring) > 2:
        before, after = ring - np.roll(ring, 1, axis=0), np.roll(ring, -1, axis=0) - ring
        turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
        scale = np.sqrt((before**2).sum(axis=1) * (after**2).sum(axis=1))
        drop = np.abs(turn) <= 1e-6 * scale
        if not drop.any():
            break
        keep = ~drop
        keep[np.flatnonzero(drop)[1:]] |= np.diff(np.flatnonzero(drop)) == 1  # of neighbours only one at a time
        ring = ring[keep]
    return ring


def _area(ring: np.ndarray) -> float:
    x, y = ring.T
    return float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2)


def _within(point: np.ndarray, ring: np.ndarray) -> bool:
    """Return whether a ray from a point along +x crosses a ring an odd number of times."""
    x, y = ring.T
    x1, y1 = np.roll(x, -1), np.roll(y, -1)
    crosses = (y <= point[1]) != (y1 <= point[1])
    with np.errstate(all="ignore"):
        at = x + (point[1] - y) * (x1 - x) / (y1 - y)
    return bool((crosses & (at > point[0])).sum() % 2)


def _joined(outer: np.ndarray, holes: list[np.ndarray]) -> tuple[np.ndarray, list[int]]:
    """Return an outer ring, counter-clockwise, and its holes, clockwise, one after another, with their ends."""
    rings = [outer if _area(outer) > 0 else outer[::-1], *(hole if _area(hole) < 0 else hole[::-1] for hole in holes)]
    return np.concatenate(rings), [int(end) for end in np.cumsum([len(ring) for ring in rings])]


def _extruded(points: np.ndarray, ends: list[int], depth: float, fill: Any) -> Mesh:
    """Return a flat shape with a thickness: front, back, and a wall along each ring."""
    count = len(points)
    number = np.arange(count)
    after = number + 1
    for begin, end in zip([0, *ends], ends, strict=False):
        after[end - 1] = begin
    front = _filled(points, ends, after, fill)
    walls = [np.stack([number, number + count, after + count], axis=1), np.stack([number, after + count, after], axis=1)]
    vertices = np.concatenate([np.column_stack([points, np.full(count, z)]) for z in (depth / 2, -depth / 2)])
    return Mesh(vertices, np.concatenate([front, front[:, ::-1] + count, *walls]))


def _filled(points: np.ndarray, ends: list[int], after: np.ndarray, fill: Any) -> np.ndarray:
    """Return the triangles of a flat shape, each edge of its rings in one of them.

    The filler drops points that lie on a line with others, by which a wall would come to lack its front. Bent a little,
    no three points are on a line.
    """
    for bend in (0.0, 1e-9, 1e-7, 1e-5):
        bent = points + bend * points[:, ::-1] ** 2
        found = fill(np.ascontiguousarray(bent, np.float64), np.array(ends, np.uint32)).astype(np.int64).reshape(-1, 3)
        a, b, c = np.moveaxis(bent[found], 1, 0)
        turned = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0] < 0
        found[turned] = found[turned][:, ::-1]
        edges = {(int(face[k]), int(face[(k + 1) % 3])) for face in found for k in range(3)}
        if all((k, int(next_)) in edges for k, next_ in enumerate(after)):
            break
    return found
