"""The maps of the nebula: small, and such that no sheet shows where it ends."""

from __future__ import annotations

import numpy as np
import pytest
from PIL import Image

from graphfx.node import bundled_root

TEXTURES = bundled_root() / "graphs/textures"


@pytest.mark.parametrize("name", ["gas", "veil", "star", "pillars"])
def test_nothing_is_opaque_at_a_border(name: str) -> None:
    """A sheet's opacity is nothing all along its border, so that its shape is not seen."""
    with Image.open(TEXTURES / f"{name}_opacity.jpg") as picture:
        grey = np.asarray(picture.convert("L"))
    border = np.concatenate([grey[0], grey[-1], grey[:, 0], grey[:, -1]])
    assert border.max() <= 3
    assert grey.max() > 200


def test_maps_are_small() -> None:
    """All maps together are less than 400 kB."""
    assert sum(path.stat().st_size for path in TEXTURES.glob("*.jpg")) < 400_000
