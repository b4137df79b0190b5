"""The names of the files that a cook writes, which never lie outside its folder."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from graphfx.errors import OutputError, Problem
from graphfx.plan.make import ImagePlan, Plan

_PLAIN = re.compile(r"[^\x00-\x1f\x7f:*?\"<>|\\]+")
"""Characters that a file's name may have on every system."""


def file_name(pattern: str, graph: str, frame: int) -> str:
    """Return a file's name: each run of # is the frame's number, padded with zeros to its length."""
    return re.sub("#+", lambda run: f"{frame:0{len(run.group())}d}", pattern).replace("{graph}", graph)


def check_files(plan: Plan, out: Path, frames: Iterable[int]) -> None:
    """Raise OutputError, before any work, for images whose files cannot be written under their names in `out`."""
    some = list(frames)[:2]
    problems, taken = [], dict[str, str]()
    for image in plan.images:
        pattern = str(image.value("file"))
        names = [file_name(pattern, plan.flat.name, frame) for frame in some]
        fault = _fault(names, out) if names else ""
        if not fault and names and names[0].lower() in taken:
            fault = f"the image '{taken[names[0].lower()]}' writes the same files; give each a name of its own"
        if fault:
            problems.append(_problem(image, f"'{pattern}': {fault}"))
        taken |= {name.lower(): image.node.path for name in names}
    if problems:
        raise OutputError(problems)


def _problem(image: ImagePlan, message: str) -> Problem:
    value = image.node.arguments["file"]
    return Problem(message, value.location if value.location.line else image.node.location, value.path)


def _fault(names: list[str], out: Path) -> str:
    """Return what is wrong with an image's names, or nothing."""
    name = names[0]
    parts = name.split("/")
    if name.startswith("/") or ".." in parts or "\\" in name or (len(name) > 1 and name[1] == ":"):
        return "files cannot leave the output folder; write a name relative to it, with / between folders and no '..'"
    if not all(_PLAIN.fullmatch(part) and part != "." and part == part.strip() for part in parts):
        return "this is no name for files on every system; use letters, digits, '-', '_' and '.'"
    if not name.lower().endswith(".png"):
        return "images are written as PNG; let the name end in .png"
    if len(set(names)) < len(names):
        return "every frame would be written over the one before; put #### where its number goes"
    if not (out / name).resolve().is_relative_to(out.resolve()):
        return "a link leads out of the output folder there; remove it, or choose another folder with --out"
    return ""
