"""Graphs built in Python: they are the graphs of files."""

from __future__ import annotations

import inspect
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import graphfx
from graphfx.authoring.values import plain
from graphfx.graph.check import check
from graphfx.graph.document import document_of
from graphfx.node import Library, bundled_root

from .fireworks import fireworks
from .snow import snow

GRAPHS = bundled_root() / "graphs"
SNOW = Path(__file__).parents[1] / "snow.json"


def test_snow_is_the_file_to_the_byte(tmp_path: Path) -> None:
    """A whole effect written in Python saves to the bytes of its file."""
    assert snow().save(tmp_path / "snow.json").read_bytes() == SNOW.read_bytes()


@pytest.mark.parametrize("file", sorted(GRAPHS.rglob("*.json")), ids=lambda file: file.stem)
def test_loading_and_saving_changes_nothing(file: Path, tmp_path: Path) -> None:
    """A graph that is loaded and saved again has the same bytes."""
    graph = graphfx.Graph.load(file)
    assert graph.text == file.read_text()
    if not graph.problems():
        assert graph.save(tmp_path / "again.json").read_text() == file.read_text()


def test_loaded_graphs_can_be_added_to() -> None:
    """Nodes of a loaded graph are had by their ids; a stack takes further operators at its end."""
    graph = graphfx.Graph.load(SNOW)
    graph["fall"].gravity(acceleration=(0, -1, 0))
    assert [op["type"] for op in graph.data["nodes"]["fall"]["ops"]] == ["spiral", "gust", "bounce_plane", "gravity"]


def test_effect_has_the_particles_of_the_same_json() -> None:
    """An effect made in Python has the particles of the same graph in a file."""
    g = graphfx.Graph(frames=(1, 4))
    spring = g.emit("spring", rate=240, life=1, set={"velocity": (0, 3, 0), "position": g.in_box()})
    g.image("frames", of=spring.stack("fall").gravity(), camera=g.camera("view"), size=(32, 18))
    given = {"graphfx": 1, "time": {"frames": [1, 4]}, "nodes": {
        "spring": {"type": "emit", "rate": 240, "life": 1, "set": {"velocity": [0, 3, 0], "position": {"in_box": {}}}},
        "fall": {"type": "stack", "from": "spring", "ops": [{"type": "gravity"}]},
        "view": {"type": "camera"},
        "frames": {"type": "image", "from": "fall", "camera": "view", "size": [32, 18]}}}
    assert g.data == document_of(given).root.data() | {"nodes": g.data["nodes"]}
    from graphfx.cook.effect import Effect
    from graphfx.graph.flatten import flatten

    ours, theirs = g.effect().simulate(4), Effect(flatten(document_of(given), Library())).simulate(4)
    assert all(np.array_equal(ours["spring"][name], column) for name, column in theirs["spring"].items())


def test_group_in_python() -> None:
    """A graph with inputs and outputs is a group; what is exposed is its parameter."""
    g = graphfx.Graph("Two turns.")
    left = g.vortex("left", of=g.input("particles", doc="What is turned."), magnitude=2)
    g.output(particles=left.vortex("right"))
    g.expose("left.magnitude")
    assert g.problems() == []
    assert g.data["nodes"]["right"] == {"type": "vortex", "from": "left"}
    assert (g.data["outputs"], g.data["expose"]) == ({"particles": "right"}, ["left.magnitude"])


def test_values_are_written_as_json_has_them() -> None:
    """Tuples, arrays, infinity, paths and nested values become their JSON."""
    g = graphfx.Graph()
    g.values(slow=g.keys((0, 1), (2, 5), interpolation="smooth"))
    source = g.emit("source", life=float("inf"), set={"position": np.array([1.0, 2.0, 3.0]), "mass": np.float32(0.5)})
    source.vortex("turn", only=g.expr("age > 1"), during=(0, 2), magnitude=g.ramp((0, 0), (1, 2), over="age"))
    assert g.data["nodes"]["source"] == {"type": "emit", "life": "infinity", "set": {"position": [1, 2, 3], "mass": 0.5}}
    assert g.data["nodes"]["turn"] == {"type": "vortex", "only": {"expr": "age > 1"}, "during": [0, 2], "from": "source",
                                       "magnitude": {"ramp": [[0, 0], [1, 2]], "over": "age"}}


def test_graphs_are_shown() -> None:
    """Printing a graph prints its canonical text; in a list it is known by its nodes."""
    g = graphfx.Graph()
    stream = g.node("emit", "spring")
    assert str(g) == g.text == '{\n  "graphfx": 1,\n  "nodes": {\n    "spring": {"type": "emit"}\n  }\n}\n'
    assert repr([g, stream, stream.gravity("fall")]) == "[<graph of 2 nodes: spring, fall>, <emit 'spring'>, <gravity 'fall'>]"


def test_operators_may_be_given_as_data() -> None:
    """The operators that a stack is given as JSON data stay, before those called on it."""
    stack = graphfx.Graph().emit("sky").stack("fall", ops=[{"type": "gravity"}]).damp()
    assert [op["type"] for op in stack._graph.data["nodes"]["fall"]["ops"]] == ["gravity", "damp"]


def test_infinities_have_their_words() -> None:
    """Both infinities are written as the words that graphs know, wherever they stand."""
    assert plain((float("inf"), float("-inf"), np.float64("-inf"))) == ["infinity", "-infinity", "-infinity"]


def test_groups_with_several_streams(tmp_path: Path) -> None:
    """A group is a method too: with `inputs` it takes several streams, and each of its outputs is had by name."""
    crossing = graphfx.Graph("Two streams change places.")
    a, b = crossing.input("a", doc="One."), crossing.input("b", doc="The other.")
    crossing.output(c=b.gravity("fall"), d=a.gravity("sink"))
    crossing.save(tmp_path / "crossing.json")
    g = graphfx.Graph(folder=tmp_path)
    g.use("crossing.json", "cross")
    left, right = g.emit("left"), g.emit("right")
    both = left.cross("both", inputs={"a": left, "b": right})
    g.image("frames", of=[both["c"], both["d"]], camera=g.camera("view"))
    assert g.problems() == []
    assert g.data["nodes"]["both"] == {"type": "cross", "inputs": {"a": "left", "b": "right"}}
    assert g.data["nodes"]["frames"]["from"] == ["both.c", "both.d"]


def test_conditions_combine() -> None:
    """`&`, `|` and `~` make the lists of `all`, `any` and `not`, without nesting where none is needed."""
    g = graphfx.Graph()
    a, b, c = (g.expr(f"age > {k}") for k in range(3))
    assert repr(a & b & ~c) == ("Value({'all': [{'expr': 'age > 0'}, {'expr': 'age > 1'}, {'not': {'expr': 'age > 2'}}]})")
    assert repr(a | b & c) == "Value({'any': [{'expr': 'age > 0'}, {'all': [{'expr': 'age > 1'}, {'expr': 'age > 2'}]}]})"


def test_names_are_those_of_the_library(tmp_path: Path) -> None:
    """A node type of a user's library is a method, with its docs and its signature, and is among the names."""
    node = tmp_path / "nodes" / "operators" / "drift.py"
    node.parent.mkdir(parents=True)
    node.write_text('"""Drift: a slow wind."""\nfrom graphfx.math import Vec3\nfrom graphfx.node import operator, param\n\n\n'
                    '@operator.linear(writes="position")\n'
                    'def drift(wind: Vec3 = param((1, 0, 0), unit="m/s", doc="Where to.")) -> Vec3:\n'
                    '    """Return the rate."""\n    return wind\n')
    g = graphfx.Graph(library=[tmp_path])
    stack = g.emit("source").stack("motion").drift(wind=(0, 0, 1)).drift("again")
    assert g.data["nodes"]["motion"]["ops"] == [{"type": "drift", "wind": [0, 0, 1]}, {"type": "drift", "id": "again"}]
    assert stack.drift.__doc__ == "Drift: a slow wind."
    assert str(inspect.signature(g.drift)) == "(id='', /, *, wind=(1.0, 0.0, 0.0), **common)"
    assert {"drift", "vortex", "expr"} <= set(dir(g))


def test_every_node_type_can_be_named() -> None:
    """No node type has the name of a method of graphs or nodes, which would hide it."""
    own = {name for kind in (graphfx.Graph, type(graphfx.Graph().emit("a"))) for name in dir(kind)}
    assert own & set(Library()) == set()


def test_building_needs_no_compiler() -> None:
    """A graph is built and saved without NumPy's heavier company: neither Numba nor networkx is loaded."""
    code = "import graphfx, sys; g = graphfx.Graph(); g.emit('a').gravity(); g.text; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"numba", "networkx", "PIL"} & set(loaded)


def test_data_is_sound_json() -> None:
    """What is built passes the checks of documents."""
    assert check(document_of(snow().data), Library()) == []


def test_the_language_in_python() -> None:
    """Attributes, clusters, events, selectors, conditions and values are written in Python as fireworks.json has them."""
    graph = fireworks()
    assert graph.problems() == []
    assert graph.text == (Path(__file__).parent / "fireworks.json").read_text()
