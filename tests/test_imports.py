"""The shape of the house: imports point one way, files and functions stay short, starting is instant."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "graphfx"

ENGINE = {
    "errors": set(),
    "math": set(),
    "lanes": {"math"},
    "node": {"errors", "math"},
    "geometry": {"errors", "math"},
    "program": {"errors", "math", "node"},
    "graph": {"errors", "math", "node"},
    "store": {"errors", "math", "lanes"},
    "motion": {"math", "program"},
    "plan": {"errors", "math", "node", "program", "graph", "motion"},
    "machine": {"errors", "math", "lanes", "node", "program", "store"},
    "render": {"math", "lanes", "store"},
    "output": {"errors", "store"},
}
AROUND = {
    "cook": set(ENGINE),
    "authoring": {"errors", "node", "graph", "output", "cook"},
    "contract": {"errors", "math", "node", "geometry", "program", "graph", "plan", "cook", "authoring"},
    "study": {"errors", "math", "node", "program", "graph", "motion", "plan", "output", "cook"},
    "cli": {*ENGINE, "cook", "authoring", "study", "graphfx"},
}
ALLOWED: dict[str, set[str]] = {**ENGINE, **AROUND}
"""What each part may import, besides itself."""
LONGEST_FILE, LONGEST_FUNCTION = 299, 49
SLOW_TO_IMPORT = ("numpy", "numba", "llvmlite", "networkx", "PIL", "rich")


def python_files(*folders: str) -> list[Path]:
    return sorted(file for folder in folders for file in (ROOT / folder).rglob("*.py"))


@cache
def tree_of(file: Path) -> ast.Module:
    return ast.parse(file.read_text(encoding="utf-8"))


def imported(file: Path) -> Iterator[tuple[str, int]]:
    """Yield each module that a file imports, wherever in it, with the line."""
    package = file.relative_to(ROOT).parent.parts
    for node in ast.walk(tree_of(file)):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node.lineno) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = [*package[: len(package) - node.level + 1]] if node.level else []
            module = ".".join([*base, *([node.module] if node.module else [])])
            yield module, node.lineno
            if module == "graphfx":
                yield from ((f"graphfx.{alias.name}", node.lineno) for alias in node.names)


def part_of(file: Path) -> str:
    """Return the part of the engine that a file belongs to: its folder, or its own name."""
    first = file.relative_to(PACKAGE).parts[0]
    return first.removesuffix(".py")


def parts_imported(file: Path) -> Iterator[tuple[str, int]]:
    for module, line in imported(file):
        names = module.split(".")
        if names[0] == "graphfx":
            yield (names[1] if len(names) > 1 else "graphfx"), line


@pytest.mark.parametrize("part", sorted(ALLOWED))
def test_imports_point_one_way(part: str) -> None:
    """Each part of the engine imports only the parts before it."""
    wrong = [f"{file.relative_to(ROOT)}:{line} imports {name}" for file in python_files("graphfx") if part_of(file) == part
             for name, line in parts_imported(file) if name not in ALLOWED[part] | {part}]
    assert wrong == []


def test_every_part_has_its_rule() -> None:
    """There is no folder of the engine without a rule, and no rule without a folder."""
    parts = {part_of(file) for file in python_files("graphfx")} - {"__init__", "__main__"}
    assert parts == set(ALLOWED)


def test_rules_have_no_circle() -> None:
    """The parts can be put in an order in which each imports only those before it."""
    assert len(list(TopologicalSorter(ENGINE).static_order())) == len(ENGINE)


def test_nodes_import_only_their_language() -> None:
    """A node's file needs nothing of the engine but `graphfx.node`, `graphfx.math` and, for meshes, `graphfx.geometry`."""
    theirs = ("graphfx.node", "graphfx.math", "graphfx.geometry", "__future__")
    wrong = [f"{file.relative_to(ROOT)}:{line} imports {module}" for file in python_files("nodes")
             for module, line in imported(file) if module not in theirs]
    assert wrong == []


def test_engine_names_no_node_type() -> None:
    """No file of the engine imports a node, by whatever name."""
    wrong = [f"{file.relative_to(ROOT)}:{line}" for file in python_files("graphfx")
             for module, line in imported(file) if module.partition(".")[0] in ("nodes", "graphfx_nodes")]
    assert wrong == []


@pytest.mark.parametrize(("module", "parts"), [
    ("networkx", {"plan"}), ("click", {"cli"}), ("rich", {"cli"}), ("PIL", {"output", "cook"}),
])
def test_libraries_have_their_home(module: str, parts: set[str]) -> None:
    """A library beside NumPy and Numba is imported where it has its work, and nowhere else."""
    found = {part_of(file) for file in python_files("graphfx") for name, _ in imported(file) if name.partition(".")[0] == module}
    assert found <= parts


def test_files_are_short() -> None:
    """A file has fewer than 300 lines."""
    lengths = {str(file.relative_to(ROOT)): len(file.read_text(encoding="utf-8").splitlines())
               for file in python_files("graphfx", "nodes", "tests")}
    assert {name: length for name, length in lengths.items() if length > LONGEST_FILE} == {}


def test_functions_are_short() -> None:
    """A function has fewer than 50 lines, from its `def` to its end."""
    long = {f"{file.relative_to(ROOT)}:{node.lineno} {node.name}": node.end_lineno - node.lineno + 1
            for file in python_files("graphfx", "nodes", "tests") for node in ast.walk(tree_of(file))
            if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and node.end_lineno is not None
            and node.end_lineno - node.lineno + 1 > LONGEST_FUNCTION}
    assert long == {}


def loaded_by(*command: str) -> set[str]:
    """Return the modules that Python has loaded after running some code."""
    code = f"{'; '.join(command)}\nimport sys; print(*sys.modules)"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    return {name.partition(".")[0] for name in result.stdout.splitlines()[-1].split()}


def test_import_is_light() -> None:
    """`import graphfx` loads none of the large libraries."""
    assert loaded_by("import graphfx").isdisjoint(SLOW_TO_IMPORT)


def test_plain_nodes_need_no_compiler() -> None:
    """A node library is loaded, and its functions run in plain Python, without Numba."""
    assert "numba" not in loaded_by("from graphfx.node import Library", "[*Library().values()]")


def test_planning_needs_no_compiler() -> None:
    """A graph is checked and planned without Numba."""
    assert "numba" not in loaded_by("import graphfx.graph.check, graphfx.plan.listing")


def tracked_files() -> list[Path]:
    listed = subprocess.run(["git", "ls-files", "-z"], capture_output=True, text=True, cwd=ROOT)
    if listed.returncode:
        pytest.skip("not a git checkout")
    return [ROOT / name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file()]


FOREIGN = [*(f"{name}/" for name in ("/work", "/tmp", "/root", "/home", "shared")),
           *(f"{name}.md" for name in ("DESIGN", "NUMERICS", "RENDERING"))]
"""Places that exist on one machine only, each put together so that this file does not hold it."""


def test_files_speak_of_no_other_place() -> None:
    """What is committed names no folder of the machine that it was written on."""
    found = []
    for file in tracked_files():
        text = file.read_bytes().decode("utf-8", "ignore")
        found += [f"{file.relative_to(ROOT)}: {word}" for word in FOREIGN if word in text]
    assert found == []
