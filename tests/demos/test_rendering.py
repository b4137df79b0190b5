"""The page of test pictures is drawn as it was, small; what it claims to measure holds."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.graph.document import load_document
from graphfx.graph.format import canonical

from .goldens import DEMOS, FOLDER, LEVELS, LIBRARY, drawn, kept


@pytest.mark.parametrize("name", DEMOS)
def test_pictures_are_as_kept(name: str) -> None:
    """Every image of a demo is as its small picture beside this file, to one level."""
    demo = DEMOS[name]
    for image, picture in drawn(demo).stills.items():
        wanted = kept(demo, image)
        assert picture.shape == wanted.shape
        assert np.abs(picture.astype(int) - wanted).max() <= LEVELS


def test_every_kept_picture_is_of_a_demo() -> None:
    """There is no picture without a demo, nor a large one."""
    names = {f"{name}.{image}.png" for name, demo in DEMOS.items() for image in drawn(demo).stills}
    assert {file.name for file in FOLDER.glob("*.png")} == names
    assert max(file.stat().st_size for file in FOLDER.glob("*.png")) < 20_000


def test_dust_does_not_flicker() -> None:
    """The light of a moving particle with a tenth of a pixel for a radius varies by less than 1 %, that of a swarm too."""
    light = drawn(DEMOS["dust"]).light
    assert light.keys() == {"frames", "one"}
    for series in light.values():
        assert len(series) == 48
        assert (max(series) - min(series)) / np.mean(series) < 0.01


@pytest.mark.parametrize("name", DEMOS)
def test_graphs_are_canonical_and_documented(name: str) -> None:
    """Each graph is in canonical form and says what it shows, and so does each of several images."""
    demo = DEMOS[name]
    assert demo.file.read_text() == canonical(load_document(demo.file), LIBRARY)
    assert demo.title and demo.caption.endswith(".")
    images = [node for node in load_document(demo.file).root.data()["nodes"].values() if node["type"] in ("image", "preview")]
    assert len(images) == 1 or all(image.get("doc") or "frames" for image in images)
