"""What is shipped: a wheel, built from the source distribution, installed far from the checkout."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tarfile
import venv
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.slow

FOUNTAIN = {
    "graphfx": 1,
    "time": {"frames": [1, 3]},
    "nodes": {
        "spring": {"type": "emit", "rate": 500, "life": 1, "set": {"velocity": [0, 3, 0]}},
        "fall": {"type": "stack", "from": "spring", "ops": [{"type": "gravity"}]},
        "view": {"type": "camera"},
        "frames": {"type": "image", "from": "fall", "camera": "view", "size": [32, 18]},
    },
}
Run = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with both distributions; the wheel is built from the source distribution."""
    out = tmp_path_factory.mktemp("dist")
    subprocess.run([sys.executable, "-m", "build", "--no-isolation", "--outdir", str(out), str(ROOT)],
                   check=True, capture_output=True, timeout=300)
    return out


@pytest.fixture(scope="module")
def run(built: Path, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """How to run `graphfx` from the wheel in a clean environment, in a folder of its own."""
    home = tmp_path_factory.mktemp("elsewhere")
    venv.create(home / "venv", with_pip=True)
    programs = home / "venv" / ("Scripts" if os.name == "nt" else "bin")
    wheel = next(built.glob("*.whl"))
    subprocess.run([programs / "python", "-m", "pip", "install", "-q", "--disable-pip-version-check", wheel],
                   check=True, timeout=600)
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "VIRTUAL_ENV")}

    def carry_out(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run([programs / "graphfx", *arguments], cwd=home, env=environment, capture_output=True, text=True,
                              timeout=300)

    carry_out.home = home  # type: ignore[attr-defined]
    return carry_out


def names_in_checkout(*folders: str) -> set[str]:
    return {file.relative_to(ROOT).as_posix() for folder in folders for file in (ROOT / folder).rglob("*")
            if file.is_file() and file.suffix in (".py", ".json")}


def test_source_distribution_is_complete(built: Path) -> None:
    """Whoever has the source distribution can read, build and test it."""
    with tarfile.open(next(built.glob("*.tar.gz"))) as archive:
        inside = {name.partition("/")[2] for name in archive.getnames()}
    wanted = names_in_checkout("graphfx", "nodes", "graphs", "tests")
    wanted |= {"README.md", "LICENSE", "CHANGELOG.md", "CONTRIBUTING.md", "pyproject.toml", "hatch_build.py", ".ci/run"}
    assert sorted(wanted - inside) == []


def test_wheel_holds_the_library_and_nothing_beside_the_package(built: Path) -> None:
    """Nodes and graphs lie in graphfx/bundled, all but the gallery; nothing called `nodes`, `graphs` or `tests` is installed."""
    with zipfile.ZipFile(next(built.glob("*.whl"))) as archive:
        inside = set(archive.namelist())
    assert {name.partition("/")[0].partition("-")[0] for name in inside} == {"graphfx"}
    library = {file.relative_to(ROOT) for folder in ("nodes", "graphs") for file in (ROOT / folder).rglob("*")
               if file.is_file() and "__pycache__" not in file.parts}
    wanted = {f"graphfx/bundled/{file.as_posix()}" for file in library if file.parent != Path("graphs", "gallery")}
    assert {name for name in inside if name.startswith("graphfx/bundled/")} == wanted
    assert names_in_checkout("graphfx") <= inside


def test_wheel_lists_its_own_nodes(run: Run) -> None:
    """`graphfx nodes` finds the library inside the package."""
    result = run("nodes", "vortex")
    assert result.returncode == 0, result.stderr
    assert str(Path("graphfx", "bundled", "nodes", "operators", "vortex.py")) in result.stdout


def test_wheel_checks_and_cooks(run: Run) -> None:
    """From another folder a graph is checked and its frames are written."""
    home: Path = run.home  # type: ignore[attr-defined]
    (home / "fountain.json").write_text(json.dumps(FOUNTAIN))
    checked = run("check", "fountain.json")
    assert (checked.returncode, checked.stdout) == (0, "fountain.json: nothing is wrong\n"), checked.stderr
    cooked = run("cook", "fountain.json")
    assert cooked.returncode == 0, cooked.stderr
    assert sorted(file.name for file in (home / "out" / "fountain").iterdir()) == [f"fountain.{n:04}.png" for n in (1, 2, 3)]


def test_wheel_finds_bundled_groups(run: Run) -> None:
    """A graph may use a group that comes with graphfx."""
    home: Path = run.home  # type: ignore[attr-defined]
    blown = json.loads(json.dumps(FOUNTAIN)) | {"use": {"gust": "groups/gust.json"}}
    blown["nodes"]["fall"]["ops"].append({"type": "gust"})
    (home / "blown.json").write_text(json.dumps(blown))
    checked = run("check", "blown.json")
    assert (checked.returncode, checked.stdout) == (0, "blown.json: nothing is wrong\n"), checked.stderr
