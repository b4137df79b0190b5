"""The tree of a mesh: what is found in it is what going through all faces finds."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.geometry import Mesh, box, first_meeting, grid, letters, nearest, sphere, torus
from graphfx.geometry.tables import MeshTables
from graphfx.geometry.tree import LEAF, Tree
from graphfx.node import Library
from graphfx.program import Function
from tests.geometry.lanes import KINDS, PRECISIONS, function_of, on_lanes, same_bits

LIBRARY = Library()
MEETING = Function("meeting", lambda start, end, mesh: first_meeting(mesh, start, end), ("vec3", "vec3", "mesh"),
                   ("bool", "vec3", "vec3"), branches=True)
NEAREST = Function("nearest", lambda position, mesh: nearest(mesh, position), ("vec3", "mesh"), ("vec3", "vec3"), branches=True)
INSIDE = function_of(LIBRARY["inside_mesh"])
SOUP = Mesh(np.random.default_rng(8).normal(size=(900, 3)), np.arange(900).reshape(-1, 3))
MESHES = {"sphere": sphere(1.0, 3), "torus": torus(0.8, 0.3, 24, 12), "soup": SOUP,
          "one face": Mesh(np.eye(3), np.array([[0, 1, 2]]))}


def segments(count: int, size: float, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Return starts and ends, exact in float32."""
    draw = np.random.default_rng(seed)
    start = draw.normal(size=(count, 3))
    return tuple(part.astype(np.float32).astype(float) for part in (start, start + draw.normal(size=(count, 3)) * size))


def crossings(mesh: Mesh, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Return when each segment first crosses a face, as a share of it, by going through all; infinity if never."""
    first = np.full(len(start), np.inf)
    for a, b, c in mesh.corners:
        normal = np.cross(b - a, c - a)
        before, after = (start - a) @ normal, (end - a) @ normal
        with np.errstate(all="ignore"):
            share = before / (before - after)
            point = start + (end - start) * share[:, None]
        inside = (before > 0) != (after > 0)
        for p, q in ((a, b), (b, c), (c, a)):
            inside &= np.cross(q - p, point - p) @ normal >= 0
        first = np.where(inside & (share < first), share, first)
    return first


@pytest.mark.parametrize("count", [1, 2, 4, 5, 9, 100, 1023])
def test_a_tree_holds_every_face_once(count: int) -> None:
    """Walking a tree from end to end comes by every face just once; each box holds all that is below it."""
    corners = np.random.default_rng(count).normal(size=(count, 3, 3))
    tree = Tree.of(corners)
    assert sorted(tree.order.tolist()) == list(range(count))
    assert tree.links[:, 2].sum() == count and tree.links[:, 2].max() <= LEAF
    for (center, half), (beyond, _, _) in zip(tree.boxes.reshape(-1, 2, 3), tree.links, strict=True):
        node = np.flatnonzero((tree.boxes.reshape(-1, 2, 3) == [center, half]).all(axis=(1, 2)))[0]
        below = tree.links[node:beyond]
        faces = np.concatenate([tree.order[first : first + many] for _, first, many in below])
        assert (np.abs(corners[faces] - center) <= half + 1e-12).all()


@pytest.mark.parametrize("size", [0.01, 0.3, 5.0])
@pytest.mark.parametrize("name", MESHES)
def test_first_meeting_is_that_of_all_faces(name: str, size: float) -> None:
    """Segments meet what going through all faces meets, at the same place, to the skin."""
    mesh = MESHES[name]
    start, end = segments(3000, size)
    expected = crossings(mesh, start, end)
    met, point, normal = on_lanes(MEETING, [start, end, MeshTables(mesh, True)], 64)
    assert (met[:, 0] != np.isfinite(expected)).sum() == 0
    hit = np.isfinite(expected)
    way = end - start
    reached = ((point - start) * normal).sum(axis=1) / (way * normal).sum(axis=1)
    assert np.abs(reached - expected)[hit].max() < 1e-9
    assert ((way * normal).sum(axis=1)[hit] < 0).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_single_precision_finds_nearly_the_same(precision: int) -> None:
    """In float32 too a segment is missed or met otherwise only where it passes within the skin of an edge."""
    mesh = MESHES["torus"]
    start, end = segments(20000, 0.5, 4)
    expected = np.isfinite(crossings(mesh, start, end))
    met = on_lanes(MEETING, [start, end, MeshTables(mesh, True)], precision)[0][:, 0]
    assert (met != expected).mean() < 1e-3
    assert not (expected & (met == 0)).any()


@pytest.mark.parametrize("shift", [0.0, 1.0, 1000.0])
@pytest.mark.parametrize("precision", PRECISIONS)
def test_no_segment_slips_between_faces(precision: int, shift: float) -> None:
    """From the middle of a sphere out to far away every segment meets it: also those through edges and vertices."""
    mesh = sphere(1.0, 3).moved(np.eye(3), np.full(3, shift))
    kind = KINDS[precision]
    corners = mesh.corners.astype(kind).astype(float)
    draw = np.random.default_rng(1)
    share = draw.random((len(corners), 1))
    targets = np.concatenate([mesh.vertices, corners[:, 0] + (corners[:, 1] - corners[:, 0]) * share,
                              (corners * draw.dirichlet((1, 1, 1), len(corners))[:, :, None]).sum(axis=1)])
    middle = np.full_like(targets, shift)
    for reach in (1.0 + 1e-5, 2.0, 1e4):
        met, _, normal = on_lanes(MEETING, [middle, middle + (targets - middle) * reach, MeshTables(mesh, True)], precision)
        assert met.all()
        assert ((normal * (targets - middle)).sum(axis=1) < 0).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_sheets_have_two_sides(precision: int) -> None:
    """A sheet is met from above and from below, each time with the normal to the side of the start."""
    tables = MeshTables(grid(2, 2, 3, 3), True)
    start = np.array([[0.1, 1, 0.2], [0.1, -1, 0.2], [1.5, 1, 0], [0.1, 1, 0.2]])
    end = np.array([[0.1, -1, 0.2], [0.1, 1, 0.2], [1.5, -1, 0], [0.1, 0.5, 0.2]])
    met, _, normal = on_lanes(MEETING, [start, end, tables], precision)
    assert met[:, 0].tolist() == [1, 1, 0, 0]
    assert normal[:2].tolist() == [[0, 1, 0], [0, -1, 0]]


@pytest.mark.parametrize(("mesh", "inside"), [
    (sphere(1.0, 4), lambda p: np.abs(np.linalg.norm(p, axis=1) - 1) > 0.01),
    (torus(0.8, 0.3, 96, 48), lambda p: np.abs(np.hypot(np.hypot(p[:, 0], p[:, 2]) - 0.8, p[:, 1]) - 0.3) > 0.01),
], ids=["sphere", "torus"])
@pytest.mark.parametrize("precision", PRECISIONS)
def test_inside_of_round_shapes(mesh: Mesh, inside: object, precision: int) -> None:
    """Inside is where the formula of the shape says, but for its flat faces."""
    points = np.random.default_rng(3).uniform(-1.3, 1.3, (30000, 3))
    points = points[inside(points)]  # type: ignore[operator]
    found = on_lanes(INSIDE, [points, MeshTables(mesh, True)], precision)[0][:, 0].astype(bool)
    if mesh.vertices.shape[0] == 2562:
        expected = np.linalg.norm(points, axis=1) < 1
    else:
        expected = np.hypot(np.hypot(points[:, 0], points[:, 2]) - 0.8, points[:, 1]) < 0.3
    assert (found == expected).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_inside_is_sound_in_line_with_edges(precision: int) -> None:
    """Points whose rays run along faces and edges and through vertices of a finely cut box are told right."""
    steps = np.arange(-3, 4) / 2 + 0.25
    line = np.concatenate([steps, np.arange(-3, 4) / 2])
    points = np.stack(np.meshgrid(line, line, line), axis=-1).reshape(-1, 3)
    surface = (np.abs(points) <= 1).all(axis=1) & (np.abs(points) == 1).any(axis=1)
    points = points[~surface]
    mesh = box((2, 2, 2))
    ab, bc, ca = ((mesh.corners[:, k] + mesh.corners[:, (k + 1) % 3]) / 2 for k in range(3))
    a, b, c = np.moveaxis(mesh.corners, 1, 0)
    cut = np.concatenate([np.stack(part, axis=1) for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    fine = Mesh(cut.reshape(-1, 3), np.arange(len(cut) * 3).reshape(-1, 3))
    found = on_lanes(INSIDE, [points, MeshTables(fine, True)], precision)[0][:, 0].astype(bool)
    assert (found == (np.abs(points) < 1).all(axis=1)).all()


def test_inside_of_letters() -> None:
    """The share of a box that is inside extruded letters is their volume."""
    mesh = letters("B8", 1.0, 0.5, "", "left", 0.0, 4)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    points = np.random.default_rng(6).uniform(low, high, (200_000, 3))
    found = on_lanes(INSIDE, [points, MeshTables(mesh, True)], 32)[0][:, 0].mean()
    volume = (mesh.corners.mean(axis=1) * mesh.crosses).sum() / 6 / np.prod(high - low)
    assert found == pytest.approx(volume, abs=4 * np.sqrt(0.25 / 200_000))


@pytest.mark.parametrize("name", MESHES)
def test_nearest_is_that_of_all_faces(name: str) -> None:
    """No point of a mesh is nearer than what is found, and what is found lies on it."""
    mesh, tables = MESHES[name], MeshTables(MESHES[name], True)
    points = np.random.default_rng(2).normal(size=(300, 3))
    found, normal = on_lanes(NEAREST, [points, tables], 64)
    share = np.random.default_rng(5).dirichlet((0.3, 0.3, 0.3), 400)
    everywhere = np.concatenate([np.einsum("kc,ncd->nkd", share, mesh.corners).reshape(-1, 3), mesh.vertices])
    least = np.array([np.sqrt(((everywhere - point) ** 2).sum(axis=1).min()) for point in points])
    distance = np.sqrt(((found - points) ** 2).sum(axis=1))
    assert (distance <= least + 1e-12).all()
    again, _ = on_lanes(NEAREST, [found, tables], 64)
    assert np.abs(again - found).max() < 1e-7
    assert np.allclose((normal**2).sum(axis=1), 1)


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("function", [MEETING, NEAREST, INSIDE], ids=str)
def test_machine_agrees_with_plain_python(function: Function, precision: int) -> None:
    """Machine and plain Python give the same bits."""
    start, end = segments(150, 0.7)
    given = [start, end] if function is MEETING else [start]
    assert same_bits(function, [*given, MeshTables(sphere(1.0, 2), True)], precision)
