"""Find the files that a graph names; none may lie outside the folders that the graph may read.

A path is relative, with forward slashes, and says no `..`. It is looked for in each folder in turn, and
what it resolves to, symbolic links followed, must lie in that folder.
"""

from __future__ import annotations

import re
import stat
from collections.abc import Iterable
from pathlib import Path

from graphfx.errors import suggestion
from graphfx.graph.items import shown

_DEVICE = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|com[0-9]|lpt[0-9])(\..*)?", re.IGNORECASE)
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
_LONGEST = 1024


class PathRefused(Exception):
    """The path may not be used, or names no file; the message says why and what to do, the notes where it was sought."""

    def __init__(self, message: str, *notes: str):
        """Refuse with a message and notes."""
        super().__init__(message)
        self.notes = notes


def refusal(text: str) -> str:
    """Return why a path may not be written so, or '' where it may.

    Only the text is judged: also forms that mean something on another system are refused.
    """
    name = shown(text)
    if not text or text.isspace():
        return "the path is empty; name a file"
    if len(text) > _LONGEST:
        return f"the path has {len(text)} characters, more than {_LONGEST}"
    if not text.isprintable():
        return f"the path {name} has a character in it that cannot be seen; delete it"
    if "\\" in text:
        return f"the path {name} has a backslash in it; write / between folders"
    if text.startswith("/"):
        return f"the path {name} is absolute; write it from the graph's folder"
    if _SCHEME.match(text):
        return f"{name} begins with a drive or an address; write a path from the graph's folder"
    if text.startswith("~"):
        return f"the path {name} begins with '~'; write it from the graph's folder"
    if any(sign in text for sign in "%$*?<>|\":"):
        return f"the path {name} has a sign in it that some systems replace or forbid: % $ * ? < > | \" :"
    for part in text.split("/"):
        if part == "..":
            return f"the path {name} leaves its folder by '..'; copy the file beside the graph, or add its folder as a library"
        if part in ("", "."):
            return f"the path {name} has an empty or '.' part; write folder/file"
        if part != part.strip() or part.endswith("."):
            return f"the path {name} has a part that begins or ends with a space, or ends with a dot"
        if _DEVICE.fullmatch(part):
            return f"'{part}' is the name of a device on some systems; rename the file"
    return ""


def find_file(text: str, folders: Iterable[Path]) -> Path:
    """Return the file, not resolved, that a path names in the first folder that has it; raise `PathRefused` otherwise."""
    message = refusal(text)
    if message:
        raise PathRefused(message)
    folders = list(folders)
    for folder in folders:
        file = folder.joinpath(*text.split("/"))
        try:
            real = file.resolve()
            if not file.exists():
                continue
            if not real.is_relative_to(folder.resolve()):
                raise PathRefused(f"{shown(text)} leads out of its folder by a symbolic link; copy the file there")
            if not stat.S_ISREG(real.stat().st_mode):
                raise PathRefused(f"{shown(text)} is no file, but a folder or a device")
        except (OSError, RuntimeError, ValueError) as error:
            raise PathRefused(f"{shown(text)} cannot be read: {error}") from error
        return file
    near = [str(file.relative_to(folder)) for folder in folders
            for file in sorted(folder.joinpath(text).parent.glob("*.*"))[:200]]
    sought = [f"sought in {folder.resolve()}" for folder in folders]
    raise PathRefused(f"there is no file {shown(text)}." + suggestion(text, near), *sought)
