"""What values are made of: how often they must be found, and which are the same."""

from __future__ import annotations

from functools import reduce
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from graphfx.graph.values import Call, Literal, Name, Random
from graphfx.plan.holder import draws_in, names_in
from graphfx.plan.rates import Identities, Rate, Scope, depends_on_time, rate_of

SCOPE = Scope(0, "", None, None, lambda name: name == "position")  # type: ignore[arg-type]
LEAVES = st.one_of(
    st.sampled_from(["time", "position", "mass"]).map(Name),
    st.integers(0, 3).map(lambda number: Literal("float", value=float(number))),
    st.integers(0, 2).map(lambda number: Random("float", seed=f"a/{number}", low=Literal("float", value=0.0),
                                                high=Literal("float", value=1.0))),
)
TREES = st.recursive(LEAVES, lambda parts: st.builds(
    Call, st.sampled_from(["+", "min"]), st.tuples(parts, parts)), max_leaves=12)


def shared(levels: int, leaf: Any) -> Any:
    """Return a value of 2^levels leaves, each half the same as the other."""
    return reduce(lambda tree, _: Call("+", (tree, tree)), range(levels), leaf)


def test_what_is_shared_makes_no_more_work() -> None:
    """A value that is used twice by what is used twice, and so on, is looked at once."""
    tree = shared(200, Name("position"))
    assert names_in(tree) == {"position"} and not draws_in(tree)
    assert rate_of(tree, SCOPE) == Rate.PARTICLE and depends_on_time(tree)
    numbers = Identities()
    assert numbers.of(tree) == numbers.of(shared(200, Name("position"))) != numbers.of(shared(199, Name("position")))


@given(TREES, TREES)
def test_equal_values_have_equal_numbers(one: Any, other: Any) -> None:
    """Numbers are equal where the values are, and only there."""
    numbers = Identities()
    assert (numbers.of(one) == numbers.of(other)) == (one == other)


@given(TREES)
def test_rate_is_that_of_the_quickest_part(tree: Any) -> None:
    """What reads a place, or draws for itself, is found for each particle; what reads the clock, in each step."""
    names = str(tree)
    wanted = Rate.PARTICLE if "position" in names or "Random" in names else Rate.STEP if "'time'" in names else Rate.CONSTANT
    assert rate_of(tree, SCOPE) == wanted
