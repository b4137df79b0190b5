"""`check`, `format`, `schema`, `nodes`: what they print."""

from __future__ import annotations

import json
import re
from pathlib import Path

import jsonschema
import pytest

from graphfx.authoring.sample import sample
from graphfx.cli.group_docs import describe_group, groups_of
from graphfx.cli.node_docs import describe, mentions
from graphfx.cli.value_docs import SUMMARIES
from graphfx.graph.check import check
from graphfx.graph.document import document_of, read_document
from graphfx.graph.flatten import flatten
from graphfx.graph.names import VALUE_KEYS
from graphfx.node import Library, bundled_root
from graphfx.node.roles import treatment
from graphfx.plan.make import make_plan

LIBRARY = Library()
GROUPS = groups_of(LIBRARY)
GRAPHS = sorted((bundled_root() / "graphs").rglob("*.json"))


def test_check_says_that_nothing_is_wrong(invoke) -> None:
    """A sound graph is one line and exit code 0."""
    assert invoke("check", "fountain.json") == (0, "fountain.json: nothing is wrong\n", "")


@pytest.mark.parametrize("graph", GRAPHS, ids=lambda graph: graph.stem)
def test_bundled_graphs_are_sound(invoke, graph: Path) -> None:
    """Every graph that comes with graphfx passes `check`, and is in canonical form."""
    assert invoke("check", str(graph)) == (0, f"{graph}: nothing is wrong\n", "")
    assert invoke("format", "--check", str(graph)) == (0, "", "")


def test_check_goes_through_all_graphs(invoke, folder: Path) -> None:
    """One bad graph does not hide the others; the exit code tells of it."""
    (folder / "bad.json").write_text('{"graphfx": 1, "nodes": {"a": {"type": "emitt"}}}')
    assert invoke("check", "bad.json", "missing.json", "fountain.json") == (
        1, "fountain.json: nothing is wrong\n",
        "bad.json:1:40: nodes.a.type: there is no node type 'emitt'. Did you mean 'emit'?\n"
        "missing.json: there is no such file\n")


def test_check_finds_what_only_planning_shows(invoke, folder: Path) -> None:
    """A graph that would write nothing is wrong."""
    (folder / "mute.json").write_text('{"graphfx": 1, "nodes": {"a": {"type": "emit"}}}')
    said = "mute.json: nodes: the graph has no output: give it an enabled node of type 'image'\n"
    assert invoke("check", "mute.json") == (1, "", said)


def test_format(invoke, folder: Path) -> None:
    """`format` prints the canonical form, `--check` tells whether a file has it, `--write` gives it."""
    rough = (folder / "fountain.json").read_text()
    code, pretty, err = invoke("format", "fountain.json")
    assert (code, err) == (0, "")
    assert len(pretty.splitlines()) > 5
    assert (folder / "fountain.json").read_text() == rough
    assert invoke("format", "--check", "fountain.json") == (
        1, "fountain.json: not in canonical form; 'graphfx format --write fountain.json' mends it\n", "")
    assert invoke("format", "--write", "fountain.json") == (0, "fountain.json: formatted\n", "")
    assert (folder / "fountain.json").read_text() == pretty
    assert invoke("format", "--write", "fountain.json") == invoke("format", "--check", "fountain.json") == (0, "", "")


def test_schema_knows_the_fountain(invoke, folder: Path) -> None:
    """The printed schema accepts a sound graph and refuses a wrong one; --out writes the same."""
    code, out, err = invoke("schema")
    assert (code, err) == (0, "")
    validator = jsonschema.Draft202012Validator(json.loads(out))
    graph = json.loads((folder / "fountain.json").read_text())
    assert list(validator.iter_errors(graph)) == []
    graph["nodes"]["spring"]["rat"] = 3
    assert list(validator.iter_errors(graph)) != []
    assert invoke("schema", "--out", "schema.json") == (0, "", "")
    assert (folder / "schema.json").read_text() == out


def test_nodes_lists_every_type(invoke) -> None:
    """Each node type of the library is a line under its kind, with the first line of its own text."""
    code, out, err = invoke("nodes")
    assert (code, err) == (0, "")
    kinds = {line: part for part in out.split("\n\n") for line in [part.partition("\n")[0]]}
    for name, node_type in LIBRARY.items():
        listed = [line.split(maxsplit=1) for line in kinds[node_type.kind].splitlines()[1:]]
        assert [name, node_type.doc.strip().splitlines()[0]] in listed


@pytest.mark.parametrize("name", sorted(LIBRARY))
def test_description_is_complete(name: str) -> None:
    """All about a node: its text, every parameter with unit and meaning, and where it is declared."""
    node_type, text = LIBRARY[name], describe(LIBRARY[name], LIBRARY)
    assert node_type.doc.strip() in text
    for parameter in node_type.parameters.values():
        assert any(line.startswith(f"  {parameter.label} ") and line.endswith(parameter.doc) for line in text.splitlines())
    assert str(Path(node_type.location.file).name) in text
    assert f"the engine: {treatment(node_type.role)}\n" in text


@pytest.mark.parametrize("name", sorted(LIBRARY))
def test_sample_runs(name: str) -> None:
    """The graph shown with a node is sound, and its plan keeps the node."""
    node_type, document = LIBRARY[name], document_of(sample(LIBRARY[name], LIBRARY))
    assert check(document, LIBRARY) == []
    flat = flatten(document, LIBRARY)
    kept = {flat.nodes[path].node_type.name for path in make_plan(flat).schedule.order}
    assert name in kept or node_type.role == "stack" or node_type.kind == "values"
    assert f'"{name}"' in json.dumps(sample(node_type, LIBRARY))


def test_words_find_nodes(invoke) -> None:
    """A word that is no node type finds those whose text speaks of it, the nearest first."""
    assert invoke("nodes", "parabola") == (2, "", "there is no node type 'parabola'. These speak of it:\n"
                                           f"  gravity  {LIBRARY['gravity'].doc.splitlines()[0]}\n")
    swirl = invoke("nodes", "swirl").err.splitlines()
    assert swirl[1].split()[0] == "vortex"


def test_names_come_before_texts() -> None:
    """Of what speaks of a word, what is named so comes first, then by summary, then by the rest."""
    texts = {"a": ("One.", "a fall"), "b": ("Two falls.", ""), "fall_down": ("Three.", ""), "c": ("Four.", "")}
    assert mentions("Fall", texts) == ["fall_down  Three.", "b          Two falls.", "a          One."]


def test_other_names_are_known(invoke, folder: Path) -> None:
    """A graph that uses another tool's name for a node type is told ours."""
    (folder / "theirs.json").write_text('{"graphfx": 1, "nodes": {"a": {"type": "Axis_Force"}}}')
    assert invoke("check", "theirs.json").err == (
        "theirs.json:1:40: nodes.a.type: there is no node type 'Axis_Force'. Did you mean 'attract_line'?\n")
    assert LIBRARY.other_names["collision"] == "bounce_plane"
    assert set(LIBRARY.other_names).isdisjoint(LIBRARY)


def test_nodes_as_data(invoke) -> None:
    """--json gives the same facts as data, of one type or of all."""
    one, every = json.loads(invoke("nodes", "vortex", "--json").out), json.loads(invoke("nodes", "--json").out)
    assert one["parameters"]["tightness"] | {"doc": ""} == {
        "type": "float", "default": 1.5, "required": False, "unit": "", "min": 0, "max": 8, "choices": [], "doc": ""}
    assert one["signature"] == ("vortex(position, dt, center [m], axis, magnitude [rad/s], tightness, range [m], lift [m/s]) "
                                "-> position")
    assert (one["kind"], one["role"], one["writes"], one["given_by_the_engine"]) == ("operators", "flow", "position", "dt")
    assert one in every
    assert [node["name"] for node in every] == sorted(LIBRARY)


def test_groups_are_listed_and_described(invoke) -> None:
    """Groups of the library are listed below the node types; for one, its parameters, its streams, and a graph that runs."""
    listed = invoke("nodes").out.partition("\ngroups\n")[2].splitlines()
    said = "A gust of wind: two vortices of opposite turn, side by side, that travel from start to end."
    assert ["gust", said] in [line.split(maxsplit=1) for line in listed]
    told = invoke("nodes", "gust").out
    assert told.startswith("gust (group groups/gust.json)\n\nA gust of wind: ")
    assert re.search(r"^  start \[m\] +point +\[-10, 3, 0\] +Where the gust sets out\.$", told, re.MULTILINE)
    assert "\ntakes: particles\ngives: particles\n" in told
    data = json.loads(invoke("nodes", "gust", "--json").out)
    assert (data["kind"], data["use"]) == ("group", "groups/gust.json")
    assert (data["inputs"], data["outputs"]) == (["particles"], ["particles"])
    assert data["parameters"]["start"]["default"] == [-10, 3, 0]
    assert check(document_of(data["sample"]), LIBRARY) == []


@pytest.mark.parametrize("name", VALUE_KEYS)
def test_values_of_the_language_are_described(invoke, name: str) -> None:
    """The language's own values are listed and described too, each with a graph that runs."""
    told = invoke("nodes", name).out
    assert told.startswith(f"{name} (a value of the language)\n\n{SUMMARIES[name]}\n")
    assert all(f"  {key} " in told for key in VALUE_KEYS[name])
    document = read_document(told[told.index("{"):])
    assert check(document, LIBRARY) == []
    assert make_plan(flatten(document, LIBRARY)).images
    assert f"  {name:5}  {SUMMARIES[name]}\n" in invoke("nodes").out


@pytest.mark.parametrize("name", sorted(GROUPS))
def test_sample_of_a_group_runs(name: str) -> None:
    """The graph shown with a group is sound, and can be planned."""
    text = describe_group(GROUPS[name], LIBRARY)
    document = read_document(text[text.index("{"):])
    assert check(document, LIBRARY) == []
    assert make_plan(flatten(document, LIBRARY)).images


DRIFT = '''"""Drift: a slow wind."""
from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.flow(writes="position")
def drift(
    position: Vec3,
    dt: float,
    wind: Vec3 = param(required=True, unit="m/s", doc="Where to."),
    share: float = param(required=True, min=0, max=0.5, doc="How much of it."),
    steady: bool = param(required=True, doc="Whether it blows evenly."),
) -> Vec3:
    """Return the position."""
    return position + wind * (dt * share)
'''


def test_library_adds_nodes(invoke, folder: Path) -> None:
    """--library brings a user's nodes in; a folder that is no library is refused."""
    node = folder / "mine" / "nodes" / "operators" / "drift.py"
    node.parent.mkdir(parents=True)
    node.write_text(DRIFT)
    listed = [line.split(maxsplit=1) for line in invoke("nodes", "--library", "mine").out.splitlines()]
    assert ["drift", "Drift: a slow wind."] in listed
    told = invoke("nodes", "drift", "--library", "mine").out
    assert f"declared in: {node.relative_to(folder)}" in told
    (folder / "sample.json").write_text(told[told.index("{"):])
    assert invoke("check", "sample.json", "--library", "mine") == (0, "sample.json: nothing is wrong\n", "")
    assert invoke("nodes", "--library", "none") == (
        1, "", "none: the library folder none has neither 'nodes' nor 'graphs' in it\n")


def test_text_has_no_place_on_lanes(invoke, folder: Path) -> None:
    """A node that asks for a text per particle is refused at its own line, and is no mistake of graphfx."""
    node = folder / "mine" / "nodes" / "operators" / "drift.py"
    node.parent.mkdir(parents=True)
    node.write_text(DRIFT.replace("steady: bool = param(", "mood: str = param("))
    told = invoke("nodes", "drift", "--library", "mine").out
    (folder / "sample.json").write_text(told[told.index("{"):])
    assert invoke("check", "sample.json", "--library", "mine") == (
        1, "", f"{node.relative_to(folder)}:6: drift: its parameter 'mood' is a string, and functions for "
        "particles are given float, int, vec3, point, direction, color, bool alone in this version\n")


def test_words_of_the_language_are_told(invoke) -> None:
    """`nodes attributes` has a line for each attribute, `nodes expr` for each function; other tools' names lead there."""
    from graphfx.graph.functions import FUNCTIONS
    from graphfx.node import ATTRIBUTES

    lines = invoke("nodes", "attributes")[1].splitlines()
    assert all(sum(line.split()[:1] == [name] for line in lines) == 1 for name in ATTRIBUTES)
    text = invoke("nodes", "expr")[1]
    assert all(f"  {function.spelling}" in text and function.doc in text for function in FUNCTIONS.values())
    assert invoke("nodes", "pscale")[1].startswith("radius [m] ") and invoke("nodes", "Cd")[1].startswith("color ")


def test_check_tells_what_cook_would_refuse(invoke, tmp_path: Path) -> None:
    """Names of files, sizes and meshes are checked before any work: all of it at once, each at its place."""
    (tmp_path / "much.json").write_text("""{"graphfx": 1, "nodes": {
      "text": {"type": "mesh_text", "text": "  "},
      "sky": {"type": "emit", "rate": 1e11, "set": {"position": {"on_surface": {"mesh": "text"}}}},
      "view": {"type": "camera"},
      "first": {"type": "image", "from": "sky", "camera": "view"},
      "second": {"type": "image", "from": "sky", "camera": "view"}}}""")
    code, out, err = invoke("check", str(tmp_path / "much.json"))
    assert (code, out) == (1, "")
    told = [line.removeprefix(str(tmp_path)).lstrip("/") for line in err.splitlines() if not line.startswith(" ")]
    places = [line.split(": ")[0] for line in told]
    assert sorted(places) == ["much.json:2:15", "much.json:3:14", "much.json:6:17"]
