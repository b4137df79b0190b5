"""JSON is read strictly, with places, and hostile text never gets past."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphfx.errors import GraphError, GraphfxError, LimitError, UsageError
from graphfx.graph.limits import Limits
from graphfx.graph.reader import read

SCALARS = st.none() | st.booleans() | st.integers(-(10**17), 10**17) | st.floats(allow_nan=False, allow_infinity=False) | st.text(
    st.characters(codec="utf-8"))
JSON = st.recursive(SCALARS, lambda part: st.lists(part, max_size=4) | st.dictionaries(st.text(max_size=5), part,
    max_size=4), max_leaves=20)


@given(JSON, st.sampled_from([None, 0, 2]), st.booleans())
def test_what_is_json_reads_as_itself(data: object, indent: int | None, ascii_only: bool) -> None:
    """A correct text gives the data that Python's own reader gives, and no problem."""
    item, problems = read(json.dumps(data, indent=indent, ensure_ascii=ascii_only), "a.json")
    assert (item.data(), problems) == (data, [])


@given(st.text(alphabet='{}[]",:0123456789.eE+-\\/#*untrfalsNI \n\t\u00a0\ud800', max_size=40))
def test_no_text_is_more_than_an_error(text: str) -> None:
    """Any text is read, or refused with a place."""
    try:
        _, problems = read(text, "a.json")
    except GraphfxError as error:
        problems = error.problems
        assert problems
    assert all(problem.location.line > 0 and problem.message for problem in problems)


@given(st.binary(max_size=40))
def test_no_bytes_are_more_than_an_error(data: bytes) -> None:
    """Any bytes are read, or refused with a place."""
    try:
        read(data, "a.json")
    except GraphError as error:
        assert all(problem.location.line > 0 for problem in error.problems)


def test_every_key_and_value_knows_its_place() -> None:
    """Lines and columns count from 1, in characters."""
    item, _ = read('{\n  "é": [1,\n\t{"b": true}]}', "a.json")
    inner = item.value["é"].value[1]
    places = [item.location, item.key_location("é"), item.value["é"].location, inner.location, inner.key_location("b"),
              inner.value["b"].location]
    assert [(place.line, place.column) for place in places] == [(1, 1), (2, 3), (2, 8), (3, 2), (3, 3), (3, 8)]


def test_a_character_inside_a_text_has_its_place() -> None:
    """A text without escapes counts from its quote; with escapes the quote itself must do."""
    item, _ = read('["abc", "a\\tb"]', "a.json")
    assert [part.text_location(2).column for part in item.value] == [5, 9]


def test_a_broken_number_is_told_once() -> None:
    """What could not be read is marked, so that no later check complains of it again."""
    item, problems = read("[1e999, NaN, 01]", "a.json")
    assert ([part.broken for part in item.value], len(problems)) == ([True] * 3, 3)


@pytest.mark.parametrize("depth", [1, 5, 64])
def test_depth_has_a_limit(depth: int) -> None:
    """A document may nest exactly as deep as the limit says."""
    limits = Limits(depth=depth)
    read("[" * depth + "]" * depth, "a.json", limits)
    with pytest.raises(LimitError, match=f"limit of {depth}"):
        read("[" * (depth + 1) + "]" * (depth + 1), "a.json", limits)


def test_size_has_a_limit() -> None:
    """A document may be exactly as long as the limit says, in bytes."""
    read('"é"', "a.json", Limits(bytes=4))
    with pytest.raises(LimitError, match="the limit of 4"):
        read('"éa"', "a.json", Limits(bytes=4))


def test_a_limit_beyond_what_can_be_read_is_refused() -> None:
    """Reading recurses, so no depth above 100 may be asked for."""
    with pytest.raises(UsageError, match="1 to 100"):
        Limits(depth=100_000)


def test_the_deepest_limit_can_be_read() -> None:
    """A document at the deepest limit reads without running out of stack."""
    read("[" * 100 + "]" * 100, "a.json", Limits(depth=100))


def test_large_documents_read_in_reasonable_time() -> None:
    """A megabyte of nodes takes no more than a few seconds."""
    text = json.dumps({f"n{i}": {"type": "emit", "rate": i * 0.5} for i in range(25_000)})
    item, problems = read(text, "a.json")
    assert (len(item.value), problems) == (25_000, [])
