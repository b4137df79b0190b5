"""Smooth light goes round blunt edges of meshes, and not round sharp ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from graphfx.geometry import box, sphere
from graphfx.geometry.creases import MOST_MEETING, creased
from graphfx.geometry.mesh import Mesh, unit_rows
from graphfx.geometry.shapes import cone, cylinder


def test_faces_of_a_box_are_flat():
    """At each of its corners each face has its own normal; the corners stay where they are, in the picture too."""
    mesh = box((2.0, 4.0, 6.0))
    made, normals = creased(mesh)
    np.testing.assert_array_equal(made.corners, mesh.corners)
    np.testing.assert_array_equal(made.coordinates, mesh.coordinates)
    np.testing.assert_allclose(normals[made.triangles], mesh.face_normals[:, None].repeat(3, axis=1), atol=1e-12)


def test_cylinder_is_round_and_its_caps_are_flat():
    """Around it normals point away from the axis, on its caps along it, whatever the number of sides from eight on."""
    for segments in (8, 32):
        made, normals = creased(cylinder(1.0, 2.0, segments, True))
        cap = np.abs(made.face_normals[:, 1]) > 0.5
        np.testing.assert_allclose(normals[made.triangles[cap]], made.face_normals[cap][:, None].repeat(3, axis=1), atol=1e-12)
        away = unit_rows(made.corners[~cap] * [1.0, 0.0, 1.0])
        assert ((normals[made.triangles[~cap]] * away).sum(axis=2) > np.cos(np.radians(15.0))).all()


def test_round_meshes_share_their_vertices():
    """Without a sharp edge nothing is taken apart, and normals are those of the vertices; a file's own stay."""
    for mesh in (replace(sphere(2.0, 2), normals=None), sphere(2.0, 0)):
        made, normals = creased(mesh)
        assert made is mesh
        np.testing.assert_array_equal(normals, mesh.shading_normals())


def test_vertices_at_one_place_count_as_one():
    """A sphere whose triangles share no vertex is as round as one whose triangles do."""
    ball = replace(sphere(2.0, 2), normals=None)
    apart = Mesh(ball.corners.reshape(-1, 3), np.arange(ball.triangles.size).reshape(-1, 3))
    made, normals = creased(apart)
    np.testing.assert_allclose(normals[made.triangles], ball.vertex_normals()[ball.triangles], atol=1e-12)


def test_triangles_without_area_change_nothing():
    """A cube with a triangle that is a line keeps its normals, and one that is flattened to a point has no others than 0."""
    cube = box((1.0, 1.0, 1.0))
    _, normals = creased(replace(cube, triangles=np.concatenate([cube.triangles, [[0, 0, 1]]]), coordinates=None))
    np.testing.assert_array_equal(normals[:-3], creased(cube)[1])
    _, none = creased(cube.moved(np.zeros((3, 3)), np.zeros(3)))
    assert not none.any()


def test_very_many_faces_about_a_vertex():
    """Where more meet than are compared, the normal there is the mean of all."""
    mesh = cone(1.0, 2.0, MOST_MEETING + 1, False)
    made, normals = creased(replace(mesh, triangles=np.concatenate([mesh.triangles, [[0, 1, 0]]]), coordinates=None))
    tip = made.vertices[:, 1] == 1.0
    np.testing.assert_allclose(normals[tip], [[0.0, 1.0, 0.0]] * int(tip.sum()), atol=1e-9)
