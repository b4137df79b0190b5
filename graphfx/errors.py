"""What can go wrong, said so that the reader can mend it.

Every error that a user can cause is a `Problem`: where it is, what was wanted, what to do.
Checks collect all problems and raise them together as one `GraphError`.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass, field

EXIT_OK = 0
EXIT_GRAPH = 1
"""The graph, or a node that it uses, is wrong."""
EXIT_USAGE = 2
"""The command line is wrong."""
EXIT_OUTPUT = 3
"""An output could not be written: no space, no permission, a path that is not allowed."""
EXIT_LIMIT = 4
"""A limit was reached: memory, particles, pixels, document size."""
EXIT_COOK = 5
"""The cook failed: a particle left the finite numbers, a method gave up."""
EXIT_BUG = 70
"""graphfx itself is wrong; `--debug` shows where."""
EXIT_INTERRUPTED = 130
"""Stopped by Ctrl-C; whole files are kept. A signal that asks to stop gives 128 + its number."""


@dataclass(frozen=True, order=True)
class Location:
    """A place in a text file: lines and columns count from 1; 0 means unknown."""

    file: str = ""
    line: int = 0
    column: int = 0

    def __str__(self) -> str:
        parts = [self.file] if self.file else []
        if self.line:
            parts += [str(self.line)]
            if self.column:
                parts += [str(self.column)]
        return ":".join(parts)


NOWHERE = Location()


@dataclass(frozen=True)
class Problem:
    """One thing that is wrong: `message` says what and what to do, `notes` add facts, a line each."""

    message: str
    location: Location = NOWHERE
    path: str = ""
    notes: tuple[str, ...] = field(default=())

    def __str__(self) -> str:
        head = ": ".join(part for part in (str(self.location), self.path, self.message) if part)
        return "\n".join([head, *(f"  {note}" for note in self.notes)])


class GraphfxError(Exception):
    """Base of all errors that are the user's to mend. `exit_code` is the command's."""

    exit_code = EXIT_GRAPH

    def __init__(self, problems: Problem | str | Iterable[Problem]):
        if isinstance(problems, str):
            problems = Problem(problems)
        self.problems = [problems] if isinstance(problems, Problem) else list(problems)
        super().__init__("\n".join(str(problem) for problem in self.problems))


class GraphError(GraphfxError):
    """A graph document is wrong."""


class NodeError(GraphfxError):
    """A node file is wrong: its declaration, or what Numba makes of it."""


class UsageError(GraphfxError):
    """The command line, or a call from Python, asks for something that cannot be."""

    exit_code = EXIT_USAGE


class OutputError(GraphfxError):
    """A file cannot be written where it was asked for."""

    exit_code = EXIT_OUTPUT


class LimitError(GraphfxError):
    """Carrying on would pass a limit."""

    exit_code = EXIT_LIMIT


class CookError(GraphfxError):
    """The cook cannot go on."""

    exit_code = EXIT_COOK


def how_to_install(error: Exception, extra: str) -> str:
    """Return, for the error of an import, what is wrong with a library that an extra brings, and what mends it."""
    if isinstance(error, ModuleNotFoundError):
        return f'which is not installed; install it by: pip install "graphfx[{extra}]"'
    return f'which cannot be loaded: {error}; install it again by: pip install --force-reinstall "graphfx[{extra}]"'


def suggestion(wrong: str, known: Iterable[str], other_names: dict[str, str] | None = None) -> str:
    """Return " Did you mean 'x'?" for the known name nearest to `wrong`, or nothing.

    `other_names` maps names used by other tools (`P`, `Cd`) to ours.
    """
    names = list(known)
    other = (other_names or {}).get(wrong) or (other_names or {}).get(wrong.lower())
    if other in names:
        return f" Did you mean '{other}'?"
    near = difflib.get_close_matches(wrong, names, n=1, cutoff=0.6)
    if not near:
        near = [name for name in names if name.lower() == wrong.lower()][:1]
    return f" Did you mean '{near[0]}'?" if near else ""
