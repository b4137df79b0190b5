"""Every node of every library keeps the contract; a new file is found by itself."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from graphfx.contract import Subject, truths_of
from graphfx.errors import NodeError
from graphfx.node import Library, library_roots

FIXTURE = Path(__file__).parent / "library"
LIBRARY = Library(library_roots([FIXTURE]))


@cache
def subject_of(name: str) -> Subject:
    """Return a node type, with what was computed of it."""
    return Subject(LIBRARY[name], LIBRARY)


def truths(name: str) -> list[str]:
    """Return the names of what must be true of a node; of one that cannot be loaded, that it can."""
    try:
        return [truth.__name__ for truth in truths_of(subject_of(name))]
    except NodeError:
        return ["is_documented"]


CASES = [pytest.param(name, truth, id=f"{name}-{truth}") for name in sorted(LIBRARY) for truth in truths(name)]


@pytest.mark.parametrize(("name", "truth"), CASES)
def test_contract(name: str, truth: str) -> None:
    """What the contract says of a node is true."""
    subject = subject_of(name)
    next(each for each in truths_of(subject) if each.__name__ == truth)(subject)
