"""The page of test pictures is drawn as it was, small; what it claims to measure holds."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.cook.demo import picture_name
from graphfx.graph.document import load_document
from graphfx.graph.format import canonical
from tests.pictures import faults_of_kept, is_as_kept

from .goldens import DEMOS, FOLDER, LIBRARY, drawn


@pytest.mark.parametrize("name", DEMOS)
def test_pictures_are_as_kept(name: str) -> None:
    """Every image of a demo is as its small picture beside this file, to one level."""
    demo = DEMOS[name]
    for image, picture in drawn(demo).stills.items():
        assert is_as_kept(picture, FOLDER / f"{picture_name(demo, image)}.png")


def test_every_kept_picture_is_of_a_demo() -> None:
    """There is no picture without a demo, nor a large one."""
    names = {picture_name(demo, image) for demo in DEMOS.values() for image in drawn(demo).stills}
    assert faults_of_kept(FOLDER, names) == []


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
