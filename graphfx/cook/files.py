"""The names of the files that a cook writes, which never lie outside its folder."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from graphfx.cook.formats import faults_of_format
from graphfx.cook.movies import fault_of_movie
from graphfx.errors import OutputError, Problem
from graphfx.graph.flat import FlatNode
from graphfx.plan.make import Plan
from graphfx.plan.pictures import ImagePlan, MoviePlan

_PLAIN = re.compile(r"[^\x00-\x1f\x7f:*?\"<>|\\]+")
"""Characters that a file's name may have on every system."""


def file_name(pattern: str, graph: str, frame: int) -> str:
    """Return a file's name: each run of # is the frame's number, padded with zeros to its length."""
    return re.sub("#+", lambda run: f"{frame:0{len(run.group())}d}", pattern).replace("{graph}", graph)


def check_files(plan: Plan, out: Path, frames: Iterable[int]) -> None:
    """Raise OutputError, before any work, for images and movies whose files cannot be written under their names in `out`."""
    some = list(frames)[:2]
    problems, taken = [], dict[str, FlatNode]()
    outputs: list[ImagePlan | MoviePlan] = [*plan.stills, *plan.movies]
    for output in outputs if some else ():
        node, pattern = output.node, str(output.value("file"))
        names = [file_name(pattern, plan.flat.name, frame) for frame in some]
        fault = _unknown_word(pattern, isinstance(output, MoviePlan)) or _fault(names, out)
        if not fault:
            fault = fault_of_movie(output, pattern) if isinstance(output, MoviePlan) else _fault_of_stills(names)
        if not fault and names[0].lower() in taken:
            other = taken[names[0].lower()]
            fault = f"the {other.node_type.name} '{other.path}' writes the same files; give each a name of its own"
        if fault:
            problems.append(_problem(node, "file", f"'{pattern}': {fault}"))
        elif isinstance(output, ImagePlan):
            problems += [_problem(node, name, wrong) for name, wrong in faults_of_format(output, pattern)]
        taken |= {name.lower(): node for name in names}
    if problems:
        raise OutputError(problems)


def _problem(node: FlatNode, parameter: str, message: str) -> Problem:
    value = node.arguments[parameter]
    return Problem(message, value.location if value.location.file else node.location, value.path)


def _unknown_word(pattern: str, movie: bool) -> str:
    """Return which word in braces means nothing in a name, and what one may write, or nothing."""
    for word in re.findall(r"\{[^{}]*\}", pattern):
        if word != "{graph}":
            frame = "" if movie else ", #### for the frame's number"
            return f"{word} means nothing in the name of a file; write {{graph}} for the graph's name{frame}, or no braces"
    return ""


def _fault(names: list[str], out: Path) -> str:
    """Return what is wrong with the names of files, whatever is in them, or nothing."""
    name = names[0]
    parts = name.split("/")
    if name.startswith("/") or ".." in parts or "\\" in name or (len(name) > 1 and name[1] == ":"):
        return "files cannot leave the output folder; write a name relative to it, with / between folders and no '..'"
    if not all(_PLAIN.fullmatch(part) and part != "." and part == part.strip() for part in parts):
        return "this is no name for files on every system; use letters, digits, '-', '_' and '.'"
    if not (out / name).resolve().is_relative_to(out.resolve()):
        return "a link leads out of the output folder there; remove it, or choose another folder with --out"
    return ""


def _fault_of_stills(names: list[str]) -> str:
    """Return what is wrong with an image's names, or nothing."""
    if len(set(names)) < len(names):
        return "every frame would be written over the one before; put #### where its number goes"
    return ""
