"""The sculptures of graphs/meshes are closed, and are the surfaces of the distances that their scripts state."""

import importlib
from pathlib import Path

import numpy as np
import pytest

MESHES = Path(__file__).resolve().parents[2] / "graphs" / "meshes"
NAMES = ("head", "dragon")


@pytest.fixture
def script(monkeypatch):
    """Return a module of the folder of scripts."""
    monkeypatch.syspath_prepend(str(MESHES / "sculpt"))
    return importlib.import_module


def mesh_of(name):
    lines = [line.split() for line in (MESHES / f"{name}.obj").read_text().splitlines()]
    vertices = np.array([line[1:] for line in lines if line[0] == "v"], dtype=float)
    return vertices, np.array([line[1:] for line in lines if line[0] == "f"], dtype=int) - 1


def edges_of(triangles):
    return np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def volume_of(vertices, triangles):
    a, b, c = (vertices[triangles[:, corner]] for corner in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


@pytest.mark.parametrize("name", NAMES)
def test_every_edge_is_met_once_from_each_side(name):
    """A closed surface, all of whose faces look outwards, has each directed edge once, and its opposite once."""
    vertices, triangles = mesh_of(name)
    edges = edges_of(triangles)
    assert len(np.unique(edges, axis=0)) == len(edges)
    assert np.array_equal(np.unique(edges, axis=0), np.unique(edges[:, ::-1], axis=0))
    assert volume_of(vertices, triangles) > 0


@pytest.mark.parametrize("name", NAMES)
def test_vertices_lie_on_the_surface_that_the_script_states(name, script):
    """Nearly all vertices are within 2 mm of where the distance is 0; a smooth distance is not one at its edges."""
    off = np.abs(script(name).distance(mesh_of(name)[0].astype(np.float32)))
    assert np.quantile(off, 0.99) < 0.002


def test_the_sculptures_are_small():
    """Together they take less than 2 MB of every installation."""
    assert sum((MESHES / f"{name}.obj").stat().st_size for name in NAMES) < 2_000_000


def test_a_ball_comes_out_as_one(script):
    """A ball's surface, sampled, decimated and settled, is closed, everywhere a radius from its middle, and of its volume."""
    pytest.importorskip("skimage")
    pytest.importorskip("fast_simplification")
    from types import SimpleNamespace

    clay, surface, build = script("clay"), script("surface"), script("build")
    ball = SimpleNamespace(distance=lambda p: clay.ball(p, (0.1, 0, 0), 0.7), LOW=(-1, -1, -1), HIGH=(1, 1, 1),
                           FOCUS=surface.Focus((0, 0, 0), 0.5, 1.0))
    vertices, triangles = build.sculpted(ball, 0.05, 2000)
    assert np.allclose(np.linalg.norm(vertices - (0.1, 0, 0), axis=1), 0.7, atol=1e-4)
    assert volume_of(vertices, triangles) == pytest.approx(4 / 3 * np.pi * 0.7**3, rel=0.01)


def test_a_soft_join_is_exact_away_from_the_seam(script):
    """join is the least of both where they differ by more than the softness, and below both where they are equal."""
    clay = script("clay")
    a, b = np.array([0.0, 1.0, 0.3]), np.array([0.5, 0.2, 0.3])
    assert np.allclose(clay.join(0.4, a, b), [0.0, 0.2, 0.3 - 0.4 / 4])
    assert np.allclose(clay.cut(0.4, a, -b), -clay.join(0.4, -a, -b))


def test_what_is_magnified_is_restored(script):
    """A focus magnifies about its centre, and gives each point back its place."""
    surface = script("surface")
    focus = surface.Focus((0.0, 1.0, 0.0), 0.5, 1.2)
    points = np.random.default_rng(1).uniform(-2, 2, (200, 3))
    assert np.allclose(focus.restored(focus.magnified(points)), points, atol=1e-3)
    near = np.array([[0.0, 1.01, 0.0]])
    assert np.allclose(focus.magnified(near), [[0, 1.022, 0]], atol=1e-3)
