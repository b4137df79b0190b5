"""Clusters: particles told apart in turn or by the nearest seed, and what is drawn once for each."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.plan.make import make_plan

from .effects import effect, graph

BOX = {"in_box": {"min": [-3, -1, -1], "max": [3, 1, 1]}}


def cloud(sets, count=300, clusters=None, ops=(), frame=1, simulation=False, emit=None, **time):
    """Return a cloud of particles in clusters, at a frame."""
    told = clusters or {"spot": {"count": 7, "by": "nearest"}, "turn": {"count": 5}}
    source = {"count": count, "rate": 0, "clusters": told, "set": {"position": BOX, **sets}, **(emit or {})}
    found = effect(graph(list(ops), source, {"precision": 64} | time))
    if not simulation:
        return found.simulate(frame)["sky"]
    made = found.simulation()
    list(made.frames(frame))
    return made.particles["sky"]


def test_turn_goes_round():
    """In turn the particles are numbered 0 to 4, again and again in order of birth."""
    assert cloud({"radius": {"expr": "turn"}})["radius"].tolist() == [k % 5 for k in range(300)]


@pytest.mark.parametrize("precision", [32, 64])
def test_nearest_is_the_nearest_seed(precision):
    """A particle is in the cluster whose seed is nearest, and the seeds lie where particles may."""
    found = cloud({"radius": {"expr": "spot"}}, simulation=True, precision=precision)
    places, seeds = np.stack(found.store.column("position"), 1).astype(float), found.seeds["spot"]
    distance = np.linalg.norm(places[:, None] - seeds, axis=2)
    assert found.store.column("radius")[0].tolist() == distance.argmin(axis=1).tolist()
    assert seeds.shape == (7, 3) and (np.abs(seeds) <= [3, 1, 1]).all() and len(np.unique(seeds, axis=0)) == 7
    assert len(set(distance.argmin(axis=1))) >= 6


@pytest.mark.parametrize("name, count", [("spot", 7), ("turn", 5)])
def test_draw_of_a_cluster_is_one_for_all_in_it(name, count):
    """`per` a cluster draws one number for each, and another for another; vectors and nodes too."""
    found = cloud(
        {
            "radius": {"rand": [0, 1], "per": name},
            "color": {"expr": f"vec({name}, 0, 0)"},
            "velocity": {"in_sphere": {}, "per": name},
        }
    )
    members = found["color"][:, 0]
    for values in (found["radius"], found["velocity"][:, 1]):
        each = [set(values[members == k].tolist()) for k in set(members.tolist())]
        assert all(len(drawn) == 1 for drawn in each) and len(set.union(*each)) == len(each) <= count


def test_vary_is_a_little_by_particle():
    """`vary` 0.1 moves each particle by at most a tenth of the range from what its cluster drew, and both ways."""
    plain, varied = (cloud({"radius": {"rand": [10, 20], "per": "turn", **more}})["radius"] for more in ({}, {"vary": 0.1}))
    apart = varied - plain
    assert np.abs(apart).max() <= 1 and len(set(varied.tolist())) == 300 and apart.min() < -0.1 and apart.max() > 0.1


@pytest.mark.parametrize("name", ["spot", "turn"])
def test_clusters_do_not_depend_on_the_number_of_particles(name):
    """Of 300 particles the first 20 are what 20 alone are: seeds and draws are the clusters' own."""
    sets = {"radius": {"rand": [0, 1], "per": name}, "mass": {"expr": name}, "color": {"expr": f"vec(mass, {name}, 0)"}}
    few, many = cloud(sets, 20), cloud(sets, 300)
    assert all(np.array_equal(few[key], many[key][:20]) for key in few)


def test_seeds_of_two_clusters_differ():
    """Two sets of as many seeds are drawn apart."""
    both = {"a": {"count": 7, "by": "nearest"}, "b": {"count": 7, "by": "nearest"}}
    found = cloud({"color": {"expr": "vec(a, b, 0)"}}, clusters=both, simulation=True)
    assert not set(map(tuple, found.seeds["a"])) & set(map(tuple, found.seeds["b"]))


def test_operators_draw_per_cluster():
    """A draw per cluster in an operator holds for all its particles, in later frames too."""
    push = {"type": "translate", "rate": {"in_sphere": {}, "per": "turn"}}
    found = cloud(
        {"color": {"expr": "vec(turn, 0, 0)"}},
        ops=[
            push,
            {"type": "set", "set": {"rest_position": {"expr": "position - birth.position"}}},
            {"type": "set", "id": "b", "set": {"velocity": {"expr": "rest_position"}}},
        ],
        frame=4,
    )
    moved = {tuple(np.round(row, 9)) for row in found["velocity"].tolist()}
    assert len(moved) == 5


def test_life_begun_again_keeps_its_turn_and_finds_its_nearest_seed():
    """A recycled particle keeps its number in turn."""
    ops = [{"type": "recycle"}, {"type": "set", "set": {"color": {"expr": "vec(turn, lives, 0)"}}}]
    found = cloud({}, ops=ops, frame=9, emit={"life": 0.1})
    assert found["color"][:, 0].tolist() == [k % 5 for k in range(300)] and set(found["color"][:, 1].tolist()) == {3.0}


def test_one_cluster_and_more_clusters_than_particles():
    """A cluster of one holds all; of a thousand seeds most hold none."""
    assert set(
        cloud({"radius": {"expr": "a"}}, clusters={"a": {"count": 1, "by": "nearest"}}).get("radius", np.zeros(1)).tolist()
    ) == {0.0}
    assert len(set(cloud({"radius": {"expr": "a"}}, 9, {"a": {"count": 1000, "by": "nearest"}})["radius"].tolist())) == 9


def test_nobody_need_read_what_a_cluster_sets():
    """With nothing left out, a value per cluster of an attribute that nobody reads is planned as well."""
    fade = {"type": "fade", "set": {"mass": {"rand": [0, 5], "per": "turn"}}}
    flat = effect(graph([{"type": "gravity"}, fade], {"clusters": {"turn": {"count": 2}}})).flat
    assert "turn" in make_plan(flat, prune=False).emitters["sky"].attributes.columns
    assert "turn" not in make_plan(flat).emitters["sky"].attributes.columns
