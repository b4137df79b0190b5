"""Put one-line functions into the source of their kernel: Numba then has one function less to compile.

Only a function whose body is one `return` of an expression qualifies; its arguments are renamed, and
its global names bound in the kernel's scope. The operations, and so the bits, are the same.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable
from typing import Any


class _Rename(ast.NodeTransformer):
    def __init__(self, arguments: dict[str, str], scope: dict[str, Any], prefix: str):
        self.arguments = arguments
        self.scope = scope
        self.prefix = prefix
        self.found: dict[str, Any] = {}

    def visit_Name(self, node: ast.Name) -> ast.Name:
        """Rename an argument, or a global name, which is noted."""
        if node.id in self.arguments:
            return ast.Name(self.arguments[node.id], node.ctx)
        if node.id not in self.scope:
            raise LookupError(node.id)
        name = f"{self.prefix}_{node.id}"
        self.found[name] = self.scope[node.id]
        return ast.Name(name, node.ctx)


def inline_body(function: Callable[..., Any], arguments: list[str], prefix: str) -> tuple[str, dict[str, Any]] | None:
    """Return a function's expression in terms of `arguments`, and the global names in it; None if it has more than that."""
    if function.__code__.co_freevars:
        return None
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(function))).body[0]
    except (OSError, SyntaxError):
        return None
    if not isinstance(tree, ast.FunctionDef):
        return None
    body = tree.body[1:] if ast.get_docstring(tree) is not None else tree.body
    given = [argument.arg for argument in tree.args.args]
    if len(body) != 1 or not isinstance(body[0], ast.Return) or body[0].value is None or len(given) != len(arguments):
        return None
    rename = _Rename(dict(zip(given, arguments, strict=True)), function.__globals__, prefix)
    try:
        return ast.unparse(rename.visit(body[0].value)), rename.found
    except LookupError:
        return None
