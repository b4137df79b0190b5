"""What Python says of a wrong node file, as its author should read it."""

from __future__ import annotations

import re
import sys
import traceback
from collections.abc import Iterable
from pathlib import Path

import graphfx.math
from graphfx.errors import Location, NodeError, Problem, suggestion

PREFIX = "graphfx_nodes."
"""How the modules of node files are called."""


def in_file(error: BaseException, file: Path) -> NodeError:
    """Return the error for what was raised while a node's file was loaded, at the line of the file where it happened."""
    if isinstance(error, SyntaxError) and _same(error.filename, file):
        place = Location(str(file), error.lineno or 0, error.offset or 0)
        return NodeError(Problem(f"not Python: {error.msg}", place, file.stem))
    return NodeError(Problem(words(error), Location(str(file), _line(error, [file])), file.stem))


def in_a_node(error: BaseException) -> NodeError | None:
    """Return the error for what was raised by a node's function as it ran in plain Python, or None if none was running."""
    nodes = [module for name, module in list(sys.modules.items()) if name.startswith(PREFIX)]
    files = [Path(module.__file__) for module in nodes if module.__file__ is not None]
    for entry in reversed(traceback.extract_tb(error.__traceback__)):
        file = next((file for file in files if _same(entry.filename, file)), None)
        if file is not None:
            return NodeError(Problem(words(error), Location(str(file), entry.lineno or 0), file.stem))
    return None


def words(error: BaseException) -> str:
    """Return what an exception says, with the name that was probably meant."""
    text = str(error)
    if isinstance(error, NameError):
        name, trace = re.search(r"'(\w+)'", text), error.__traceback__
        while trace is not None and trace.tb_next is not None:
            trace = trace.tb_next
        return unknown_name(name[1], trace.tb_frame.f_locals if trace else ()) if name else text
    imported = re.fullmatch(r"cannot import name '(\w+)' from '([\w.]+)'.*", text)
    if isinstance(error, ImportError) and imported:
        near = suggestion(imported[1], _public(vars(sys.modules[imported[2]])) if imported[2] in sys.modules else ())
        return f"{imported[2]} has no '{imported[1]}'.{near}"
    if isinstance(error, AttributeError) and error.name:
        near = suggestion(error.name, _public(dir(error.obj)))
        return f"{text}.{near}"
    if isinstance(error, TypeError):
        return text
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def unknown_name(name: str, beside: Iterable[str] = ()) -> str:
    """Return what to do about a name that a node uses and does not have; `beside` are those that it has."""
    known = _public(vars(graphfx.math))
    if name in known:
        return f"there is no '{name}' here; write: from graphfx.math import {name}"
    if name in ("INFINITY", "operator", "param", "selector", "value", "geometry"):
        return f"there is no '{name}' here; write: from graphfx.node import {name}"
    return f"there is no '{name}' here." + suggestion(name, [*_public(beside), *known])


def _public(names: Iterable[str]) -> list[str]:
    return [name for name in names if not name.startswith("_")]


def _line(error: BaseException, files: list[Path]) -> int:
    entries = traceback.extract_tb(error.__traceback__)
    return next((entry.lineno or 0 for entry in reversed(entries) if any(_same(entry.filename, file) for file in files)), 0)


def _same(name: str | None, file: Path) -> bool:
    return name is not None and (name == str(file) or Path(name).resolve() == file.resolve())
