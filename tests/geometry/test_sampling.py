"""Points of meshes: faces by area, evenly on each, vertices exactly; the same bits in plain Python and on lanes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.geometry import Mesh, points, sphere, upmost_tangent
from graphfx.geometry.access import split_even
from graphfx.geometry.areas import alias_table
from graphfx.geometry.tables import MeshTables
from graphfx.math import Vec3
from graphfx.node import Library
from graphfx.program import Function
from tests.geometry.lanes import KINDS, PRECISIONS, function_of, in_plain_python, on_lanes, random_draws, same_bits

LIBRARY = Library()
ON_SURFACE, AT_VERTICES, FROM_POINTS = (function_of(LIBRARY[name]) for name in ("on_surface", "at_vertices", "from_points"))
SPLIT = Function("split", split_even, ("float", "float", "float"), ("float", "float"))
MANY = 400_000


def uneven(faces: int, seed: int = 3) -> Mesh:
    """Return triangles apart from each other whose areas run over five decades."""
    draw = np.random.default_rng(seed)
    size = 10.0 ** draw.uniform(-2.5, 0, faces)
    corners = draw.normal(size=(faces, 3, 3)) * size[:, None, None]
    corners[:, :, 1] += np.arange(faces)[:, None] * 20  # so that the height tells the face
    return Mesh(corners.reshape(-1, 3), np.arange(3 * faces).reshape(-1, 3))


def chi_square(counts: np.ndarray, expected: np.ndarray) -> float:
    """Return (chi^2 - degrees of freedom) / its deviation: about 0 for a true distribution, and seldom beyond 4."""
    freedom = len(counts) - 1
    return float((((counts - expected) ** 2 / expected).sum() - freedom) / np.sqrt(2 * freedom))


@pytest.mark.parametrize("weights", [
    [1.0], [1, 1, 1], [0, 1], [0, 0, 5, 0], [1e-9, 1, 1e9], [3, 1, 1, 1, 1, 1], list(range(1, 100)),
    list(10.0 ** np.linspace(-8, 3, 57)),
])
def test_alias_table_gives_each_its_weight(weights: list[float]) -> None:
    """What all places together give to an item is its share of the weight, exactly."""
    share = np.array(weights, float) / np.sum(weights)
    chance, other = alias_table(np.array(weights, float))
    given = (chance + np.bincount(other, 1 - chance, len(share))) / len(share)
    assert np.allclose(given, share, rtol=1e-13, atol=1e-16)
    assert ((chance >= 0) & (chance <= 1)).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_million_faces_are_chosen_exactly(precision: int) -> None:
    """With a million faces and 24 random bits, which make 16 or 17 of each, the next draw evens out the difference."""
    count, draws = 1_000_003, 1 << 22
    kind = KINDS[precision]
    u = (np.arange(draws) * 4 + 1) * 2.0**-24
    v = np.random.default_rng(5).integers(0, 1 << 24, draws) * 2.0**-24
    number, rest = on_lanes(SPLIT, [np.full(draws, count, kind), u, v], precision)
    exact = (u.astype(object)[:1000] * 2**24 * 2**24 + v.astype(object)[:1000] * 2**24) * count
    assert [int(value) >> 48 for value in exact] == number[:1000, 0].astype(int).tolist()
    assert (rest >= 0).all() and (rest < 1).all()
    assert abs(float(rest.astype(float).mean()) - 0.5) < 4 * np.sqrt(1 / 12 / draws)
    assert number.max() == count - 1 and number.min() == 0


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("mesh", [uneven(40), sphere(1.0, 2)], ids=["uneven", "sphere"])
def test_faces_are_chosen_by_area(mesh: Mesh, precision: int) -> None:
    """The faces of a mesh are hit in proportion to their areas."""
    tables = MeshTables(mesh)
    found, normals, _ = on_lanes(ON_SURFACE, [random_draws(MANY), tables], precision)
    if len(mesh.triangles) == 40:
        face = np.rint(found[:, 1].astype(float) / 20).astype(int)
    else:
        face = np.argmax(normals.astype(float) @ mesh.face_normals.T, axis=1)
    expected = MANY * mesh.areas / mesh.areas.sum()
    enough = expected > 10
    counts = np.bincount(face, minlength=len(expected))
    assert abs(chi_square(counts[enough], expected[enough] * counts[enough].sum() / expected[enough].sum())) < 4


@pytest.mark.parametrize("precision", PRECISIONS)
def test_points_lie_evenly_on_a_face(precision: int) -> None:
    """Over 36 equal parts of a triangle points are even: none is favoured at an edge or a corner."""
    mesh = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float), np.array([[0, 1, 2]]))
    found = on_lanes(ON_SURFACE, [random_draws(MANY, 7), MeshTables(mesh)], precision)[0].astype(float)
    x, y = found[:, 0], found[:, 1]
    assert (x >= 0).all() and (y >= 0).all() and (x + y <= 1 + 1e-7).all()
    cells = 6
    column, row = (np.minimum((part * cells).astype(int), cells - 1) for part in (x, y))
    upper = (x * cells - column) + (y * cells - row) > 1
    number = (column * cells + row) * 2 + upper
    inside = column + row + upper < cells
    counts = np.bincount(number[inside], minlength=2 * cells**2)
    counts = counts[counts > 0]
    assert len(counts) == cells**2
    assert abs(chi_square(counts, np.full(cells**2, inside.sum() / cells**2))) < 4


@pytest.mark.parametrize("precision", PRECISIONS)
def test_the_middle_of_points_is_the_middle_of_the_surface(precision: int) -> None:
    """The mean of points on a mesh is its centroid by area, within the error of a mean."""
    mesh = uneven(12, seed=11)
    found = on_lanes(ON_SURFACE, [random_draws(MANY, 2), MeshTables(mesh)], precision)[0].astype(float)
    centroid = (mesh.corners.mean(axis=1) * mesh.areas[:, None]).sum(axis=0) / mesh.areas.sum()
    assert (np.abs(found.mean(axis=0) - centroid) < 4 * found.std(axis=0) / np.sqrt(MANY) + 1e-6).all()


def test_faces_without_area_are_never_chosen() -> None:
    """Of two faces, one of which is a line, all points lie on the other."""
    mesh = Mesh(np.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 5, 0], [1, 5, 0], [0, 6, 0]], float), np.arange(6).reshape(2, 3))
    found = on_lanes(ON_SURFACE, [random_draws(10_000), MeshTables(mesh)], 32)[0]
    assert (found[:, 1] >= 5).all()


@pytest.mark.parametrize(("normal", "tangent"), [
    ((1, 0, 0), (0, 1, 0)), ((0, 0, -1), (0, 1, 0)), ((0, 1, 0), (1, 0, 0)), ((0, -1, 0), (1, 0, 0)),
    ((0.6, 0.8, 0), (-0.8, 0.6, 0)), ((0, -0.6, 0.8), (0, 0.8, 0.6)),
])
def test_upmost_tangent_by_hand(normal: tuple[float, float, float], tangent: tuple[float, float, float]) -> None:
    """On a wall it is up; on a roof of slope 3:4 it climbs the roof; on a floor or a ceiling it is +x."""
    with np.errstate(all="ignore"):
        found = upmost_tangent(Vec3(*map(np.float64, normal)))
    assert np.allclose([found.x, found.y, found.z], tangent, atol=1e-15)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_tangents_climb(precision: int) -> None:
    """On a sphere tangents are of unit length, square to the normal, and none points down."""
    _, normal, tangent = (part.astype(float) for part in
                          on_lanes(ON_SURFACE, [random_draws(5000), MeshTables(sphere(1.0, 3))], precision))
    eps = float(np.finfo(KINDS[precision]).eps)
    assert np.abs((normal * tangent).sum(axis=1)).max() < 4 * eps
    assert np.abs((tangent**2).sum(axis=1) - 1).max() < 8 * eps
    assert tangent[:, 1].min() >= 0


@pytest.mark.parametrize("precision", PRECISIONS)
def test_each_vertex_has_its_particle(precision: int) -> None:
    """Particle k is at vertex k mod 12 of an icosahedron, exactly, also where k needs more than 32 bits."""
    mesh = sphere(1.0, 0)
    ids = np.array([*range(30), *range(2**40, 2**40 + 30), *range(2**63, 2**63 + 7)], np.uint64)
    found, normal = on_lanes(AT_VERTICES, [ids, MeshTables(mesh)], precision)
    which = (ids % 12).astype(int)
    assert found.tolist() == mesh.vertices.astype(KINDS[precision])[which].tolist()
    assert np.allclose(normal, mesh.vertex_normals()[which], atol=1e-7)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_each_point_is_as_likely(precision: int) -> None:
    """Of seven points each is chosen a seventh of the time."""
    cloud = points(tuple(part for j in range(7) for part in (float(j), 0.0, 0.0)))
    found, _ = on_lanes(FROM_POINTS, [random_draws(MANY, 9), MeshTables(cloud)], precision)
    counts = np.bincount(found[:, 0].astype(int), minlength=7)
    assert abs(chi_square(counts, np.full(7, MANY / 7))) < 4


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("function", [ON_SURFACE, FROM_POINTS, AT_VERTICES], ids=str)
def test_lanes_agree_with_plain_python(function: Any, precision: int) -> None:
    """Machine and plain Python give the same bits."""
    given = np.arange(500, dtype=np.uint64) * 12345 if function is AT_VERTICES else random_draws(500)
    assert same_bits(function, [given, MeshTables(uneven(33))], precision)


def test_precisions_choose_the_same_faces() -> None:
    """The same draws fall on the same face in float32 and float64."""
    tables = MeshTables(sphere(1.0, 4))
    draws = random_draws(3000)
    single, double = (in_plain_python(ON_SURFACE, [draws, tables], precision)[1] for precision in PRECISIONS)
    assert (np.abs(single - double).max(axis=1) < 1e-6).mean() > 0.999
