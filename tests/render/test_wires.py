"""Polygons as lines: every edge once, but not what only divides a flat face."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.geometry import box, sphere
from graphfx.render.camera import Camera
from graphfx.render.lines import draw_lines
from graphfx.render.polygons import Polygons
from graphfx.render.wires import FAINT, wires_of


def test_box_has_twelve_edges():
    """Of a box the twelve edges are drawn, and no diagonal."""
    mesh = box((2.0, 4.0, 6.0))
    wires = wires_of(Polygons(mesh.vertices, mesh.triangles))
    lengths = np.linalg.norm(np.asarray(wires.head) - np.asarray(wires.tail), axis=0)
    assert sorted(lengths.tolist()) == pytest.approx([2.0] * 4 + [4.0] * 4 + [6.0] * 4)


def test_round_mesh_has_all_its_edges():
    """Of a closed mesh of triangles none of which lie in one plane each edge is drawn once: three for two triangles."""
    mesh = sphere(1.0, 2)
    wires = wires_of(Polygons(mesh.vertices, mesh.triangles))
    assert 2 * wires.count == 3 * len(mesh.triangles)


def test_open_edges_are_drawn():
    """A triangle alone has three edges, and one without an area too."""
    for corner in ((0.0, 1.0, 0.0), (2.0, 0.0, 0.0)):
        vertices = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], corner])
        assert wires_of(Polygons(vertices, np.array([[0, 1, 2]]))).count == 3


def test_edges_stand_still():
    """Edges are seen by the camera of the shutter's end alone, in their polygon's colour, and faintly."""
    vertices = np.array([[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    wires = wires_of(Polygons(vertices, np.array([[0, 1, 2]]), color=(0.2, 0.4, 0.8), opacity=0.5))
    one, other = (draw_lines([wires], Camera(), Camera(position=(5.0, 0.0, 9.0)) if moved else None, 64, 36).pixels
                  for moved in (False, True))
    assert (one == other).all()
    middle = one[18, 32] + one[17, 32]
    assert middle == pytest.approx(FAINT * 0.5 * np.array([0.2, 0.4, 0.8, 1.0]), rel=0.05)


def test_vertices_at_one_place_count_as_one():
    """A box whose triangles share no vertex has twelve edges too."""
    mesh = box((2.0, 4.0, 6.0))
    assert wires_of(Polygons(mesh.corners.reshape(-1, 3), np.arange(36).reshape(-1, 3))).count == 12
