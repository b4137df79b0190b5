"""The source of a node's function: where its arguments and its returns stand."""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any


def definition(function: Callable[..., Any]) -> tuple[ast.FunctionDef, int] | None:
    """Return the syntax tree of a function and its first line, or None where the source is not there."""
    try:
        lines, first = inspect.getsourcelines(function)
        tree = ast.parse(textwrap.dedent("".join(lines))).body[0]
    except (OSError, SyntaxError, TypeError):
        return None
    return (tree, first) if isinstance(tree, ast.FunctionDef) else None


def line_of_argument(function: Callable[..., Any], name: str) -> int:
    """Return the line on which an argument of a function stands, or 0."""
    found = definition(function)
    if found is None:
        return 0
    tree, first = found
    return next((first + argument.lineno - 1 for argument in tree.args.args if argument.arg == name), 0)


_OUTSIDE = ("random", "secrets", "time", "os", "sys", "uuid", "datetime", "pathlib")
_ACTING = ("print", "input", "open", "exec", "eval")


def stray_name(function: Callable[..., Any]) -> str:
    """Return what a function names that reaches out of it, or ''; its result would not follow from its arguments alone."""
    for name in function.__code__.co_names:
        given = function.__globals__.get(name)
        if (isinstance(given, ModuleType) and given.__name__ in _OUTSIDE) or (given is None and name in _ACTING):
            return name
    return ""


def wrong_return(function: Callable[..., Any], count: int) -> tuple[str, int]:
    """Return what is wrong with how many results a function returns, and the line; ('', 0) where nothing can be told."""
    found = definition(function)
    if found is None:
        return "", 0
    tree, first = found
    arguments = {argument.arg for argument in tree.args.args}
    returns = list(_returns(tree.body))
    if not returns:
        return "it has no return", first + tree.lineno - 1
    for each in returns:
        given = _count(each.value, arguments, count)
        if given != count:
            results = f"{given} results" if given != 1 else "1 result"
            return f"it returns {results} where {count} {'are' if count > 1 else 'is'} declared", first + each.lineno - 1
    return "", 0


def _returns(body: list[ast.stmt]) -> Iterator[ast.Return]:
    """Yield the returns of a function, without those of functions inside it."""
    for statement in body:
        if isinstance(statement, ast.Return):
            yield statement
        elif not isinstance(statement, ast.FunctionDef | ast.ClassDef):
            for name in ("body", "orelse", "finalbody"):
                yield from _returns(getattr(statement, name, []))


def _count(value: ast.expr | None, arguments: set[str], wanted: int) -> int:
    """Return how many results an expression gives; as many as are wanted where that cannot be seen."""
    if value is None:
        return 0
    if isinstance(value, ast.Tuple):
        return len(value.elts)
    single = isinstance(value, ast.BinOp | ast.UnaryOp | ast.Compare | ast.Constant)
    return 1 if single or (isinstance(value, ast.Name) and value.id in arguments) else wanted
