"""What children know of their parents, and children of children."""

from __future__ import annotations

import numpy as np

from .test_spawns import DRIFT, FALL, children


def test_rockets_of_rockets_end_at_their_generation():
    """With `into`, three at each death, generations of 3 s / 10 end after the second: 1, 3, 9, none."""
    emit = {"count": 1, "rate": 0, "life": 0.3, "set": {"position": [0, 0, 0]}}
    count = {"type": "set", "from": "sky", "set": {"radius": {"expr": "generation"}}}
    for seconds, number, generation in ((0.2, 1, 0), (0.5, 3, 1), (0.8, 9, 2), (1.1, 0, 3)):
        found = children(
            {"from": "sky", "when": "death", "count": 3, "life": 0.3, "into": "sky", "generations": 2},
            (),
            emit,
            10,
            seconds=seconds,
            nodes={"count": count},
            show=("count",),
            source="sky",
        )
        assert found["radius"].tolist() == [generation] * number


def test_inherited_values_are_the_parents_own():
    """A radius that is a tenth of the mass stays the parent's where the child has another mass."""
    emit = {"count": 1, "rate": 0, "set": {"position": [1, 2, 3], "mass": 2, "radius": {"expr": "mass / 10"}}}
    show = {"show": {"type": "set", "from": "it", "set": {"color": {"expr": "vec(radius, mass, rest_position.y)"}}}}
    found = children({"when": "birth", "set": {"mass": 5, "position": {"in_box": {}}}}, emit=emit, nodes=show, show=("show",))
    np.testing.assert_allclose(found["color"], [[0.2, 5, 2]])


def test_children_know_of_the_lives_of_their_parents():
    """parent.lives counts the lives before the one that ended; their own lives are none."""
    show = {"show": {"type": "set", "from": "it", "set": {"color": {"expr": "vec(radius, lives, 0)"}}}}
    found = children(
        {"when": "death", "set": {"radius": {"expr": "parent.lives"}}},
        [DRIFT, {"type": "recycle"}],
        FALL | {"life": 0.3},
        nodes=show,
        show=("show",),
    )
    assert found["color"][:, :2].tolist() == [[0, 0], [1, 0], [2, 0]]


def test_own_attribute_of_children_reads_a_parent_among_themselves():
    """Where children join their parents, what they read of them is stored, though nobody else reads it."""
    emit = {"count": 5, "rate": 0, "life": 0.1, "set": {"mass": {"rand": [1, 2]}}}
    spawn = {"from": "sky", "when": "death", "into": "sky", "set": {"heat": {"expr": "parent.mass * 2"}}}
    own = {"heat": {"type": "float", "default": 0}}
    show = {"show": {"type": "set", "from": "sky", "set": {"radius": {"expr": "heat"}}}}
    found = children(spawn, (), emit, nodes=show, show=("show",), source="sky", attributes=own)
    assert found["radius"].min() >= 2 and len(set(found["radius"].tolist())) == 5


def test_parents_of_two_emitters_have_children_independently():
    """The first particles of two emitters do not share the draw that says whether they have children."""
    numbered = {"count": 100, "rate": 0, "clusters": {"turn": {"count": 100}}, "set": {"mass": {"expr": "turn"}}}
    twin = {"twin": {"type": "emit", **numbered, "set": {"mass": {"expr": "turn"}, "radius": 7}}}
    spawn = {
        "from": ["act", "twin"],
        "when": "birth",
        "probability": 0.5,
        "set": {"color": {"expr": "vec(parent.mass, parent.radius, 0)"}},
    }
    found = children(spawn, emit=numbered, nodes=twin, show=("it", "twin"))["color"]
    first, second = (set(found[(found[:, 1] == 7) == other, 0].tolist()) for other in (False, True))
    assert 30 < len(first & second) + len(set(range(100)) - first - second) < 70
