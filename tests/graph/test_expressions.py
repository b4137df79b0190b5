"""Expressions: grammar, types, mistakes."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from graphfx.graph.expressions import parse
from graphfx.graph.functions import CALLED, FUNCTIONS
from graphfx.graph.limits import Limits
from graphfx.graph.values import Call, Name, measure

KNOWN = {"age": "float", "position": "vec3", "velocity": "vec3", "param.wind": "float", "birth.color": "vec3",
         "param.during.start": "float"}


def resolve(name: str) -> Any:
    return (Name(name), KNOWN[name]) if name in KNOWN else f"there is no name '{name}'"


def shown(tree: Any) -> str:
    """Return a tree as nested calls."""
    if isinstance(tree, Call):
        return f"{tree.function}({', '.join(shown(part) for part in tree.arguments)})"
    return tree.name if isinstance(tree, Name) else f"{tree:g}" if type(tree) is float else str(tree)


@pytest.mark.parametrize(("text", "tree", "kind"), [
    ("1", "1", "float"),
    (".5e1 + 1.", "add(5, 1)", "float"),
    ("1 - 2 - 3", "subtract(subtract(1, 2), 3)", "float"),
    ("1 + 2 * 3 % 4", "add(1, modulo(multiply(2, 3), 4))", "float"),
    ("-age ** 2", "negate(power(age, 2))", "float"),
    ("2 ** 3 ** 2", "power(2, power(3, 2))", "float"),
    ("2 ** -1", "power(2, -1)", "float"),
    ("- - 2", "2", "float"),
    ("pow(age, 2)", "power(age, 2)", "float"),
    ("age < 1 and not age >= 0.5 or true", "or(and(less(age, 1), not(greater_equal(age, 0.5))), True)", "bool"),
    ("0 < age <= 1", "and(less(0, age), less_equal(age, 1))", "bool"),
    ("1 if age > 2 else 3 if age > 4 else 5", "select(greater(age, 2), 1, select(greater(age, 4), 3, 5))", "float"),
    ("min(1, age, 3)", "min(min(1, age), 3)", "float"),
    ("vec(1, 2, 3).y", "component_y(vec(1, 2, 3))", "float"),
    ("(position + velocity).x", "component_x(add(position, velocity))", "float"),
    ("position.x * 2", "multiply(component_x(position), 2)", "float"),
    ("2 * position / 3 - velocity", "subtract(divide(multiply(2, position), 3), velocity)", "vec3"),
    ("-position", "negate(position)", "vec3"),
    ("mix(position, velocity, 0.5)", "mix(position, velocity, 0.5)", "vec3"),
    ("position if age > 1 else velocity", "select(greater(age, 1), position, velocity)", "vec3"),
    ("param.wind + param.during.start", "add(param.wind, param.during.start)", "float"),
    ("birth.color.y", "component_y(birth.color)", "float"),
    ("length(cross(position, velocity)) * dot(position, velocity)",
     "multiply(length(cross(position, velocity)), dot(position, velocity))", "float"),
    ("tau", "6.28319", "float"),
])
def test_reads_as(text: str, tree: str, kind: str) -> None:
    """Operators bind as in Python, and types follow from the arguments."""
    found, found_kind, mistakes = parse(text, resolve)
    assert (shown(found), found_kind, mistakes) == (tree, kind, [])


@pytest.mark.parametrize(("text", "column", "words"), [
    ("", 0, "empty"), ("1 +", 3, "ends where"), ("(1", 0, "not closed"), ("1 2", 2, "'2' cannot stand here"),
    ("age @ 2", 4, "'@' has no meaning"), ("1 if age", 8, "'else' is missing"), ("position.w", 9, "x, y or z"),
    ("position.", 9, "the end"), ("sin(1", 5, "',' or ')'"), ("sin()", 0, "0 arguments"), ("clamp(1, 2)", 0,
    "clamp(x, low, high)"),
    ("sine(1)", 0, "Did you mean 'sin'?"), ("age && 1", 4, "write 'and'"), ("age ^ 2", 4, "a ** b"), ("age = 2", 4, "=="),
    ("!age", 0, "write 'not'"), ("[1, 2, 3]", 0, "vec(x, y, z)"), ("position * velocity", 9, "two vectors"),
    ("position + 1", 9, "a vector and a number"), ("not age", 0, "a condition"), ("age.x", 4, "takes a vector"),
    ("1 if age else 2", 2, "a condition"), ("1 if true else position", 2, "a condition"), ("position < velocity", 9,
    "two numbers"),
    ("1e999", 0, "too large"), ("param", 0, "no name"), ("lambda", 0, "no name"), ("__import__('os')", 11, "no meaning"),
    ("age if", 6, "ends where"), ("1 //2", 2, "floor"), ("and", 0, "not 'and'"),
])
def test_a_mistake_has_its_column(text: str, column: int, words: str) -> None:
    """The first mistake is told at its column, counted from 0, and says what to do."""
    _, kind, mistakes = parse(text, resolve)
    assert (mistakes[0].column, words in mistakes[0].message) == (column, True), mistakes
    assert kind in ("", "float", "vec3", "bool")


def test_all_wrong_names_are_told() -> None:
    """A wrong name hides no other."""
    _, _, mistakes = parse("a + b * sin(c)", resolve)
    assert [mistake.column for mistake in mistakes] == [0, 4, 12]


@given(st.text(alphabet="agepositn.wdvec(),+-*/%<>=! 0123456789if elsandorx", max_size=60))
def test_any_text_is_parsed_or_told(text: str) -> None:
    """No text does more than give a tree of known functions, or mistakes inside the text."""
    tree, kind, mistakes = parse(text, resolve)
    assert all(0 <= mistake.column <= len(text) for mistake in mistakes)
    if not mistakes:
        assert kind and _known(tree)


def _known(tree: Any) -> bool:
    if isinstance(tree, Call):
        return tree.function in FUNCTIONS and all(_known(part) for part in tree.arguments)
    return isinstance(tree, float | bool) or (isinstance(tree, Name) and tree.name in KNOWN)


@pytest.mark.parametrize("text", ["(" * 5000, "-" * 1999, "not " * 400 + "true", "1" + "+1" * 900, "2" + "**2" * 600,
    "(" * 31 + "1" + ")" * 31,
                                  "min(" * 40 + "1", "age" + ".x" * 300, "1" * 3000, "1 if true else " * 120 + "1"])
def test_hostile_texts_stay_within_the_stack(text: str) -> None:
    """Long, deep and wide texts are read or refused; none exhausts the stack."""
    tree, _, mistakes = parse(text, resolve)
    assert mistakes or measure(tree).depth <= Limits().expression_depth


def test_every_function_can_be_called_as_its_spelling_says() -> None:
    """What the table says of a function is what the parser takes."""
    for word, name in CALLED.items():
        for arguments, result in FUNCTIONS[name].forms:
            written = ", ".join({"float": "age", "vec3": "position", "bool": "true"}[kind] for kind in arguments)
            _, kind, mistakes = parse(f"{word}({written})", resolve)
            assert (kind, mistakes) == (result, [])
