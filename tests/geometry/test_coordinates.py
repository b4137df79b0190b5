"""Places in pictures: where the corners of triangles lie in them."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.geometry import box, cone, cylinder, grid, load_mesh, sphere, torus
from graphfx.geometry.mesh import rotation

SHAPES = {
    "box": box((1, 2, 3)), "sphere": sphere(1.0, 5), "grid": grid(2, 3, 4, 5), "cylinder": cylinder(1, 2, 12, True),
    "cone": cone(1, 2, 12, True), "torus": torus(2, 0.5, 16, 12),
}


def areas(mesh):
    """Return twice the areas of the triangles in the picture; above 0 where u is to the right of v, as in space."""
    a, b, c = np.moveaxis(mesh.coordinates, 1, 0)
    (x, y), (z, w) = (b - a).T, (c - a).T
    return x * w - y * z


@pytest.mark.parametrize("name", SHAPES)
def test_pictures_are_not_mirrored(name):
    """Seen from outside, every triangle turns the same way in the picture as in space."""
    mesh = SHAPES[name]
    assert mesh.coordinates.shape == (len(mesh.triangles), 3, 2)
    assert (areas(mesh) > 0).all()


@pytest.mark.parametrize("name, times", [("box", 6), ("sphere", 1), ("grid", 1), ("torus", 1)])
def test_picture_is_put_on_so_many_times(name, times):
    """The triangles take up the picture once for each face, or once around."""
    assert areas(SHAPES[name]).sum() / 2 == pytest.approx(times, rel=0.02)


def test_picture_is_upright():
    """v goes up: along y on a box, away from the viewer on a sheet, whose picture is seen from above."""
    mesh = box((1, 1, 1))
    front = (mesh.corners[..., 2] > 0.4).all(axis=1)
    np.testing.assert_allclose(mesh.coordinates[front], mesh.corners[front][..., :2] + 0.5)
    sheet = grid(1, 1, 2, 2)
    np.testing.assert_allclose(sheet.coordinates[..., 1], 0.5 - sheet.corners[..., 2])


def test_seam_of_a_sphere_is_narrow():
    """No triangle spans the picture, whatever side of the seam its corners are on."""
    u = sphere(1.0, 3).coordinates[..., 0]
    assert (u.max(axis=1) - u.min(axis=1)).max() < 0.3


def test_mirrored_mesh_keeps_places_at_their_corners():
    """What turns triangles round turns their places round too."""
    mesh = box((1, 1, 1))
    moved = mesh.moved(rotation((10, 20, 30)) * [-1, 1, 1], np.zeros(3))
    found = {tuple(np.round(corner, 9)): set() for corner in moved.corners.reshape(-1, 3)}
    assert len(found) == 8
    for face, places, old_face, old_places in zip(moved.corners, moved.coordinates, mesh.corners, mesh.coordinates, strict=True):
        for corner, place in zip(old_face @ (rotation((10, 20, 30)) * [-1, 1, 1]).T, old_places, strict=True):
            at = np.abs(face - corner).sum(axis=1).argmin()
            np.testing.assert_allclose(places[at], place)


def test_places_in_a_file_are_read(tmp_path):
    """OBJ's vt, by corner, also where vertices that lie at one place become one."""
    (tmp_path / "roof.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 0.5 0\nvt 0 0.5\nvt 0.25 1\nvt 1 0.75\nf 1/1 2/2 3/3\nf 2/4 4/5 3/3\n"
    )
    mesh = load_mesh(str(tmp_path / "roof.obj"))
    assert len(mesh.vertices) == 4
    assert mesh.coordinates.tolist() == [[[0, 0], [0.5, 0], [0, 0.5]], [[0.25, 1], [1, 0.75], [0, 0.5]]]


def test_file_without_places_has_none(tmp_path):
    """Triangles alone say nothing of pictures."""
    (tmp_path / "plain.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert load_mesh(str(tmp_path / "plain.obj")).coordinates is None
