"""Meshes from files: every format gives the same mesh; what is wrong with a file is told at its node."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import graphfx
from graphfx.cook.meshes import Meshes
from graphfx.errors import GraphError, LimitError
from graphfx.geometry import box, files, load_mesh

trimesh = pytest.importorskip("trimesh", reason="files of meshes are read by trimesh, the extra `mesh`")
BOX = box((1, 2, 3))


@pytest.fixture
def effect(tmp_path: Path):
    """Return a function that loads a graph whose particles are born on a mesh, given by its node."""

    def make(node: dict, value: str = "on_surface", **more: dict) -> graphfx.Effect:
        nodes = {
            "shape": node, **more,
            "sparks": {"type": "emit", "rate": 100, "set": {"position": {value: {"mesh": "shape"}}}},
            "view": {"type": "camera", "position": [0, 0, 9]},
            "picture": {"type": "image", "from": "sparks", "camera": "view", "size": [32, 32]},
        }
        path = tmp_path / "effect.json"
        path.write_text(json.dumps({"graphfx": 1, "time": {"frames": [1, 5]}, "nodes": nodes}))
        return graphfx.load(path)

    return make


def written(folder: Path, name: str) -> Path:
    """Write the box to a file; return its path."""
    path = folder / name
    trimesh.Trimesh(BOX.vertices, BOX.triangles, process=False).export(path)
    return path


@pytest.mark.parametrize("name", ["box.obj", "box.ply", "box.stl", "box.glb", "box.gltf"])
def test_every_format_gives_the_box(name: str, tmp_path: Path) -> None:
    """A box comes back from a file of each format with its corners, its faces, and closed."""
    mesh = load_mesh(str(written(tmp_path, name)))
    assert np.allclose(np.unique(mesh.vertices, axis=0), np.unique(BOX.vertices, axis=0))
    assert (len(mesh.vertices), len(mesh.triangles), mesh.open_edges()) == (8, 12, 0)
    assert mesh.areas.sum() == pytest.approx(22)
    assert (mesh.corners.mean(axis=1) * mesh.crosses).sum() / 6 == pytest.approx(6)


def test_polygons_are_cut(tmp_path: Path) -> None:
    """A quadrilateral and a pentagon of an OBJ become two and three triangles of the same area."""
    lines = ["v 0 0 0", "v 1 0 0", "v 1 1 0", "v 0 1 0", "v 2 0 0", "v 2 1 0", "v 1.5 2 0", "f 1 2 3 4", "f 2 5 6 7 3"]
    (tmp_path / "two.obj").write_text("\n".join(lines))
    mesh = load_mesh(str(tmp_path / "two.obj"))
    assert len(mesh.triangles) == 5
    assert mesh.areas.sum() == pytest.approx(1 + 1.5)


def test_a_cloud_of_points_has_no_faces(tmp_path: Path) -> None:
    """A PLY with points alone is read, for from_points and at_vertices."""
    trimesh.PointCloud(np.arange(30.0).reshape(10, 3)).export(tmp_path / "scan.ply")
    mesh = load_mesh(str(tmp_path / "scan.ply"))
    assert mesh.vertices.tolist() == np.arange(30.0).reshape(10, 3).tolist()
    assert len(mesh.triangles) == 0


def test_parts_stand_where_the_scene_puts_them(tmp_path: Path) -> None:
    """The nodes of a glTF scene are put together, each moved by its own matrix."""
    scene = trimesh.Scene()
    part = trimesh.Trimesh(BOX.vertices, BOX.triangles, process=False)
    for x in (-5, 5):
        scene.add_geometry(part, transform=trimesh.transformations.translation_matrix([x, 0, 0]))
    scene.export(tmp_path / "two.glb")
    mesh = load_mesh(str(tmp_path / "two.glb"))
    assert (len(mesh.triangles), mesh.open_edges()) == (24, 0)
    assert (mesh.vertices.min(axis=0).tolist(), mesh.vertices.max(axis=0).tolist()) == ([-5.5, -1, -1.5], [5.5, 1, 1.5])


@pytest.mark.parametrize(("name", "content", "message"), [
    ("mesh.txt", b"", "the file mesh.txt should be one of .obj, .ply, .stl, .gltf, .glb"),
    ("empty.obj", b"", "the file empty.obj has no points"),
    ("broken.ply", b"ply\nformat", "the file broken.ply cannot be read as ply"),
    ("broken.glb", b"glTF\1\1\1\1\1\1\1\1", "the file broken.glb cannot be read as glb"),
])
def test_bad_files_are_told_apart(name: str, content: bytes, message: str, tmp_path: Path) -> None:
    """A file of another kind, with nothing in it, or cut short, is refused by its name."""
    (tmp_path / name).write_bytes(content)
    with pytest.raises(GraphError) as caught:
        load_mesh(str(tmp_path / name))
    assert str(caught.value).startswith(message)


def test_a_missing_file_is_told() -> None:
    """A file that is not there is refused by its name."""
    with pytest.raises(GraphError, match=r"the file gone\.obj is not there"):
        load_mesh("gone.obj")


def test_too_large_a_file_is_refused_unread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file beyond the limit is not even opened."""
    monkeypatch.setattr(files, "MOST_BYTES", 10)
    with pytest.raises(LimitError, match=r"the file box.obj has [\d,]+ bytes; the most is 10"):
        load_mesh(str(written(tmp_path, "box.obj")))


def test_without_trimesh_the_message_says_what_to_install(effect, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A graph that reads a file where trimesh is missing fails at the node's line, with the command to run."""
    written(tmp_path, "box.obj")
    monkeypatch.setitem(sys.modules, "trimesh", None)
    made = effect({"type": "mesh_file", "file": "box.obj"})
    with pytest.raises(GraphError) as caught:
        made.simulate(1)
    assert str(caught.value).endswith(
        "effect.json:1:63: nodes.shape: files of meshes are read by trimesh, which is not installed; "
        'install it by: pip install "graphfx[mesh]"')


def test_a_mesh_with_nan_is_refused(effect, tmp_path: Path) -> None:
    """A vertex that is not a number is told with its number, at the node."""
    (tmp_path / "bad.obj").write_text("v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n")
    with pytest.raises(GraphError) as caught:
        effect({"type": "mesh_file", "file": "bad.obj"}).simulate(1)
    assert "nodes.shape: the mesh has 1 vertices that are not finite, the first at number 2" in str(caught.value)


def test_points_have_no_surface(effect) -> None:
    """on_surface refuses a mesh without faces, and says what to take."""
    with pytest.raises(GraphError) as caught:
        effect({"type": "mesh_points", "coordinates": [0, 0, 0]}).simulate(1)
    assert str(caught.value).endswith("nodes.shape: it has no surface, and on_surface chooses points of one; "
                                      "take from_points or at_vertices")


def test_only_what_is_needed_is_loaded(effect, tmp_path: Path) -> None:
    """A file that no output needs is not read, nor trimesh imported."""
    written(tmp_path, "box.obj")
    made = effect({"type": "mesh_box"}, unused={"type": "mesh_file", "file": "box.obj"})
    assert made.plan.schedule.dropped == {"unused": "no output depends on it"}
    code = f"import graphfx, sys; graphfx.load({str(tmp_path / 'effect.json')!r}).simulate(2); print('trimesh' in sys.modules)"
    root = Path(__file__).resolve().parents[2]
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=root)
    assert result.stdout == "False\n"


def test_a_moving_mesh_moves_its_births(effect) -> None:
    """Particles born on a mesh that travels along x are found where it was in the middle of their frame."""
    made = effect({"type": "mesh_points", "coordinates": [0, 0, 0], "translate": {"keys": [[0, [0, 0, 0]], [1, [24, 0, 0]]]}},
                  "at_vertices")
    x = made.simulate(5)["sparks"]["position"][:, 0]
    assert set(x[1:].tolist()) == {0.5, 1.5, 2.5, 3.5}


def test_machine_and_reference_agree_on_moving_meshes(effect) -> None:
    """Births on a mesh that turns and stretches are the same bits in plain Python."""
    made = effect({"type": "mesh_torus", "rotate": {"keys": [[0, [0, 0, 0]], [1, [90, 0, 45]]]},
                   "scale": {"keys": [[0, [1, 1, 1]], [1, [2, 1, 1]]]}})
    machine, reference = made.simulate(4)["sparks"]["position"], made.simulate(4, reference=True)["sparks"]["position"]
    assert machine.tobytes() == reference.tobytes()


def test_tables_are_kept_while_a_mesh_stands_still(effect) -> None:
    """A mesh that does not move is made once, however many frames there are."""
    made = effect({"type": "mesh_box"})
    meshes = Meshes(made.flat)
    assert meshes.at("shape", 0.0, 1) is meshes.at("shape", 3.0, 73)


def test_a_shape_that_changes_with_time_is_refused(effect) -> None:
    """Only where a mesh stands may change with time."""
    with pytest.raises(GraphError) as caught:
        effect({"type": "mesh_sphere", "sphere_radius": {"keys": [[0, 1], [1, 2]]}}).simulate(1)
    assert str(caught.value).endswith("nodes.shape: sphere_radius changes with time; of a mesh only translate, rotate, scale may")
