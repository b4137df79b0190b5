"""What is spawned at births, hits and deaths: where, when, how many, with what, and on what it does not depend."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.errors import LimitError

from .effects import effect, graph, particles

RATES = [(24, 1), (10, 2), (7, 1), (60, 1)]
FALL = {"count": 1, "rate": 0, "set": {"position": [0, 1, 0], "velocity": [1, -2, 0], "radius": 0.25}}
CLOUD = {
    "count": 400,
    "rate": 0,
    "life": {"rand": [0.1, 0.4]},
    "set": {"position": {"in_box": {}}, "velocity": {"in_sphere": {}}, "radius": {"rand": [0.1, 0.2]}},
}
FLOOR = {"type": "bounce_plane", "resilience": 0.5}
DRIFT = {"type": "gravity", "acceleration": [0, 0, 0]}


def document(spawn, ops=(DRIFT,), emit=FALL, fps=24, substeps=1, seconds=1.0, show=("it",), nodes=None, **keys):
    """Return a graph in which the spawn `it` takes its parents from the stack, in float64."""
    time = {"fps": fps, "substeps": substeps, "frames": [1, round(fps * seconds) + 1], "precision": 64, **keys.pop("time", {})}
    own = {"it": {"type": "spawn", "from": "act", "life": 9, **spawn}, **(nodes or {})}
    return graph(list(ops), emit, time, {"from": list(show), **keys.pop("image", {})}, own, **keys)


def children(spawn, *given, source="it", **keys):
    """Return what was spawned, at the last frame."""
    found = effect(document(spawn, *given, **keys))
    return found.simulate(found.flat.time.last)[source]


TOLD = {"color": {"expr": "vec(parent.radius, parent.age, parent.velocity.y)"}}


@pytest.mark.parametrize("fps, substeps", RATES)
def test_children_of_a_hit_start_there_and_then(fps, substeps):
    """A splash is born at (0.5, 0, 0) at 0.5 s, and flies on as its parent bounced: at 1 m/s."""
    found = children({"when": "hit", "set": TOLD}, [DRIFT, FLOOR], fps=fps, substeps=substeps)
    np.testing.assert_allclose(found["birth"], [0.5], rtol=0, atol=1e-14)
    np.testing.assert_allclose(found["velocity"], [[1, 1, 0]], rtol=0, atol=1e-14)
    np.testing.assert_allclose(found["position"], [[1, 0.5, 0]], rtol=0, atol=1e-13)
    np.testing.assert_allclose(found["color"], [[0.25, 0.5, 1]], rtol=0, atol=1e-14)


def test_children_are_told_of_the_hit():
    """hit.normal, hit.point and hit.speed are those of the contact, with the speed across the surface alone."""
    tilted = {"type": "bounce_plane", "normal": [1, 1, 0]}
    emit = FALL | {"set": {"position": [1, 1, 0], "velocity": [0, -2, 0]}}
    for value, wanted in (
        ("hit.normal", [0.5**0.5, 0.5**0.5, 0]),
        ("hit.point", [1, -1, 0]),
        ("vec(hit.speed, time, 0)", [2**0.5, 1, 0]),
    ):
        found = children({"when": "hit", "set": {"color": {"expr": value}}}, [DRIFT, tilted], emit, seconds=1.1, fps=10)
        np.testing.assert_allclose(found["color"], [wanted], rtol=0, atol=1e-13)


@pytest.mark.parametrize("fps, substeps", RATES)
def test_children_of_a_death_start_there_and_then(fps, substeps):
    """A parent that dies at 0.3 s leaves its child at (0.3, 0.4, 0), which goes on with its velocity."""
    found = children({"when": "death", "count": 2}, emit=FALL | {"life": 0.3}, fps=fps, substeps=substeps)
    np.testing.assert_allclose(found["birth"], [0.3] * 2, rtol=0, atol=1e-14)
    np.testing.assert_allclose(found["position"], [[1, -1, 0]] * 2, rtol=0, atol=1e-13)


def test_children_of_a_birth_are_born_with_their_parents():
    """Each parent's birth, within frames or at them, is that of its child."""
    found = children({"when": "birth"}, emit=FALL | {"rate": 37, "count": 0})
    np.testing.assert_array_equal(found["birth"], np.arange(38) / 37)


def test_death_is_set_before_children_copy_it():
    """What is set at a death the children have."""
    found = children(
        {"when": "death"}, [DRIFT, {"type": "set", "when": "death", "set": {"radius": {"expr": "time"}}}], FALL | {"life": 0.3}
    )
    np.testing.assert_allclose(found["radius"], [0.3], rtol=0, atol=1e-15)


def test_fractions_of_children_come_in_the_mean():
    """A count of 2.3 gives 2 or 3, in the mean 2.3; a probability of 0.4 gives any at 2 parents of 5."""
    emit = CLOUD | {"count": 4000}
    found = len(children({"when": "birth", "count": {"expr": "radius * 0 + 2.3"}}, emit=emit, seconds=0.05)["position"])
    assert 8000 < found < 12000 and abs(found / 4000 - 2.3) < 4 * np.sqrt(0.21 / 4000)
    found = len(children({"when": "birth", "count": 3, "probability": 0.4}, emit=emit, seconds=0.05)["position"])
    assert found % 3 == 0 and abs(found / 12000 - 0.4) < 4 * np.sqrt(0.24 / 4000)


@pytest.mark.parametrize("count", [0, {"expr": "0 / 0"}, {"expr": "radius - 1"}, {"expr": "0 * mass"}])
def test_no_count_no_children(count):
    """None, less than none, or what is no number: nothing is made."""
    assert children({"when": "birth", "count": count}, emit=CLOUD)["position"].shape == (0, 3)


@pytest.mark.parametrize(
    "many",
    [
        {"when": "birth", "count": 1e18},
        {"when": "birth", "count": {"expr": "1 / 0"}},
        {"rate": 1e18},
        {"rate": {"expr": "1 / 0"}},
    ],
)
def test_too_many_children_are_told(many):
    """What would not fit ends in a message that names the spawn."""
    with pytest.raises(
        LimitError, match=r"nodes\.it: .* particles would be alive at once, and the limit is 100,000,000; lower its count"
    ):
        children(many)


def test_spread_is_uniform_in_a_ball():
    """The velocity that is added fills a ball of 2 m/s: the cube of its length is even, its direction too."""
    found = children({"when": "birth", "count": 20, "spread": 2}, emit=CLOUD | {"set": {"velocity": [5, 0, 0]}}, seconds=0.05)[
        "velocity"
    ] - [5, 0, 0]
    cubes = np.sort(np.linalg.norm(found, axis=1) / 2) ** 3
    assert cubes[-1] <= 1 + 1e-6 and np.abs(cubes - np.arange(8000) / 8000).max() < 1.95 / np.sqrt(8000)
    assert np.abs(found.mean(axis=0)).max() < 4 * np.sqrt(0.8 / 8000)
    np.testing.assert_allclose((found**2).mean(axis=0), 0.8, atol=0.05)


def test_no_two_children_are_the_same():
    """Ids differ among copies, parents, lives, hits, spawns, and where two emitters' parents have the same number."""
    twin = {
        "twin": {"type": "emit", **CLOUD},
        "also": {"type": "spawn", "from": "act", "when": "death", "into": "sky", "generations": 2},
    }
    marks = {"marks": {"type": "random_acceleration", "from": ["it"]}}
    spawn = {"from": ["act", "twin"], "when": "death", "count": 3}
    found = children(spawn, [DRIFT, {"type": "recycle"}], CLOUD, nodes=twin | marks, show=("marks", "twin"))
    assert len(found["id"]) == len(set(found["id"].tolist())) > 4000
    again = children(
        {"when": "hit", "count": 2}, [{"type": "gravity"}, FLOOR], CLOUD | {"life": 9}, nodes=marks, show=("marks",), seconds=2
    )
    assert len(again["id"]) == len(set(again["id"].tolist())) > 800


DRAWN = {
    "when": "death",
    "count": {"rand": [1, 4]},
    "spread": 1,
    "set": {"radius": {"rand": [0, 1]}, "mass": {"gauss": {"mean": {"expr": "parent.radius"}}}},
}
MARKS = {
    "marks": {"type": "set", "from": "it", "set": {"color": {"expr": "vec(radius, mass, age)"}, "opacity": {"rand": [0, 1]}}}
}
COLUMNS = ("position", "velocity", "color", "opacity")


def by_id(found, ids=None):
    """Return the values of each child, by id."""
    rows = zip(found["id"].tolist(), *(found[name].tolist() for name in COLUMNS), strict=True)
    return {row[0]: row[1:] for row in rows if ids is None or row[0] in ids}


def test_one_parent_alone_has_the_children_that_it_has_among_many():
    """Children do not depend on other particles, to the last bit."""
    many, few = (by_id(children(DRAWN, emit=CLOUD | {"count": n}, nodes=MARKS, show=("marks",))) for n in (400, 7))
    assert few and by_id(children(DRAWN, emit=CLOUD, nodes=MARKS, show=("marks",)), few.keys()) == few == {
        key: many[key] for key in few
    }


def test_children_of_a_frame_are_in_order_of_time():
    """Within a frame what is born earlier comes first, whoever its parent is, and copies follow one another."""
    found = children({"when": "death", "count": 2}, emit=CLOUD, fps=1)
    assert (np.diff(found["birth"]) >= 0).all() and np.array_equal(found["birth"][::2], found["birth"][1::2])
    assert len(found["birth"]) == 800


def test_children_do_not_depend_on_another_spawn():
    """A spawn put before or after another changes nothing of what that makes."""
    other = {"other": {"type": "spawn", "from": "sky", "when": "birth", "count": 2, "life": 0.1}}
    plain = by_id(children(DRAWN, emit=CLOUD, nodes=MARKS, show=("marks",)))
    assert by_id(children(DRAWN, emit=CLOUD, nodes=other | MARKS, show=("other", "marks"))) == plain


@pytest.mark.parametrize("fps, substeps", RATES)
def test_children_do_not_depend_on_frames(fps, substeps):
    """Where motion is exact, children are the same at any frames and steps."""
    wanted = by_id(children(DRAWN, emit=CLOUD, nodes=MARKS, show=("marks",), fps=1))
    found = by_id(children(DRAWN, emit=CLOUD, nodes=MARKS, show=("marks",), fps=fps, substeps=substeps))
    assert found.keys() == wanted.keys()
    for key, values in wanted.items():
        for given, value in zip(found[key], values, strict=True):
            np.testing.assert_allclose(given, value, rtol=0, atol=1e-12)


def test_spawn_hears_the_surfaces_that_it_names():
    """Of two spawns on two surfaces each is called by its own; in a corner both are, and the hits are two."""
    wall = {"type": "bounce_plane", "id": "wall", "normal": [1, 0, 0], "point": [-1, 0, 0]}
    other = {"other": {"type": "spawn", "from": "act", "when": {"hit": ["act/wall"]}, "life": 9}}
    emit = FALL | {"set": {"position": [1, 1, 0], "velocity": [-2, -2, 0]}}
    given = ({"when": {"hit": ["act/bounce_plane"]}}, [DRIFT, FLOOR | {"resilience": 1}, wall], emit)
    for source, time in (("it", 0.5), ("other", 1.0)):
        found = children(*given, nodes=other, show=("it", "other"), source=source, seconds=1.2, fps=10)
        np.testing.assert_allclose(found["birth"], [time], rtol=0, atol=1e-14)
    emit, wall = FALL | {"set": {"position": [1, 1, 0], "velocity": [-2, -2, 0]}}, wall | {"point": [0, 0, 0]}
    corner = children({"when": "hit", "set": {"velocity": {"expr": "hit.normal"}}}, [DRIFT, FLOOR, wall], emit)
    np.testing.assert_allclose(sorted(corner["velocity"].tolist()), [[0, 1, 0], [1, 0, 0]])


def test_children_live_as_long_as_they_are_given():
    """A life of their own, or without it the parent's."""
    own = document({"when": "birth", "life": {"expr": "0.25 + parent.radius"}})
    assert [len(particles(own, frame, "it")["position"]) for frame in (12, 13)] == [1, 0]
    two = document({"when": "death"}, emit=FALL | {"life": 0.3})
    del two["nodes"]["it"]["life"]
    for inherit in (["color"], ["life"]):
        two["nodes"]["it"]["inherit"] = inherit
        assert [len(particles(two, frame, "it")["position"]) for frame in (7, 9, 15, 16)] == [0, 1, 1, 0]


def test_children_of_two_emitters_start_at_their_own_parents():
    """A spawn that takes two streams has a child of every parent, where that is."""
    twin = {"twin": {"type": "emit", "count": 1, "rate": 0, "set": {"position": [5, 5, 5], "mass": 7}}}
    found = children(
        {"from": ["act", "twin"], "when": "birth", "set": {"color": {"expr": "vec(parent.mass, 0, 0)"}}},
        nodes=twin,
        show=("it", "twin"),
        seconds=0,
    )
    assert sorted(found["position"].tolist()) == [[0, 1, 0], [5, 5, 5]] and sorted(found["color"][:, 0].tolist()) == [1, 7]


def test_paper_scheme_tells_of_hits_as_steps_end():
    """Under `sims` a hit is at the end of its step: children are born at frame 13, and the parent is bounced once."""
    ops = [DRIFT, {"type": "bounce_plane"}, {"type": "set", "set": {"radius": {"expr": "hits"}}}]
    made = effect(
        document(
            {"when": "hit"},
            ops,
            FALL | {"set": FALL["set"] | {"position": [0, 0.99, 0]}},
            show=("it", "act"),
            time={"method": "sims"},
        )
    )
    found = made.simulate(25)
    assert found["it"]["birth"].tolist() == [0.5] and found["sky"]["radius"].tolist() == [1.0]


@pytest.mark.parametrize("substeps", [1, 2])
def test_hit_at_the_start_of_a_step_is_told_once(substeps):
    """What sticks to the floor and is thrown at it as each step starts hits it once in each step."""
    ops = [{"type": "set", "when": "step", "set": {"velocity": [0, -2, 0]}}, FLOOR | {"response": "stick"}]
    emit = FALL | {"set": {"position": [0, 0.99, 0]}}
    found = children({"when": "hit"}, ops, emit, fps=20, substeps=substeps)["birth"]
    step = 0.05 / substeps
    np.testing.assert_allclose(found, [0.495, *(0.5 + step * np.arange(10 * substeps))], rtol=0, atol=1e-12)
