"""The library that the tests of the language use: its own small node types, and the language's."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from graphfx.node import Library, bundled_root

HERE = Path(__file__).parent
LANGUAGE = ("emitters/emit", "emitters/spawn", "operators/stack", "operators/set", "operators/fade", "operators/kill",
            "operators/recycle", "renders/camera", "renders/image")


@pytest.fixture(scope="session")
def library(tmp_path_factory: pytest.TempPathFactory) -> Library:
    """Node types that no shipped library can change: `library/` beside this file, and the language nodes."""
    root = tmp_path_factory.mktemp("language")
    for name in LANGUAGE:
        target = root / "nodes" / f"{name}.py"
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(bundled_root() / "nodes" / f"{name}.py", target)
    return Library([HERE / "library", root])
