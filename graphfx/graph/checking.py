"""What all checks share: the library, the limits, and the problems found so far."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

from graphfx.errors import Location, NodeError, Problem, suggestion
from graphfx.graph.items import Item, shown
from graphfx.graph.limits import Limits
from graphfx.graph.names import WORD
from graphfx.node import OTHER_NAMES, Library, NodeType, Parameter

_MOST_PROBLEMS = 1000
"""So many problems are told at once, and no more."""


@dataclass
class Checking:
    """One run of the checks; all problems are collected, none is raised."""

    library: Library
    limits: Limits = field(default_factory=Limits)
    problems: list[Problem] = field(default_factory=list)
    _broken: set[str] = field(default_factory=set)

    def complain(self, location: Location, path: str, message: str, *notes: str) -> None:
        """Add a problem."""
        self.problems.append(Problem(message, location, path, tuple(note for note in notes if note)))

    def mismatch(self, item: Item, path: str, wanted: str, *notes: str) -> None:
        """Complain that something else stands where a message says what should."""
        self.complain(item.location, path, f"{wanted}; here stands {item.words}", *notes)

    def unknown_keys(self, item: Item, path: str, known: Iterable[str], what: str, *notes: str) -> None:
        """Complain of each key of an object that is not known; `what` says whose keys they are."""
        known = list(known)
        for key, _ in item.entries():
            if key not in known:
                takes = notes or (f"its keys: {', '.join(known)}",)
                self.complain(item.key_location(key), f"{path}.{key}" if path else key,
                              f"{what} has no key '{key}'." + suggestion(key, known, OTHER_NAMES), *takes)

    def choice(self, item: Item, path: str, name: str, choices: Sequence[str]) -> str:
        """Return one of some words, or complain and return ''."""
        if item.is_text and item.value in choices:
            return str(item.value)
        self.complain(item.location, path, not_one_of(item, name, choices))
        return ""

    def named(self, item: Item, key: str, path: str, what: str, pattern: re.Pattern[str]) -> bool:
        """Complain unless a key of an object is fit for a name."""
        if pattern.fullmatch(key):
            return True
        letters = "letters, digits and '_'" if pattern is WORD else "letters, digits, '_' and '-'"
        self.complain(item.key_location(key), path, f"{what} is made of {letters} and begins with a letter; {shown(key)} is not")
        return False

    def text(self, item: Item, path: str, what: str) -> str:
        """Return a text, or complain and return ''."""
        if item.is_text:
            return str(item.value)
        self.mismatch(item, path, f"{what} should be text in quotes")
        return ""

    def types_of(self, *kinds: str) -> list[str]:
        """Return the names of all node types of some kinds; their files are not executed."""
        return [name for name in self.library if self.library.kind_of(name) in kinds]

    def node_type(self, name: str) -> NodeType | None:
        """Return a node type of the library; a node file that is wrong is told once and gives None."""
        if name in self._broken:
            return None
        try:
            return self.library[name]
        except NodeError as error:
            self._broken.add(name)
            self.problems.extend(error.problems)
            return None


def not_one_of(item: Item, name: str, choices: Sequence[str]) -> str:
    """Return that an item is none of some words, with the nearest."""
    near = suggestion(item.value, choices) if item.is_text else ""
    stands = shown(item.value) if item.is_text else item.words
    return f"{name} should be one of {', '.join(choices)}, not {stands}" + (f".{near}" if near else "")


def listed(names: Iterable[str], most: int = 20) -> str:
    """Return names with commas, 'none' where there are none, and not too many."""
    names = list(names)
    shown_names = names[:most] + ([f"and {len(names) - most:,} more"] if len(names) > most else [])
    return ", ".join(shown_names) or "none"


def nearest(wrong: str, known: Iterable[str], most: int = 2000) -> str:
    """Return the suggestion among names that a document gives, of which there may be very many."""
    return suggestion(wrong[:100], list(islice(known, most)))


def counted(count: int, word: str) -> str:
    """Return "1 input" or "2 inputs"."""
    return f"{count} {word}{'s' * (count != 1)}"


def declared(node_type: NodeType) -> str:
    """Return the note that says where a type is declared, relative to its library root."""
    return f"declared in {relative_to_root(node_type.location.file)}"


def relative_to_root(file: str) -> str:
    """Return `nodes/operators/vortex.py` for a node file of any root."""
    return "/".join(Path(file).parts[-3:])


def takes(name: str, parameters: Iterable[Parameter]) -> str:
    """Return the note that lists what a type takes."""
    return f"{name} takes: {', '.join(parameter.label for parameter in parameters) or 'no parameters'}"


def number(value: float) -> str:
    """Return a number as a message shows it: shortest, without a needless '.0'."""
    if value == float("inf"):
        return "infinity"
    if value == float("-inf"):
        return "-infinity"
    return str(int(value)) if float(value).is_integer() and abs(value) < 1e15 else repr(float(value))


def in_order(problems: list[Problem], file: str) -> list[Problem]:
    """Return problems without repeats, those of the document itself first, by place."""
    unique = list(dict.fromkeys(problems))[:_MOST_PROBLEMS]
    return sorted(unique, key=lambda problem: (problem.location.file != file, problem.location))
