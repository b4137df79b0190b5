"""Polygons in effects: what a graph draws, and what is told of one that cannot be drawn."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import graphfx
from graphfx.cli.commands.check import problems_of
from graphfx.cook import textures
from graphfx.errors import GraphError
from graphfx.graph.literals import linear

FACE = {"type": "mesh_grid", "width": 4, "depth": 4, "rotate": [90, 0, 0]}
"""A sheet that looks to +z."""
VIEW = {"type": "camera", "position": [0, 0, 5], "target": [0, 0, 0], "projection": "orthographic", "view_width": 4}


@pytest.fixture
def graph(tmp_path: Path):
    """Return a function that writes a graph whose image draws the polygons `wall`, and returns its file."""

    def write(wall: dict, image: dict | None = None, **nodes: dict) -> Path:
        given = {
            "face": FACE, **nodes, "wall": {"type": "polygons", "geometry": "face", "shading": "unlit", **wall}, "view": VIEW,
            "picture": {"type": "image", "from": "wall", "camera": "view", "size": [16, 16], **(image or {})},
        }
        path = tmp_path / "scene.json"
        path.write_text(json.dumps({"graphfx": 1, "time": {"frames": [1, 25], "fps": 24}, "nodes": given}))
        return path

    return write


def pixel(path: Path, frame: int = 1) -> list[float]:
    return graphfx.load(path).film(frame, 1).pixels[8, 8].tolist()


def picture(folder: Path, name: str, values, mode: str | None = None) -> None:
    Image.fromarray(np.asarray(values), mode).save(folder / name)


def test_polygons_are_a_picture_without_particles(graph):
    """A graph of polygons alone cooks; colour and opacity change with time."""
    path = graph({"color": {"keys": [[0, [1, 0, 0]], [1, [0, 0, 1]]]}, "opacity": {"expr": "0.5 + time / 2"}})
    assert pixel(path) == [0.5, 0, 0, 0.5]
    assert pixel(path, 25) == [0, 0, 1, 1]


def test_polygons_stand_where_their_mesh_does(graph):
    """A mesh that moves takes its polygons along."""
    path = graph({}, face=FACE | {"translate": {"keys": [[0, [0, 0, 0]], [1, [9, 0, 0]]]}})
    assert pixel(path)[3] == 1.0
    assert pixel(path, 25)[3] == 0.0


def test_lights_of_an_image(graph):
    """The lights that it names and its ambient light; colours and directions may change with time."""
    image = {"lights": ["sun"], "ambient": [0.25, 0.25, 0.25]}
    path = graph({"shading": "flat"}, image, sun={"type": "light", "direction": [0, 0, -2], "color": [0.5, 0.25, 0]})
    assert pixel(path) == [0.75, 0.5, 0.25, 1.0]
    dark = graph({"shading": "flat"}, image, sun={"type": "light", "direction": [0, 0, 1]})
    assert pixel(dark) == [0.25, 0.25, 0.25, 1.0]


def test_the_shoulder_light_is_there_unless_others_are(graph):
    """Without lights there is one, so that nothing is dark; with one that is switched off there is it as well."""
    assert pixel(graph({"shading": "flat"}))[0] > 0.5
    path = graph({"shading": "smooth"}, {"lights": ["sun"]}, sun={"type": "light", "enabled": False})
    assert pixel(path)[0] > 0.5


def test_particles_are_hidden_and_shine_through(graph):
    """A particle behind an opaque wall is not seen, one behind a pane is dimmed, one before is whole."""
    def scene(z: float, opacity: float) -> list[float]:
        spark = {"type": "emit", "count": 1, "set": {"position": [0, 0, z], "radius": 5, "color": [1, 0, 0]}}
        image = {"from": ["wall", {"stream": "spark", "falloff": "disc"}]}
        return pixel(graph({"color": [0, 1, 0], "opacity": opacity}, image, spark=spark))

    assert scene(-1, 1) == [0, 1, 0, 1]
    assert scene(-1, 0.5) == [0.5, 0.5, 0, 1]
    assert scene(1, 1) == [1, 0, 0, 1]


@pytest.mark.parametrize("name, values, expected", [
    ("grey.png", np.full((2, 2), 128, np.uint8), linear(128 / 255)),
    ("deep.png", np.full((2, 2), 25700, np.uint16), linear(25700 / 65535)),
    ("color.png", np.full((2, 2, 3), 200, np.uint8), linear(200 / 255)),
    ("color.jpg", np.full((8, 8, 3), 200, np.uint8), linear(200 / 255)),
    ("color.tif", np.full((2, 2, 3), 200, np.uint8), linear(200 / 255)),
    ("deep.tif", np.full((2, 2), 25700, np.uint16), linear(25700 / 65535)),
    ("whole.tif", np.full((2, 2), 25700, np.int32), linear(25700 / 65535)),
    ("float.tif", np.full((2, 2), 0.5, np.float32), 0.5),
    ("bright.tif", np.full((2, 2), 7.0, np.float32), 1.0),
    ("none.tif", np.full((2, 2), np.nan, np.float32), 0.0),
])
def test_colour_maps_are_linear_light(graph, tmp_path, name, values, expected):
    """Pictures are sRGB, of 8 bits and of 16; in floating point they are linear already, at most 1."""
    picture(tmp_path, name, values)
    np.testing.assert_allclose(pixel(graph({"color_map": name, "color": [1, 1, 0.5]})), [expected, expected, expected / 2, 1],
                               rtol=1e-5)


@pytest.mark.parametrize("name, values, expected", [
    ("grey.png", np.full((2, 2), 51, np.uint8), 0.2),
    ("deep.png", np.full((2, 2), 13107, np.uint16), 0.2),
    ("float.tif", np.full((2, 2), 0.2, np.float32), 0.2),
    ("alpha.png", np.full((2, 2, 4), (255, 255, 255, 51), np.uint8), 0.2),
])
def test_opacity_maps_are_as_they_stand(graph, tmp_path, name, values, expected):
    """Alpha where there is some, else how light it is; no curve is applied."""
    picture(tmp_path, name, values)
    np.testing.assert_allclose(pixel(graph({"opacity_map": name})), [expected] * 4, rtol=1e-6)


def test_alpha_of_a_colour_map(graph, tmp_path):
    """It is opacity; a palette with a transparent colour has it too."""
    picture(tmp_path, "glass.png", np.full((2, 2, 4), (255, 0, 0, 51), np.uint8))
    np.testing.assert_allclose(pixel(graph({"color_map": "glass.png"})), [0.2, 0, 0, 0.2], rtol=1e-6)
    Image.fromarray(np.zeros((2, 2), np.uint8), "P").save(tmp_path / "hole.png", transparency=0)
    assert pixel(graph({"color_map": "hole.png"})) == [0, 0, 0, 0]


def test_picture_is_upright(graph, tmp_path):
    """The first row of a picture is the highest."""
    rows = np.zeros((2, 2, 3), np.uint8)
    rows[0] = (255, 0, 0)
    picture(tmp_path, "flag.png", rows)
    pixels = graphfx.load(graph({"color_map": "flag.png"})).film(1, 1).pixels
    assert pixels[4, 8, 0] > 0.9 and pixels[11, 8, 0] < 0.1


def test_clamped_map_does_not_bleed_over_its_border(graph, tmp_path):
    """At its left border a picture with a light left and a dark right half is light; if it repeats, the dark comes in."""
    picture(tmp_path, "halves.png", np.array([[255, 0]], np.uint8))
    for wrap, first, last in (("repeat", 18 / 32, 14 / 32), ("clamp", 1.0, 0.0)):
        row = graphfx.load(graph({"opacity_map": "halves.png", "wrap": wrap})).film(1, 1).pixels[8, :, 3]
        np.testing.assert_allclose(row[[0, -1]], [first, last], atol=1e-6)


def told(path: Path) -> list[str]:
    """Return what `check` tells, and hold `cook` to it."""
    problems = problems_of(str(path), ())
    if problems:
        with pytest.raises(GraphError) as raised:
            graphfx.load(path).cook(path.parent / "out")
        assert raised.value.problems == problems
        assert not (path.parent / "out").exists()
    return [str(problem).replace(str(path.parent), "<here>") for problem in problems]


def test_missing_texture_is_told(graph):
    """At the place where it is named, with where it was sought."""
    assert told(graph({"color_map": "wood.png"}))[0].splitlines()[0] == (
        "<here>/scene.json:1:225: nodes.wall.color_map: there is no file 'wood.png'."
    )


@pytest.mark.parametrize("path, what", [("../wood.png", "leaves its folder"), ("/wood.png", "is absolute")])
def test_texture_outside_its_folder_is_refused(graph, path, what):
    """As with every path."""
    assert what in told(graph({"opacity_map": path}))[0]


def test_texture_that_is_no_picture_is_told(graph, tmp_path):
    """Text under a picture's name."""
    (tmp_path / "wood.png").write_text("wood")
    assert told(graph({"color_map": "wood.png"})) == [
        "<here>/scene.json:1:225: nodes.wall.color_map: the picture wood.png cannot be read: it is no picture that is known; "
        "give a PNG, JPEG, TIFF or another that Pillow reads"
    ]


def test_damaged_texture_is_told(graph, tmp_path):
    """One that ends too early is found by `check`, which reads it to its end, and by the cook when it is drawn."""
    picture(tmp_path, "wood.png", np.random.default_rng(1).integers(0, 255, (64, 64, 3), np.uint8))
    (tmp_path / "wood.png").write_bytes((tmp_path / "wood.png").read_bytes()[:3000])
    found = told(graph({"color_map": "wood.png"}))
    assert len(found) == 1
    assert found[0].startswith("<here>/scene.json:1:225: nodes.wall.color_map: the picture wood.png cannot be read: ")


def test_texture_that_is_too_large_is_told(graph, tmp_path, monkeypatch):
    """Before it is read."""
    picture(tmp_path, "wood.png", np.zeros((20, 30), np.uint8))
    monkeypatch.setattr(textures, "MOST_TEXELS", 599)
    assert told(graph({"color_map": "wood.png"})) == [
        "<here>/scene.json:1:225: nodes.wall.color_map: the picture wood.png has 30 x 20 pixels, 600; the most of a texture is "
        "599; make it smaller"
    ]


@pytest.mark.parametrize("name, spoken", [("color_map", "a color_map"), ("opacity_map", "an opacity_map")])
def test_mesh_without_coordinates_takes_no_map(graph, tmp_path, name, spoken):
    """It is told at the mesh, and names who draws it."""
    pytest.importorskip("trimesh")
    picture(tmp_path, "wood.png", np.zeros((2, 2), np.uint8))
    (tmp_path / "plain.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert told(graph({name: "wood.png"}, face={"type": "mesh_file", "file": "plain.obj"})) == [
        f"<here>/scene.json:1:74: nodes.face: 'wall' puts {spoken} on it, and it has no coordinates that say where; take a "
        "shape, or a file that has them (vt in OBJ)"
    ]


def test_points_have_nothing_to_draw(graph):
    """Polygons need triangles."""
    assert told(graph({}, face={"type": "mesh_points", "coordinates": [0, 0, 0]})) == [
        "<here>/scene.json:1:74: nodes.face: 'wall' draws its triangles, and it has none"
    ]


@pytest.mark.parametrize("image, message", [
    ({"lights": ["face"]}, "lights[0] should be the id of a light; 'face' is a node of type mesh_grid"),
    ({"lights": ["sun"]}, "there is no node 'sun'."),
    ({"lights": "sun"}, "lights should be a list of ids of nodes; here stands"),
    ({"lights": [1]}, "an entry of lights, the id of a node, should be text in quotes"),
    ({"from": [{"stream": "wall", "blend": "add"}]}, "blend: particles have that, and 'wall' is polygons"),
    ({"from": "face"}, "'face' is a node of type mesh_grid, which makes no stream of particles"),
])
def test_what_an_image_cannot_take_is_told(graph, image, message):
    """Each at its place."""
    assert any(message in problem for problem in told(graph({}, image)))


def test_polygons_are_no_stream(graph):
    """Operators act on particles alone."""
    path = graph({}, fall={"type": "stack", "from": "wall", "ops": [{"type": "gravity"}]})
    assert any("'wall' is a node of type polygons, which makes no stream of particles" in problem for problem in told(path))


@pytest.mark.parametrize("name", ["translate", "rotate", "scale"])
def test_mesh_that_stands_nowhere_is_told(graph, name):
    """A transform that is not finite at some time is told with that time, at its parameter."""
    path = graph({}, face=FACE | {name: {"expr": "vec(1, 1 / (time - 0.5), 1)"}})
    assert pixel(path, 12)[3] >= 0.0
    with pytest.raises(GraphError) as raised:
        pixel(path, 13)
    assert str(raised.value).endswith(f": nodes.face.{name}: at 0.5 s, frame 13, {name} is 1, inf, 1; it must be finite")
    assert raised.value.problems[0].location.line == 1
