"""Random numbers: uniform over what they claim, and independent of everything else in the graph."""

from __future__ import annotations

from math import erf

import numpy as np
import pytest

from .effects import bits, effect, graph, particles

COUNT = 40_000


def sample(value, attribute: str = "position", precision: int = 32) -> np.ndarray:
    """Return an attribute of many particles, none of which moves."""
    time = {"fps": 1, "frames": [1, 2], "precision": precision}
    return particles(graph([], {"rate": COUNT, "set": {attribute: value}}, time), 2)[attribute]


def is_uniform(share: np.ndarray, bins: int = 50) -> bool:
    """Return whether numbers are uniform in [0, 1): chi-square within 4 deviations, and none outside."""
    counts, _ = np.histogram(share, bins, (0, 1))
    expected = len(share) / bins
    chi_square = ((counts - expected) ** 2 / expected).sum()
    return counts.sum() == len(share) and abs(chi_square - (bins - 1)) < 4 * np.sqrt(2 * (bins - 1))


def are_independent(first: np.ndarray, second: np.ndarray) -> bool:
    """Return whether pairs of uniform numbers fill the unit square evenly."""
    place = (first * 10).astype(int) * 10 + (second * 10).astype(int)
    return is_uniform((place + 0.5) / 100, 100)


def angle(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the angle about an axis, in turns."""
    return np.arctan2(y, x) / (2 * np.pi) % 1.0


def test_box():
    """Each coordinate is uniform between its corners, independent of the others."""
    shares = (sample({"in_box": {"min": [-1, 2, 0], "max": [3, 2.5, 10]}}) - [-1, 2, 0]) / [4, 0.5, 10]
    assert all(is_uniform(share) for share in shares.T)
    assert are_independent(shares[:, 0], shares[:, 1]) and are_independent(shares[:, 1], shares[:, 2])


def test_ball():
    """Equal volumes hold equally many: (r / R)^3, height and angle are uniform and independent."""
    points = sample({"in_sphere": {"center": [1, 2, 3], "radius": 2}}).astype(float) - [1, 2, 3]
    r = np.linalg.norm(points, axis=1)
    shares = np.minimum((r / 2) ** 3, 1 - 1e-9), points[:, 2] / r / 2 + 0.5, angle(points[:, 0], points[:, 1])
    assert r.max() <= 2 * (1 + 1e-6) and all(is_uniform(share) for share in shares)
    assert (
        are_independent(shares[0], shares[1]) and are_independent(shares[1], shares[2]) and are_independent(shares[0], shares[2])
    )


def test_sphere():
    """Points lie on the surface; height and angle are uniform and independent."""
    points = sample({"on_sphere": {"radius": 3}}).astype(float)
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 3, rtol=1e-6)
    height, turn = points[:, 2] / 6 + 0.5, angle(points[:, 0], points[:, 1])
    assert is_uniform(height) and is_uniform(turn) and are_independent(np.clip(height, 0, 1 - 1e-9), turn)


@pytest.mark.parametrize("axis", [[0, 0, 1], [0, 1, 0], [1, 2, -2]])
def test_disc(axis):
    """Points lie in the plane across the axis; (r / R)^2 and the angle are uniform and independent."""
    n = np.array(axis) / np.linalg.norm(axis)
    points = sample({"in_disc": {"center": [1, 1, 1], "axis": axis, "radius": 2}}).astype(float) - 1
    np.testing.assert_allclose(points @ n, 0, atol=2e-6)
    e1 = np.cross(n, [1, 0, 0] if abs(n[0]) < 0.9 else [0, 1, 0])
    e1 /= np.linalg.norm(e1)
    e2 = np.cross(n, e1)
    area, turn = np.minimum((points**2).sum(1) / 4, 1 - 1e-9), angle(points @ e1, points @ e2)
    assert is_uniform(area) and is_uniform(turn) and are_independent(area, turn)


@pytest.mark.parametrize("degrees", [15, 90, 180])
@pytest.mark.parametrize("direction", [[0, 1, 0], [3, -1, 2]])
def test_cone(degrees, direction):
    """Directions fill the cone evenly in solid angle, at the given length; 180 degrees is all directions."""
    n = np.array(direction) / np.linalg.norm(direction)
    vectors = sample({"in_cone": {"direction": direction, "angle": degrees, "length": 2.5}}).astype(float) / 2.5
    np.testing.assert_allclose(np.linalg.norm(vectors, axis=1), 1, rtol=2e-6)
    cap = np.clip((1 - vectors @ n) / (1 - np.cos(np.radians(degrees))), 0, 1 - 1e-9)
    e1 = np.cross(n, [0, 0, 1])
    e1 /= np.linalg.norm(e1)
    turn = angle(vectors @ e1, vectors @ np.cross(n, e1))
    assert is_uniform(cap) and is_uniform(turn) and are_independent(cap, turn)


def test_gauss():
    """Mean and deviation are as asked, and the distribution's share below x is that of the normal one."""
    values = sample({"gauss": {"mean": 3, "deviation": 2}}, "radius").astype(float)
    assert is_uniform(np.array([0.5 + 0.5 * erf((x - 3) / 2 / np.sqrt(2)) for x in values]))


def test_rand_is_uniform_between_its_ends():
    """Numbers lie evenly from low to high; vectors lie on the segment."""
    assert is_uniform((sample({"rand": [2, 5]}, "radius") - 2) / 3)
    points = sample({"rand": [[0, 0, 1], [1, 2, 1]]})
    assert is_uniform(points[:, 0]) and np.allclose(points, np.stack([points[:, 0], 2 * points[:, 0], np.ones(len(points))], 1))


def test_precisions_draw_the_same_numbers():
    """In 64 bits a draw is within 2^-24 of that in 32."""
    single, double = (sample({"in_box": {"min": [0, 0, 0]}}, precision=bits).astype(float) for bits in (32, 64))
    assert 0 < np.abs(single - double).max() <= 1.5 * 2.0**-24


SETS = {"position": {"in_sphere": {}}, "velocity": {"in_cone": {}}, "radius": {"rand": [0, 1]}, "spiral_axis": {"on_sphere": {}}}
OPS = [{"type": "spiral", "speed": {"rand": [1, 5]}}, {"type": "vortex", "magnitude": {"gauss": {}}}]


def test_inserting_anything_changes_no_number():
    """Operators before, between and after, other emitters, other values and images leave every number as it was."""
    plain = particles(graph(OPS, {"set": SETS}), 8)
    nothing = {"type": "translate", "rate": {"expr": "vec(0, 0, 0) * radius"}}
    ops = [{**nothing, "id": "a"}, OPS[0], {**nothing, "id": "b"}, OPS[1], {"type": "damp", "damping": {"rand": [0, 0]}}]
    nodes = {
        "before": {"type": "emit", "rate": 100, "set": {"position": {"in_sphere": {}}}},
        "frames2": {"type": "image", "from": ["before"], "camera": "view"},
    }
    document = graph(ops, {"set": {"opacity": {"rand": [0, 1]}, **SETS}}, nodes=nodes)
    document["nodes"] = dict(sorted(document["nodes"].items()))
    crowded = particles(document, 8)
    for name in ("radius", "spiral_axis"):
        assert np.array_equal(plain[name], crowded[name])
    for name in ("position", "velocity"):
        np.testing.assert_allclose(crowded[name], plain[name], rtol=0, atol=3e-6)


def test_every_draw_is_its_own():
    """Draws of different parameters, operators, emitters, seeds and particles are all different."""
    ops = [{"type": "vortex", "id": name, "magnitude": {"rand": [0, 1]}} for name in "ab"]
    nodes = {"other": {"type": "emit", "rate": 24, "set": SETS}, "second": {"type": "image", "from": "other", "camera": "view"}}
    found = [effect(graph(ops, {"set": SETS}, nodes=nodes, seed=seed)).simulate(12) for seed in (1, 2)]
    drawn = [number for columns in found for emitter in columns.values() for number in emitter["radius"].tolist()]
    assert len(set(drawn)) == len(drawn) > 40
    sets = {"radius": {"rand": [0, 1]}, "opacity": {"rand": [0, 1]}, "position": {"in_box": {"min": [0, 0, 0]}}}
    columns = particles(graph([], {"set": sets}), 12)
    numbers = [*columns["radius"].tolist(), *columns["opacity"].tolist(), *columns["position"].ravel().tolist()]
    assert len(set(numbers)) == len(numbers) == 60


def test_seed_key_keeps_numbers_where_a_name_changes():
    """A renamed node with the old name as its `seed_key` draws the old numbers."""
    old = particles(graph([{"type": "spiral", "id": "one", "speed": {"rand": [1, 5]}}], {"set": SETS}), 8)
    new = particles(graph([{"type": "spiral", "id": "two", "seed_key": "act/one", "speed": {"rand": [1, 5]}}], {"set": SETS}), 8)
    assert bits({"sky": old}) == bits({"sky": new})


def test_more_particles_change_none():
    """Twice the rate bears the old particles again at even ordinals' times; the k-th draws the k-th numbers."""
    few, many = (particles(graph([], {"rate": rate, "set": SETS}, {"frames": [1, 2], "fps": 1}), 2) for rate in (20, 200))
    for name in ("radius", "spiral_axis"):
        if name in few:
            assert np.array_equal(few[name], many[name][: len(few[name])])
