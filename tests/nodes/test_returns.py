"""How many results a function returns is read from its source where it can be."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from graphfx.node.source import wrong_return


def inner(position, velocity):
    def turned(vector):
        return -vector

    return turned(position), velocity


def either(position, velocity):
    if position:
        return position, velocity
    return position + velocity


def helped(position, velocity):
    return inner(position, velocity)


def nothing(position):
    position + position


def bare(position):
    if position:
        return
    return position


@pytest.mark.parametrize(("function", "count", "message", "line"), [
    (inner, 2, "", 0), (inner, 1, "it returns 2 results where 1 is declared", 4),
    (either, 2, "it returns 1 result where 2 are declared", 3), (helped, 2, "", 0), (helped, 1, "", 0),
    (nothing, 1, "it has no return", 0), (bare, 1, "it returns 0 results where 1 is declared", 2), (len, 1, "", 0),
])
def test_returns_are_counted(function: Callable[..., Any], count: int, message: str, line: int) -> None:
    """A return with another number of results is found with its line; what a call returns cannot be seen."""
    first = function.__code__.co_firstlineno if message else 0
    assert wrong_return(function, count) == (message, first + line)
