"""Frame sets as people type them."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphfx.cook.frames import frames_text, parse_frames, spread


@pytest.mark.parametrize(("text", "frames"), [
    ("7", [7]), ("1-4", [1, 2, 3, 4]), ("1-10x3", [1, 4, 7, 10]), ("3,1,3,2-3", [1, 2, 3]),
    ("-3--1", [-3, -2, -1]), (" 5 , 6 ", [5, 6]),
])
def test_what_a_set_means(text: str, frames: list[int]) -> None:
    """Ranges, steps and lists, in any order, each frame once."""
    assert parse_frames(text, -10, 10) == frames


@pytest.mark.parametrize(("frames", "text"), [
    ([3, 4, 5], "3-5"), ([1, 3, 5, 7, 20], "1-7x2,20"), ([1, 2, 9], "1-2,9"), ([1, 9], "1,9"), ([], ""),
])
def test_how_a_set_is_written(frames: list[int], text: str) -> None:
    """Runs of equal steps are written as ranges."""
    assert frames_text(frames) == text


@given(st.sets(st.integers(-50, 200), min_size=1))
def test_written_and_read_again(frames: set[int]) -> None:
    """Any set of frames survives being written and read."""
    assert parse_frames(frames_text(frames), -50, 200) == sorted(frames)


@given(st.sets(st.integers(-500, 500), min_size=1).map(sorted), st.integers(1, 40))
def test_spread_frames(frames: list[int], count: int) -> None:
    """Spread frames are among those given, as many as asked for where there are, from the first to the last, and even."""
    chosen = spread(frames, count)
    places = [frames.index(frame) for frame in chosen]
    assert len(chosen) == min(count, len(frames))
    assert (places[0], places[-1]) == (0, len(frames) - 1 if len(chosen) > 1 else 0)
    steps = [after - before for before, after in pairwise(places)]
    assert not steps or max(steps) - min(steps) <= 1
