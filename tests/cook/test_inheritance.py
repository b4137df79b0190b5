"""What a spawn passes on from parent to child."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, bundled_root

LIBRARY = Library([bundled_root()])
PARENT = {"position": [1, 2, 3], "velocity": [0, 1, 0], "radius": {"rand": [3, 4]}, "mass": 5}


def children(**given: Any) -> dict[str, np.ndarray]:
    """Return what a spawn made at the death of two particles, whose radius is 3 to 4 m, after half a second."""
    nodes = {"sky": {"type": "emit", "count": 2, "life": 0.25, "set": PARENT},
             "it": {"type": "spawn", "from": "sky", "when": "death", "life": 9, **given},
             "mark": {"type": "set", "from": "it", "set": {"color": {"expr": "vec(radius, mass, generation)"}}},
             "view": {"type": "camera"}, "frames": {"type": "image", "from": "mark", "camera": "view", "shutter": 0}}
    data = {"graphfx": 1, "time": {"frames": [0, 12], "precision": 64}, "nodes": nodes}
    return Effect(flatten(document_of(data), LIBRARY)).simulate(12)["it"]


def test_a_child_has_all_that_its_parent_had() -> None:
    """Without a list all attributes are copied, and the child is one generation on."""
    found = children()
    assert (found["color"][:, 0] >= 3).all() and (found["color"][:, 1:] == [5, 1]).all()
    np.testing.assert_allclose(found["position"], [[1, 2.5, 3]] * 2, atol=1e-9)


@pytest.mark.parametrize(("inherit", "radius", "mass"), [([], 0.02, 1.0), (["mass"], 0.02, 5.0)])
def test_only_what_is_listed_is_passed_on(inherit: list[str], radius: float, mass: float) -> None:
    """The rest stands at its default; an empty list passes on nothing but the place, where the child rests."""
    found = children(inherit=inherit)
    np.testing.assert_allclose(found["color"], [[radius, mass, 1.0]] * 2)
    np.testing.assert_allclose(found["position"], [[1, 2.25, 3]] * 2, atol=1e-9)


def test_what_reads_itself_reads_the_parents() -> None:
    """`radius / 2` is half of the radius of the child's own parent, and `mass + 1` one more than a mass that is one for all."""
    found = children(set={"radius": {"expr": "radius / 2"}, "mass": {"expr": "mass + 1"}})["color"]
    assert (found[:, 0] >= 1.5).all() and (found[:, 0] < 2).all() and (found[:, 1] == 6).all()
    np.testing.assert_allclose(found[:, 0], children()["color"][:, 0] / 2)


@pytest.mark.parametrize("by", ["turn", "nearest"])
def test_children_and_their_children_are_in_the_clusters_of_their_parents(by: str) -> None:
    """The number is the parent's, in what is set at birth, in operators, and in what they make in turn."""
    nodes = {"sky": {"type": "emit", "count": 30, "life": 0.25, "clusters": {"part": {"count": 4, "by": by}},
                     "set": {"position": {"in_box": {}}, "mass": {"expr": "part"}}},
             "one": {"type": "spawn", "from": "sky", "when": "death", "life": 0.1},
             "two": {"type": "spawn", "from": "one", "when": "death", "life": 9, "set": {"radius": {"expr": "part"}}},
             "mark": {"type": "set", "from": "two", "set": {"color": {"expr": "vec(radius, mass, part)"}}},
             "view": {"type": "camera"}, "frames": {"type": "image", "from": "mark", "camera": "view", "shutter": 0}}
    data = {"graphfx": 1, "time": {"frames": [0, 12], "precision": 64}, "nodes": nodes}
    found = Effect(flatten(document_of(data), LIBRARY)).simulate(12)["two"]["color"]
    assert set(found[:, 1]) == {0.0, 1.0, 2.0, 3.0}
    np.testing.assert_array_equal(found[:, [0, 2]], found[:, [1, 1]])


def test_what_a_parent_found_of_its_own_attributes_stays_the_parents() -> None:
    """A radius that is twice the mass of the parent, one for all, is not twice the mass that the child is given."""
    nodes = {"sky": {"type": "emit", "count": 2, "life": 0.25, "set": {"mass": 2, "radius": {"expr": "mass * 2"}}},
             "it": {"type": "spawn", "from": "sky", "when": "death", "life": 9,
                    "set": {"mass": 7, "position": {"expr": "rest_position + vec(0, radius, 0)"}}},
             "mark": {"type": "set", "from": "it", "set": {"color": {"expr": "vec(radius, mass, 0)"}}},
             "early": {"type": "set", "from": "sky", "when": "birth", "only": {"expr": "birth.mass > 1 and type == 0"},
                       "set": {"fade_color": {"expr": "vec(lives, hits, birth.radius)"}}},
             "view": {"type": "camera"}, "frames": {"type": "image", "from": ["mark", "early"], "camera": "view", "shutter": 0}}
    data = {"graphfx": 1, "time": {"frames": [0, 12], "precision": 64}, "nodes": nodes}
    found = Effect(flatten(document_of(data), LIBRARY)).simulate(12)["it"]
    np.testing.assert_array_equal(found["color"], [[4, 7, 0]] * 2)
    np.testing.assert_array_equal(found["position"], [[0, 4, 0]] * 2)


def test_generations_are_counted_through_a_stream_between() -> None:
    """What joins its grandparents' emitter, by way of a stream of its own, is two generations on, and ends at the limit."""
    nodes = {"sky": {"type": "emit", "count": 1, "life": 0.1},
             "one": {"type": "spawn", "from": "sky", "when": "death", "life": 0.05},
             "two": {"type": "spawn", "from": "one", "when": "death", "into": "sky", "life": 0.1, "generations": 4},
             "mark": {"type": "set", "from": "sky", "set": {"radius": {"expr": "generation"}}},
             "view": {"type": "camera"}, "frames": {"type": "image", "from": "mark", "camera": "view", "shutter": 0}}

    def generations(frame: int) -> list[float]:
        data = {"graphfx": 1, "time": {"frames": [0, frame], "precision": 64}, "nodes": nodes}
        return list(Effect(flatten(document_of(data), LIBRARY)).simulate(frame)["sky"]["radius"])

    assert [generations(frame) for frame in (1, 5, 9, 13)] == [[0.0], [2.0], [4.0], []]
