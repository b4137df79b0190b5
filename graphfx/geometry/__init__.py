"""Meshes: shapes, files, letters, their tables for functions of particles, and the search in them."""

from graphfx.geometry.access import (
    along_vertices,
    choose_face,
    choose_vertex,
    face_normal,
    face_point,
    meets_plane,
    skin,
    skin_near,
    upmost_tangent,
    vertex,
    vertex_in_turn,
    vertex_normal,
)
from graphfx.geometry.files import load_mesh
from graphfx.geometry.lettering import letters
from graphfx.geometry.mesh import Mesh
from graphfx.geometry.search import first_meeting, is_inside, nearest
from graphfx.geometry.shapes import box, cone, cylinder, grid, points, sphere, torus

__all__ = [
    "Mesh", "along_vertices", "box", "choose_face", "choose_vertex", "cone", "cylinder", "face_normal", "face_point",
    "first_meeting", "grid", "is_inside", "letters", "load_mesh", "meets_plane", "nearest", "points", "skin", "skin_near",
    "sphere", "torus", "upmost_tangent", "vertex", "vertex_in_turn", "vertex_normal",
]
