"""A branch on a value that differs from lane to lane is an error at the author's own line."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphfx.errors import NodeError
from graphfx.lanes.arithmetic import BRANCH
from graphfx.machine.kernels import kernel_of
from graphfx.math import where
from graphfx.program import function

HERE = str(Path(__file__))


def step_up(x):
    if x > 0.0:  # in a helper
        return x * 0.0 + 1.0
    return x * 0.0


@function("float", "float")
def by_if(x):
    y = x * 2.0
    if y > 1.0:  # by_if
        y = y * 0.0
    return y


@function("float float", "float")
def by_and(x, y):
    inside = x > 0.0 and y > 0.0  # by_and
    return where(inside, x, y)


@function("float", "float")
def by_not(x):
    return where(not x > 0.0, x, -x)  # by_not


@function("float", "float")
def by_chain(x):
    return where(0.0 < x < 1.0, x, 0.0)  # by_chain


@function("float", "float")
def by_choice(x):
    return x if x > 0.0 else -x  # by_choice


@function("float", "float")
def by_while(x):
    while x > 1.0:  # by_while
        x = x * 0.5
    return x


@function("float", "float")
def by_helper(x):
    low = step_up(x)
    return low * 2.0


def line_of(mark: str) -> int:
    return next(k for k, text in enumerate(Path(HERE).read_text().splitlines(), 1) if text.endswith(f"# {mark}"))


@pytest.mark.parametrize("wrong", [by_if, by_and, by_not, by_chain, by_choice, by_while], ids=lambda wrong: wrong.name)
def test_branch_names_the_line_and_what_to_write(wrong):
    """The message is the file, the line of the branch, the function, and `where(condition, a, b)`."""
    with pytest.raises(NodeError) as caught:
        kernel_of(wrong)
    assert str(caught.value) == f"{HERE}:{line_of(wrong.name)}: {wrong.name}: {BRANCH}"


def test_branch_in_a_helper_names_the_helpers_line():
    """A branch in a function that the node calls is told where it stands."""
    with pytest.raises(NodeError) as caught:
        kernel_of(by_helper)
    assert str(caught.value) == f"{HERE}:{line_of('in a helper')}: by_helper: {BRANCH}"


def test_message_says_what_to_write():
    """The hint shows the call that replaces a branch."""
    assert "write where(condition, a, b)" in BRANCH and "masks combine with & | ~" in BRANCH
