"""Tails: where a particle was when the shutter opened."""

from __future__ import annotations

import numpy as np
import pytest

from .effects import made, particles

SETS = {"position": {"in_box": {}}, "velocity": {"in_box": {"min": [-3, 1, 0]}}}


@pytest.mark.parametrize("preroll", [0, 0.01, 0.5])
@pytest.mark.parametrize("substeps", [1, 2, 3, 7])
@pytest.mark.parametrize("shutter", [0.3, 0.5, 1.0])
def test_tail_of_free_flight(shutter, substeps, preroll):
    """The tail is head - velocity x shutter, of those born before the opening; of others it is where they were born."""
    time = {"fps": 24, "frames": [1, 6], "substeps": substeps, "precision": 64, "preroll": preroll}
    found = made([], {"rate": 100, "life": 9, "set": SETS}, time, {"shutter": shutter})
    for frame in (1, 2, 6):
        columns = found.simulate(frame)["sky"]
        now = (frame - 1) / 24
        lived = np.minimum(now - columns["birth"], min(shutter / 24, now + preroll))
        velocity = columns["velocity"] if "velocity" in columns else np.array([0.5, 1, -0.25])
        np.testing.assert_allclose(columns["tail"], columns["position"] - velocity * lived[:, None], rtol=0, atol=1e-13)


@pytest.mark.parametrize("substeps", [1, 4])
def test_tail_under_gravity(substeps):
    """Within the step of the opening the way is taken as straight; at a step's border the tail is exact."""
    time = {"fps": 10, "frames": [1, 6], "substeps": substeps, "precision": 64}
    columns = particles(made([{"type": "gravity"}], {"rate": 1, "set": SETS}, time, {"shutter": 0.5}), 6)
    head, velocity = columns["position"][0], columns["velocity"][0]
    t, g = 0.05, np.array([0, -9.81, 0])
    exact = head - velocity * t + g * t * t / 2
    chord = head - velocity * 0.1 + g * 0.1 * 0.1 / 2
    wanted = exact if substeps == 4 else (head + chord) / 2
    np.testing.assert_allclose(columns["tail"][0], wanted, rtol=0, atol=1e-13)


def test_tail_of_a_bounce_and_of_rest():
    """A tail from before a bounce lies on the way down; a particle at rest has its tail in its place."""
    ops = [{"type": "bounce_plane", "resilience": 1}]
    emit = {"rate": 1, "set": {"position": [0, 1, 0], "velocity": [0, -4, 0]}}
    time = {"fps": 4, "frames": [1, 3], "precision": 64, "substeps": 2}
    columns = particles(made(ops, emit, time | {"fps": 3}, {"shutter": 1}), 2)
    np.testing.assert_allclose([columns["position"][0, 1], columns["tail"][0, 1]], [1 / 3, 1], rtol=0, atol=1e-13)
    columns = particles(made(ops, emit, time | {"fps": 3}, {"shutter": 0.4}), 2)
    np.testing.assert_allclose(columns["tail"][0, 1], 0.2, rtol=0, atol=1e-13)
    columns = particles(made([ops[0] | {"resilience": 0, "friction": 1}], emit, time, {"shutter": 1}), 3)
    assert (columns["position"][0] == columns["tail"][0]).all() and abs(columns["tail"][0, 1]) <= 1e-15


def test_flows_have_tails():
    """Particles that only a vortex or an applied velocity moves are streaked too."""
    for op, back in (({"type": "translate", "rate": [2, 0, 0]}, 0.05), ({"type": "vortex", "magnitude": 1}, None)):
        emit = {"rate": 1, "set": {"position": [1, 0, 0], "velocity": [0, 0, 0]}}
        columns = particles(made([op], emit, {"fps": 20, "frames": [1, 5], "precision": 64}, {"shutter": 0.5}), 5)
        away = columns["position"][0] - columns["tail"][0]
        assert np.linalg.norm(away) == pytest.approx(back or 0.025, rel=1e-3)


def test_images_with_shutters_of_their_own():
    """Each of two images shows the streaks of its own shutter."""
    nodes = {"still": {"type": "image", "from": "sky", "camera": "view", "shutter": 0.1, "size": [64, 64]}}
    emit = {"rate": 1, "set": {"position": [0, 2, 0], "velocity": [60, 0, 0], "radius": 0.3}}
    camera = {"type": "camera", "position": [4, 2, 14], "target": [4, 2, 0], "projection": "orthographic", "view_width": 16}
    found = made([], emit, {"fps": 10, "frames": [1, 2]}, {"shutter": 1.0, "size": [64, 64]}, {**nodes, "view": camera})
    widths = [int((found.film(2, image=k).pixels[..., 3].max(axis=0) > 0).sum()) for k in range(2)]
    order = [image.node.path for image in found.plan.images]
    assert widths[order.index("frames")] > 3 * widths[order.index("still")]


@pytest.mark.parametrize("substeps", [1, 2, 4])
def test_sources_with_shutters_of_their_own(substeps):
    """Each source keeps its places for the pictures that draw it alone, in the step in which their shutter opens."""
    nodes = {
        "other": {"type": "emit", "rate": 20, "set": {"velocity": [2, 0, 0]}},
        "second": {"type": "image", "from": "other", "camera": "view", "shutter": 0.3},
    }
    time = {"fps": 10, "frames": [1, 6], "precision": 64, "substeps": substeps}
    found = made([], {"rate": 1, "set": SETS}, time, {"shutter": 0.9}, nodes).simulate(6)
    for path, shutter in (("sky", 0.9), ("other", 0.3)):
        old = slice(0, 1)
        velocity = found[path].get("velocity", np.array([[2.0, 0, 0]]))[old]
        np.testing.assert_allclose(found[path]["tail"][old], found[path]["position"][old] - velocity * shutter / 10, atol=1e-13)


def test_shutter_by_keys():
    """A shutter that changes from frame to frame draws each frame's own streaks."""
    emit = {"rate": 0, "count": 1, "set": {"position": [0, 2, 0], "velocity": [60, 0, 0], "radius": 0.3}}
    camera = {"type": "camera", "position": [8, 2, 14], "target": [8, 2, 0], "projection": "orthographic", "view_width": 32}
    image = {"shutter": {"keys": [[0, 0], [0.2, 2]]}, "size": [64, 64], "camera": "side"}
    found = made([], emit, {"fps": 10, "frames": [1, 3]}, image, {"side": camera})
    widths = [int((found.film(frame).pixels[..., 3].max(axis=0) > 0).sum()) for frame in (1, 2, 3)]
    assert [abs(width - 2 * 6 * shutter) <= 3 for width, shutter in zip(widths, (0, 1, 2), strict=True)] == [True] * 3
