"""The README says what is so: its commands are run as printed."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


def told_commands() -> list[tuple[str, str]]:
    """Return every command of the README with the output that it states."""
    parts = [part for block in blocks("console") for part in re.split(r"^\$ ", block, flags=re.MULTILINE) if part]
    return [(command, output) for command, _, output in (part.partition("\n") for part in parts)]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the README's graph, and with a `graphfx` that is this one."""
    home = tmp_path_factory.mktemp("readme")
    for name, text in zip(("fountain", "fireworks", "stars", "globe", "swirls"), blocks("json"), strict=True):
        (home / f"{name}.json").write_text(text)
    for name in ("graphfx", "pytest"):
        (home / name).write_text(f'#!/bin/sh\nexec "{sys.executable}" -m {name} "$@"\n')
        (home / name).chmod(0o755)
    return home


@pytest.mark.skipif(os.name == "nt", reason="the commands are for a Unix shell")
@pytest.mark.parametrize(("command", "output"), told_commands())
def test_commands_print_what_is_printed(folder: Path, command: str, output: str) -> None:
    """Each command gives the output shown, where `...` stands for anything."""
    environment = os.environ | {"PATH": f"{folder}:{os.environ['PATH']}", "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    result = subprocess.run(command, shell=True, cwd=folder, env=environment, capture_output=True, text=True)
    said = result.stdout + (result.stderr if result.returncode else "")
    pattern = re.escape(output).replace(re.escape("..."), ".*")
    assert re.fullmatch(pattern, said, re.DOTALL), said


def test_python_runs(folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """The lines of Python run, and print what their comment says."""
    monkeypatch.chdir(folder)
    for code in (block for block in blocks("python") if "import graphfx" in block):
        exec(compile(code, "README.md", "exec"), {})
        assert capsys.readouterr().out.strip() == re.findall(r"print\(.*# (.*)", code)[0]
    assert len(list((folder / "frames").iterdir())) == 4
    assert "built.json: nothing is wrong" in subprocess.run(
        [sys.executable, "-m", "graphfx", "check", "built.json"], capture_output=True, text=True).stdout
    assert (folder / "fountain.png").stat().st_size > 0


def test_node_is_shown_as_it_is() -> None:
    """The node in the README is the node of the library."""
    shown = next(block for block in blocks("python") if "@operator" in block)
    assert shown in (ROOT / "nodes" / "operators" / "vortex.py").read_text()


def test_every_command_and_exit_code_is_told() -> None:
    """The table has every command, and the list every exit code."""
    from graphfx import errors

    commands = {file.stem.replace("_", "-") for file in (ROOT / "graphfx" / "cli" / "commands").glob("[!_]*.py")}
    assert set(re.findall(r"^\| `graphfx ([\w-]+)", README, re.MULTILINE)) == commands
    told = README.partition("## Exit codes")[2].partition("##")[0]
    codes = {value for name, value in vars(errors).items() if name.startswith("EXIT_")}
    assert {int(code) for code in re.findall(r"(?:^|; |\n)(\d+) [a-z]", told)} == codes


@pytest.mark.parametrize("target", re.findall(r"\]\(([^)#]+)\)", README))
def test_links_lead_somewhere(target: str) -> None:
    """What the README links to is there."""
    assert target.startswith("https://") or (ROOT / target).exists()


def test_layout_table_is_the_rule() -> None:
    """The table of folders in CONTRIBUTING.md is what tests/test_imports.py keeps."""
    table = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `graphfx/(\w+)(?:\.py|/)` \| [^|]+ \| ([^|]+) \|$", table, re.MULTILINE)
    source = (ROOT / "tests" / "test_imports.py").read_text(encoding="utf-8")
    engine = eval(re.search(r"ENGINE[^=]* = (\{.*?\n\})", source, re.DOTALL)[1])  # type: ignore[index]
    for name in ("authoring", "contract"):
        engine[name] = eval(re.search(rf'"{name}": (\{{.*?\}})', source)[1])  # type: ignore[index]
    told = {name: {part for part in parts.split(", ") if part != "nothing"} for name, parts in rows}
    assert {name: told[name] for name in engine} == engine
    assert (told["cook"], told["cli"]) == ({"all above"}, {"all"})
