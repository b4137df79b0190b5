"""Shapes: closed, their outside out, of the right size; transforms do what they say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from graphfx.errors import GraphError
from graphfx.geometry import Mesh, box, cone, cylinder, grid, points, sphere, torus
from graphfx.geometry.mesh import checked, polygons, transform

CLOSED = {"box": box((1.0, 2.0, 3.0)), "sphere": sphere(2.0, 3), "cylinder": cylinder(0.5, 3.0, 17, True),
          "cone": cone(1.0, 2.0, 9, True), "torus": torus(1.0, 0.25, 31, 12)}
TURN = 2 * np.pi


def volume(mesh: Mesh) -> float:
    """Return the volume that a closed mesh holds, by the divergence theorem; negative if it is inside out."""
    return float((mesh.corners.mean(axis=1) * mesh.crosses).sum() / 6)


def polygon(sides: int, radius: float) -> float:
    """Return the area of a regular polygon."""
    return sides * radius**2 * np.sin(TURN / sides) / 2


@pytest.mark.parametrize("name", CLOSED)
def test_solid_shapes_are_closed(name: str) -> None:
    """Every edge of a solid shape lies between two faces."""
    assert CLOSED[name].open_edges() == 0


@pytest.mark.parametrize(("name", "expected"), [
    ("box", 6.0), ("cylinder", polygon(17, 0.5) * 3), ("cone", polygon(9, 1.0) * 2 / 3),
])
def test_volume_is_exact(name: str, expected: float) -> None:
    """A shape holds the volume that its formula says, with its outside out."""
    assert volume(CLOSED[name]) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(("mesh", "expected"), [
    (sphere(1.0, 5), 4 / 3 * np.pi), (torus(1.0, 0.25, 500, 250), 2 * np.pi**2 * 0.25**2),
])
def test_volume_converges(mesh: Mesh, expected: float) -> None:
    """A finely cut round shape holds nearly the volume of the round one."""
    assert volume(mesh) == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("subdivisions", [0, 1, 4])
def test_sphere_has_so_many_faces(subdivisions: int) -> None:
    """A sphere has 20 4^n faces, and Euler's number of vertices for them."""
    mesh = sphere(1.0, subdivisions)
    assert (len(mesh.triangles), len(mesh.vertices)) == (20 * 4**subdivisions, 10 * 4**subdivisions + 2)


@pytest.mark.parametrize("mesh", [grid(1, 1, 3, 3), cylinder(1, 1, 8, False), cone(1, 1, 8, False)])
def test_sheets_and_tubes_are_open(mesh: Mesh) -> None:
    """What has a rim is not closed."""
    assert mesh.open_edges() > 0


def test_grid_looks_up() -> None:
    """The faces of a grid look towards +y, and cover it."""
    mesh = grid(2.0, 3.0, 4, 5)
    assert (mesh.face_normals == [0, 1, 0]).all()
    assert mesh.areas.sum() == pytest.approx(6)


def test_a_flipped_face_opens_a_mesh() -> None:
    """A closed mesh with one face turned over does not count as closed."""
    mesh = box((1, 1, 1))
    turned = mesh.triangles.copy()
    turned[0] = turned[0][::-1]
    assert Mesh(mesh.vertices, turned).open_edges() == 3


def test_corners_at_one_place_count_as_one() -> None:
    """A box whose faces share no vertex, as in an STL, is closed all the same."""
    mesh = box((1, 1, 1))
    assert Mesh(mesh.corners.reshape(-1, 3), np.arange(36).reshape(-1, 3)).open_edges() == 0


def test_polygons_become_fans() -> None:
    """A pentagon is cut into three triangles about its first corner."""
    assert polygons(np.zeros((5, 3)), [(0, 1, 2, 3, 4)]).triangles.tolist() == [[0, 1, 2], [0, 2, 3], [0, 3, 4]]


def test_normals_of_a_cube_point_from_its_middle() -> None:
    """At a corner of a cube the normal weighted by angles is the diagonal, however its faces are cut."""
    mesh = box((2, 2, 2))
    assert np.allclose(mesh.vertex_normals(), mesh.vertices / np.sqrt(3), atol=1e-15)


def test_transform_scales_then_rotates_then_translates() -> None:
    """(1, 0, 0), doubled, turned by 90 degrees about z to +y, and moved by (0, 0, 5)."""
    matrix, shift = transform((0, 0, 5), (0, 0, 90), (2, 1, 1))
    assert np.allclose(matrix @ [1, 0, 0] + shift, [0, 2, 5], atol=1e-15)


def test_rotation_goes_about_x_then_y() -> None:
    """+y turned by 90 degrees about x is +z, which 90 degrees about y take to +x."""
    matrix, _ = transform((0, 0, 0), (90, 90, 0), (1, 1, 1))
    assert np.allclose(matrix @ [0, 1, 0], [1, 0, 0], atol=1e-15)


def test_a_mirrored_mesh_keeps_its_outside_out() -> None:
    """A negative scale turns no mesh inside out, nor its normals."""
    mesh = sphere(1.0, 2).moved(*transform((0, 0, 0), (0, 0, 0), (-1, 2, 1)))
    assert volume(mesh) > 0
    assert ((mesh.vertex_normals() * mesh.vertices).sum(axis=1) > 0).all()


def test_normals_stay_upright_under_stretching() -> None:
    """A slope of 45 degrees, stretched to half its height, has the normal (1, 2, 0) / sqrt 5."""
    plane = Mesh(np.array([[0, 0, 0], [0, 0, 1], [1, -1, 0]], float), np.array([[0, 1, 2]]), np.array([[1.0, 1, 0]] * 3))
    moved = plane.moved(*transform((0, 0, 0), (0, 0, 0), (1, 0.5, 1)))
    assert np.allclose(moved.vertex_normals(), np.array([1, 2, 0]) / np.sqrt(5))
    assert np.allclose(moved.face_normals, np.array([1, 2, 0]) / np.sqrt(5))


def test_points_need_whole_triples() -> None:
    """A list of four numbers is no list of points."""
    with pytest.raises(GraphError, match="points takes x, y, z for each point, and has 4 numbers"):
        points((1, 2, 3, 4))


NO_FACES = np.zeros((0, 3), int)
UNSOUND = [
    (Mesh(np.zeros((0, 3)), NO_FACES), "it has no points"),
    (Mesh(np.array([[0, 0, 0], [np.nan, 0, 0]]), NO_FACES), "it has 1 vertices that are not finite, the first at number 1"),
    (Mesh(np.zeros((2, 3)), np.array([[0, 1, 2]])),
     "it has triangles with corners that are not there: vertices count from 0 to 1"),
]


@pytest.mark.parametrize(("mesh", "message"), UNSOUND)
def test_unsound_meshes_are_refused(mesh: Mesh, message: str) -> None:
    """A mesh with no points, a NaN, or a corner that is not there is refused."""
    with pytest.raises(GraphError) as caught:
        checked(mesh, "it")
    assert str(caught.value) == message


def test_shading_normals_are_on_the_side_to_which_triangles_run():
    """A file's normals that point inwards, or triangles that run the other way round, turn all of them; no normals do not."""
    ball = sphere(2.0, 2)
    normals = ball.vertex_normals()
    inwards, clockwise = replace(ball, normals=-normals), replace(ball, triangles=ball.triangles[:, ::-1], normals=normals)
    assert np.array_equal(ball.shading_normals(), normals)
    assert np.array_equal(inwards.shading_normals(), normals) and np.array_equal(clockwise.shading_normals(), -normals)
