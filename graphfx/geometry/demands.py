"""What a function of particles demands of the meshes that it is given: found from the functions that it calls."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from types import CodeType, FunctionType
from typing import Any

from graphfx.errors import GraphError, Problem
from graphfx.geometry import access, search
from graphfx.geometry.mesh import Mesh


@cache
def reached(function: Callable[..., Any]) -> frozenset[Callable[..., Any]]:
    """Return a function and all plain functions that it names, and they name, and so on."""
    found: set[Callable[..., Any]] = set()
    waiting = [function]
    while waiting:
        now = waiting.pop()
        if isinstance(now, FunctionType) and now not in found:
            found.add(now)
            waiting += [now.__globals__[name] for name in _names(now.__code__) if name in now.__globals__]
    return frozenset(found)


def _names(code: CodeType) -> set[str]:
    return set(code.co_names).union(*(_names(part) for part in code.co_consts if isinstance(part, CodeType)))


def needs_tree(function: Callable[..., Any]) -> bool:
    """Return whether a function searches in a mesh."""
    return any(each.__module__ == search.__name__ for each in reached(function))


def check_mesh(mesh: Mesh, function: Callable[..., Any], name: str) -> None:
    """Raise GraphError where a function, `name` to the user, cannot work on a mesh."""
    if access.choose_face in reached(function) and not mesh.areas.sum() > 0:
        raise GraphError(Problem(f"it has no surface, and {name} chooses points of one; take from_points or at_vertices"))
    if needs_tree(function) and not len(mesh.triangles):
        raise GraphError(Problem(f"it has points alone, and {name} needs triangles"))
    if search.is_inside in reached(function) and (edges := mesh.open_edges()):
        raise GraphError(Problem(f"it is not closed: {edges:,} of its edges do not lie between two faces; {name} needs a mesh "
                                 "that has an inside"))
