"""Attributes that operators read and that are set while a particle lives act from where they are set."""

from __future__ import annotations

import numpy as np
import pytest

from .one_particle import path

AXIS = {"type": "set", "when": "step", "set": {"spiral_axis": {"expr": "vec(1, 0, 0) if time > 0.4 else vec(0, 1, 0)"}}}
PLACE = {"type": "set", "when": "step", "set": {"rest_position": {"expr": "vec(time, 1, 0)"}}}
STACKS = {
    "spiral": [AXIS, {"type": "spiral", "speed": 5}],
    "spring": [PLACE, {"type": "spring", "frequency": 5}],
    "damping by an attribute": [
        {"type": "set", "when": "step", "set": {"mass": {"expr": "1 + time"}}},
        {"type": "damp", "damping": {"expr": "mass"}},
        {"type": "gravity"},
    ],
    "fading spring": [{"type": "fade", "rate": 2, "set": {"rest_position": [3, 0, 0]}}, {"type": "spring", "frequency": 5}],
}


@pytest.mark.parametrize("name", STACKS)
def test_steps_in_a_frame_are_frames(name):
    """Four steps in a frame give what four times the frames give: every step takes what the attribute is then."""
    born = {"rest_position": [1, 0, 0], "spiral_axis": [0, 1, 0]}
    ends = [path(STACKS[name], (0, 1, 0), (1, 0, 0.5), 24 * n, 24 * n, substeps=4 // n, **born) for n in (1, 4)]
    for one, other in zip(*ends, strict=True):
        np.testing.assert_allclose(one[-1], other[-1], rtol=0, atol=1e-12)


def test_what_counts_hits_changes_at_the_hit():
    """A parameter that reads `hits` is another one from the instant of contact on, however long the frames are."""
    ops = [
        {"type": "translate", "rate": {"expr": "vec(hits % 3 - 1, 0, 0)"}},
        {"type": "gravity"},
        {"type": "bounce_plane", "resilience": 0.8},
    ]
    ends = [path(ops, (0, 1, 0), (0, 0, 0), fps, 2 * fps) for fps in (1, 24)]
    for one, other in zip(*ends, strict=True):
        np.testing.assert_allclose(one[-1], other[-1], rtol=0, atol=1e-9)
    paces = np.diff(ends[1][0][:, 0]) * 24
    assert {-1, 0, 1} <= {round(pace, 9) for pace in paces}
