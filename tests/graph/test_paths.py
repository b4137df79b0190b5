"""No path of a graph leaves its folder and the libraries' `graphs/`."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphfx.graph.check import check
from graphfx.graph.document import document_of
from graphfx.graph.paths import PathRefused, find_file
from graphfx.node import Library

ESCAPES = [
    "../secret.json", "..", "../", "./../secret.json", "inner/../../secret.json", "inner/../secret.json", "inner/..",
    "a/b/../../../secret.json",
    "/etc/passwd", "//etc/passwd", "///etc/passwd", "/proc/self/environ", "/dev/stdin", "~/secret.json", "~root/secret.json", "~",
    "..\\secret.json", "inner\\..\\..\\secret.json", "\\\\server\\share\\a.json", "\\secret.json", "C:\\secret.json",
    "C:/secret.json",
    "C:secret.json", "file:///etc/passwd", "http://example.org/a.json", "https:a.json", "data:text/plain,a", "%2e%2e/secret.json",
    "..%2fsecret.json", "$HOME/secret.json", "${HOME}/secret.json", "%USERPROFILE%/a.json", "inner/./a.json",
    "inner//a.json", "./a.json",
    ".", "", " ", "a.json\x00", "a\n.json", "\u202esecret.json", "a.json ", " ../secret.json", "inner /../a.json",
    "... /a.json", ".../a.json",
    "a.json.", "con", "nul.json", "inner/COM1.json", "*.json", "a?.json", "a.json|b", "<a.json", "a.json:stream", "inner",
    "link.json",
    "linked/secret.json", "a" * 2000, "b/" * 900 + "a.json", "missing.json", "pipe.json",
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A graph's folder with links that lead out of it, and a secret beside it."""
    import os

    outside = tmp_path_factory.mktemp("outside")
    inside = outside / "graphs"
    (inside / "inner").mkdir(parents=True)
    for file in (outside / "secret.json", inside / "a.json", inside / "inner/a.json"):
        file.write_text('{"graphfx": 1, "nodes": {}}')
    (inside / "link.json").symlink_to(outside / "secret.json")
    (inside / "linked").symlink_to(outside)
    (inside / "circle.json").symlink_to(inside / "circle.json")
    os.mkfifo(inside / "pipe.json")
    return inside


@pytest.mark.parametrize("path", [*ESCAPES, "circle.json"])
def test_forms_of_escape_are_refused(path: str, folder: Path, library: Library) -> None:
    """A path that is absolute, climbs, hides, or leads out by a link is refused as a problem of the graph."""
    problems = check(document_of({"graphfx": 1, "use": {"group": path}, "nodes": {}}, folder=folder), library)
    assert [problem.path for problem in problems] == ["use.group"]


def test_there_are_many_forms_of_escape() -> None:
    """At least thirty forms are tried."""
    assert len(ESCAPES) >= 30


@pytest.mark.parametrize("path", ["a.json", "inner/a.json"])
def test_files_beside_the_graph_are_found(path: str, folder: Path) -> None:
    """A plain path names a file of the folder."""
    assert find_file(path, [folder]) == folder / path


def test_the_graphs_folder_comes_before_the_libraries(folder: Path) -> None:
    """Of two files of one name the first folder's is taken."""
    assert find_file("a.json", [folder / "inner", folder]) == folder / "inner/a.json"


def test_a_link_that_stays_inside_is_followed(folder: Path, tmp_path: Path) -> None:
    """Only what a path leads to counts, not that it is a link."""
    (tmp_path / "real.json").write_text("{}")
    (tmp_path / "link.json").symlink_to("real.json")
    assert find_file("link.json", [tmp_path]) == tmp_path / "link.json"


def test_a_text_without_a_folder_reads_only_libraries(library: Library) -> None:
    """A graph that came from no file may use the libraries' groups and nothing else."""
    problems = check(document_of({"graphfx": 1, "use": {"group": "conftest.py"}, "nodes": {}}), library)
    assert "there is no file 'conftest.py'" in problems[0].message


def test_a_refused_path_names_no_folder_outside(folder: Path) -> None:
    """The message of a link that leads out does not say where to."""
    with pytest.raises(PathRefused) as caught:
        find_file("link.json", [folder])
    assert "secret" not in str(caught.value)
