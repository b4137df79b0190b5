"""What is true of every effect that comes with graphfx; each is found by itself."""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path

import pytest

from graphfx.cli.commands.check import problems_of
from graphfx.graph.document import load_document
from graphfx.graph.format import canonical
from graphfx.plan.listing import plan_data
from tests.pictures import faults_of_kept, is_as_kept

from .goldens import EFFECTS, FOLDER, LIBRARY, SHARE, cooked, data_of, frames_of, pictures, small

AMOUNT = {"type": "float", "default": 1, "min": 0.01, "max": 10, "doc": "Share of the particles."}
effect = cache(small)


@pytest.mark.parametrize("name", EFFECTS)
def test_canonical_and_documented(name: str) -> None:
    """An effect is in canonical form, says in whole sentences what it is and what can be turned, and has its poster's frame."""
    data, first_last = data_of(name), data_of(name)["time"]["frames"]
    assert EFFECTS[name].read_text(encoding="utf-8") == canonical(load_document(EFFECTS[name]), LIBRARY)
    assert data["doc"].rstrip().endswith((".", "]"))
    assert [param for param, said in data["params"].items() if not said.get("doc", "").endswith(".")] == []
    assert data["params"]["amount"] == AMOUNT and 2 <= len(data["params"]) <= 8
    assert first_last[0] <= data["x-poster"] <= first_last[1]
    assert 96 <= first_last[1] - first_last[0] + 1 <= 240


@pytest.mark.parametrize("name", EFFECTS)
def test_nothing_is_wrong(name: str) -> None:
    """`graphfx check` finds nothing wrong."""
    assert problems_of(str(EFFECTS[name]), ()) == []


@pytest.mark.parametrize("name", EFFECTS)
def test_libraries_are_told(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no library for meshes or letters is installed an effect needs none, or says once what brings it."""
    for library in ("trimesh", "fontTools", "mapbox_earcut"):
        monkeypatch.setitem(sys.modules, library, None)
    told = [problem.message.partition("install it by: ")[2] for problem in problems_of(str(EFFECTS[name]), ())]
    assert len(set(told)) == len(told) and set(told) <= {'pip install "graphfx[mesh]"', 'pip install "graphfx[text]"'}


@pytest.mark.parametrize("name", EFFECTS)
def test_plan_is_sound(name: str) -> None:
    """Its image is 1280 x 720, no node is idle, and every particle keeps the tolerance, as far as was tried."""
    plan = plan_data(effect(name).plan)
    assert plan["images"][0]["size"] == [1280 * SHARE, 720 * SHARE]
    assert [node for node in plan["nodes"] if not node["kept"]] == []
    assert [emitter["path"] for emitter in plan["emitters"] if "none tried was accurate enough" in emitter["reason"]] == []


@pytest.mark.parametrize("name", EFFECTS)
def test_pictures_are_as_kept(name: str, tmp_path: Path) -> None:
    """Two small frames are as the pictures beside this file, to one level; one and two threads write the same bytes; no
    particle is lost on the way."""
    one, two = (cooked(effect(name), name, tmp_path / str(threads), threads) for threads in (1, 2))
    made = pictures(name, one)
    assert [kept for kept, picture in made.items() if not is_as_kept(picture, FOLDER / f"{kept}.png")] == []
    assert [report.files[0].read_bytes() for report in one] == [report.files[0].read_bytes() for report in two]
    assert [(report.dropped, report.restless, report.failed, report.warnings) for report in one] == [(0, 0, 0, ())] * len(one)


def test_every_kept_picture_is_of_an_effect() -> None:
    """There is no picture without an effect, no effect without its pictures, and none is large."""
    assert faults_of_kept(FOLDER, {f"{name}.{frame}" for name in EFFECTS for frame in frames_of(name)}) == []
