"""Which line of the author's Python wrote each part of a graph, so that messages can name it."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from graphfx.errors import GraphError, Location, Problem, suggestion

_HERE = str(Path(__file__).parent)


def caller() -> Location:
    """Return the file and line of the innermost call from outside this folder."""
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_HERE):
        frame = frame.f_back
    return Location(frame.f_code.co_filename, frame.f_lineno)


def fault(message: str, known: Iterable[str] = (), *, wrong: str = "", path: str = "", notes: tuple[str, ...] = (),
          other_names: dict[str, str] | None = None) -> GraphError:
    """Return the error that names the author's line; a message about a `wrong` name suggests one that is known."""
    near = suggestion(wrong, known, other_names) if wrong else ""
    return GraphError(Problem(message + near, caller(), path, notes))


class UnknownName(GraphError, AttributeError):
    """A name that nothing has: an AttributeError too, as `hasattr` expects."""


def missing(message: str, wrong: str, known: Iterable[str], other_names: dict[str, str] | None = None) -> UnknownName:
    """Return the error for a name that nothing has."""
    return UnknownName(fault(message, known, wrong=wrong, other_names=other_names).problems)


class Places:
    """The lines that wrote the parts of a document, by JSON path."""

    def __init__(self) -> None:
        self._lines: dict[str, tuple[int, Location]] = {}
        self._count = 0

    def note(self, path: str, location: Location) -> None:
        """Remember which line wrote a part; what was noted inside it before is out of date."""
        self._count += 1
        self._lines[path] = self._count, location

    def of(self, path: str) -> Location:
        """Return the line that wrote a part, or the smallest noted part that holds it."""
        around = sorted((known for known in self._lines if known == path or _inside(path, known)), key=len)
        found, newest = Location(), 0
        for known in around:
            count, location = self._lines[known]
            if count >= newest:
                found, newest = location, count
        return found

    def told(self, problems: Iterable[Problem], file: str) -> list[Problem]:
        """Return the problems of the document called `file` with lines of Python instead of places in its text."""
        return [replace(problem, location=self.of(problem.path)) if problem.location.file in (file, "") else problem
                for problem in problems]


def _inside(path: str, other: str) -> bool:
    """Return whether a JSON path leads into another."""
    return not other or path.startswith((f"{other}.", f"{other}["))
