"""Selections: which particles an operator acts on, a spawn listens to, and a picture shows."""

from __future__ import annotations

import numpy as np
import pytest

from .effects import effect, graph

CLOUD = {"count": 200, "rate": 0, "set": {"position": {"in_box": {}}, "radius": 0.25}}
LEFT = {"type": "inside_box", "from": "sky", "min": [-5, -5, -5], "max": [0, 5, 5]}
TOP = {"type": "above_plane", "from": "sky"}
MARK = {"type": "set", "set": {"radius": 1}}


def document(nodes, show, emit=CLOUD, **time):
    """Return a graph of nodes on a cloud, in float64."""
    return graph([], emit, {"precision": 64, **time}, {"from": show}, nodes)


def marked(nodes, show, frame=2, **time):
    """Return where the particles are whose radius is 1, and where the others are."""
    found = effect(document(nodes, show, **time)).simulate(frame)["sky"]
    return found["position"][found["radius"] == 1], found["position"][found["radius"] != 1]


def test_selector_in_a_stream_narrows_it():
    """Only what passes the selector is acted on."""
    inside, outside = marked({"left": LEFT, "mark": MARK | {"from": "left"}}, "mark")
    assert (inside[:, 0] <= 0).all() and (outside[:, 0] > 0).all() and 60 < len(inside) < 140


def test_selectors_in_a_row_both_narrow():
    """What passes one and then another has passed both."""
    inside, outside = marked({"left": LEFT, "top": TOP | {"from": "left"}, "mark": MARK | {"from": "top"}}, "mark")
    assert ((inside[:, 0] <= 0) & (inside[:, 1] > 0)).all() and ((outside[:, 0] > 0) | (outside[:, 1] <= 0)).all()


def test_streams_that_merge_hold_what_is_in_either():
    """A list in `from` merges: an operator acts once on each particle that is in any of the streams."""
    nodes = {
        "left": LEFT,
        "top": TOP,
        "mark": {"type": "set", "from": ["left", "top"], "set": {"radius": {"expr": "radius + 0.75"}}},
    }
    inside, outside = marked(nodes, "mark", 1)
    assert ((inside[:, 0] <= 0) | (inside[:, 1] > 0)).all() and ((outside[:, 0] > 0) & (outside[:, 1] <= 0)).all()


def test_streams_that_part_are_of_the_same_particles():
    """A fork narrows: each branch acts on its own, and both see what the other did."""
    nodes = {
        "left": LEFT,
        "top": TOP,
        "a": MARK | {"from": "left"},
        "b": {"type": "set", "from": "top", "set": {"color": [0, 0, 0]}},
    }
    found = effect(document(nodes, ["a", "b"])).simulate(2)["sky"]
    assert np.array_equal(found["radius"] == 1, found["position"][:, 0] <= 0)
    assert np.array_equal(found["color"][:, 0] == 0, found["position"][:, 1] > 0)


@pytest.mark.parametrize(
    "only, passes",
    [
        ({"all": ["left", "top"]}, lambda p: (p[:, 0] <= 0) & (p[:, 1] > 0)),
        ({"any": ["left", {"expr": "position.z > 0"}]}, lambda p: (p[:, 0] <= 0) | (p[:, 2] > 0)),
        ({"not": "left"}, lambda p: p[:, 0] > 0),
        (
            {"all": [{"not": {"inside_sphere": {"radius": 0.5}}}, "left"]},
            lambda p: (np.linalg.norm(p, axis=1) > 0.5) & (p[:, 0] <= 0),
        ),
    ],
)
def test_conditions_combine(only, passes):
    """`all`, `any` and `not` of ids, expressions and inline selectors, nested."""
    inside, outside = marked({"left": LEFT, "top": TOP, "mark": MARK | {"from": "sky", "only": only}}, "mark")
    assert passes(inside).all() and not passes(outside).any() and len(inside) > 5


def test_one_selector_draws_the_same_for_all_who_use_it():
    """A share used in a stream, as `only`, and by a spawn passes the same particles; another node others."""
    nodes = {
        "some": {"type": "share", "from": "sky", "fraction": 0.4},
        "other": {"type": "share", "from": "sky", "fraction": 0.4},
        "a": MARK | {"from": "some"},
        "b": {"type": "set", "from": "sky", "only": "some", "set": {"mass": 5}},
        "c": {"type": "set", "from": "other", "set": {"opacity": 0}},
        "d": {"type": "set", "from": ["a", "b", "c"], "set": {"color": {"expr": "vec(radius, mass, opacity)"}}},
        "kid": {"type": "spawn", "from": "sky", "only": "some", "when": "birth", "inherit": []},
        "kids": {"type": "spawn", "from": "some", "when": "birth", "inherit": []},
    }
    found = effect(document(nodes, ["d", "kid", "kids"])).simulate(2)
    sky = found["sky"]
    chosen = sky["radius"] == 1
    assert np.array_equal(chosen, sky["color"][:, 1] == 5) and 50 < chosen.sum() < 110
    assert not np.array_equal(chosen, sky["opacity"] == 0)
    for name in ("kid", "kids"):
        assert sorted(found[name]["position"].tolist()) == sorted(sky["position"][chosen].tolist())


def light(show, nodes=None):
    """Return the light in a picture, and how much was drawn."""
    film = effect(
        document({"left": LEFT, "top": TOP, **(nodes or {})}, show, CLOUD | {"set": CLOUD["set"] | {"radius": 0.05}})
    ).film(2)
    return film.pixels.tobytes(), film.fragments


def test_picture_shows_what_is_selected_and_once():
    """A selector's stream is drawn alone; listed with its emitter, or twice, or overlapping, nothing is drawn twice."""
    whole, left, top = light("sky"), light("left"), light("top")
    assert 0 < left[1] < whole[1] and 0 < top[1] < whole[1]
    assert light(["left", "sky"]) == light(["sky", "left"]) == whole
    assert light(["left", "left"]) == left
    right = {"right": {"type": "inside_box", "from": "sky", "min": [0, -5, -5], "max": [5, 5, 5]}}
    assert light(["left", "right"], right) == whole
    assert light(["left", "top"])[1] < left[1] + top[1]


def test_nothing_selected_is_nothing_drawn():
    """A selector that nothing passes gives an empty picture, and stops every operator."""
    none = {"none": {"type": "share", "from": "sky", "fraction": 0}}
    assert light("none", none)[1] == 0
    assert len(marked(none | {"mark": MARK | {"from": "none"}}, "mark")[0]) == 0


def test_selection_is_found_as_a_step_starts_and_held():
    """A mover that acts below 0.5 m acts through the step that starts there, and not in the one that starts beyond."""
    rise = {"type": "translate", "from": "sky", "only": {"expr": "position.y < 0.5"}, "rate": [0, 4, 0]}
    for substeps, height in ((1, 1.0), (2, 0.5)):
        found = effect(
            document(
                {"rise": rise},
                "rise",
                {"count": 1, "rate": 0, "set": {"position": {"in_box": {"min": [0, 0, 0], "max": [1, 0, 0]}}}},
                fps=4,
                substeps=substeps,
            )
        ).simulate(4)["sky"]
        assert found["position"][0, 1] == height
