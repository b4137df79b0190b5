"""The paper's scheme: it grows by its determinant, and so fails where the exact flow does not."""

from __future__ import annotations

import numpy as np
import pytest

from ..motion.one_particle import path

FRAMES = 24


def both(frequency: float, damping: float, apart: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return (P, V) at all frames from (1, 0) and from (0, 1), with the damping in the spring or behind it."""
    ratio = 0.0 if apart else damping / (2 * frequency)
    ops = [{"type": "spring", "frequency": frequency, "damping_ratio": ratio}] + [{"type": "damp", "damping": damping}] * apart
    starts = ((1, 0, 0), (0, 0, 0)), ((0, 0, 0), (1, 0, 0))
    ends = (path(ops, *start, 24, FRAMES, "sims", rest_position=[0, 0, 0]) for start in starts)
    return tuple(np.stack([position[:, 0], velocity[:, 0]]) for position, velocity in ends)  # type: ignore[return-value]


@pytest.mark.parametrize("apart", [False, True])
@pytest.mark.parametrize("product", [0.0, 0.1, 0.5, 0.9])
@pytest.mark.parametrize("angle", [0.05, 0.5, 1.5])
def test_the_paper_grows_by_its_determinant(angle, product, apart):
    """Every step multiplies the area P V' - P' V by (1 - d h) (1 + w^2 h^2 / 2), to 1e-12."""
    one, other = both(angle * 24, product * 24, apart)
    area = one[0] * other[1] - other[0] * one[1]
    steps = area[1:6] / area[:5]
    np.testing.assert_allclose(steps, (1 - product) * (1 + angle**2 / 2), rtol=1e-12)


@pytest.mark.parametrize("angle", [0.01, 0.1, 1.0])
def test_the_paper_does_not_keep_a_swing(angle):
    """After 240 steps an undamped spring's amplitude has grown as (1 + w^2 h^2 / 2)^120: far more than the 1e-11 allowed."""
    w = angle * 24
    ops = [{"type": "spring", "frequency": w, "damping_ratio": 0}]
    position, velocity = path(ops, (1, 0, 0), frames=240, method="sims", rest_position=[0, 0, 0])
    amplitude = np.hypot(position[-1, 0], velocity[-1, 0] / w)
    assert amplitude - 1 > 1e-3
    assert np.log(amplitude) == pytest.approx(120 * np.log1p(angle**2 / 2), rel=angle, abs=2 * angle)
