"""Say what a graph asks for that this version does not carry out yet: all of it at once, before any work."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from graphfx.errors import GraphError, Problem
from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.values import Literal, Name, Node, Random, Value, children
from graphfx.motion.probe import carries
from graphfx.node import NUMERIC_TYPES, NodeType
from graphfx.plan.values import node_function

MOVING_ROLES = ("linear", "flow", "acceleration", "velocity", "noise", "surface")
SCOPES = ("life", "particle", "frame", "graph")
METHODS = ("auto", "exact", "strang", "sims")


def check_support(flat: FlatGraph, order: list[str]) -> None:
    """Raise GraphError with everything among the nodes that run that cannot be carried out."""
    problems = [problem for path in order for problem in _of_node(flat.nodes[path])]
    if flat.time.method not in METHODS:
        problems.append(
            Problem(
                f"method '{flat.time.method}' is not carried out by this version; choose one of {', '.join(METHODS)}",
                path="time.method",
            )
        )
    if problems:
        raise GraphError(problems)


def _of_node(node: FlatNode) -> Iterator[Problem]:
    path, place = f"nodes.{node.path}", node.location
    role = node.node_type.role
    if node.node_type.kind == "operators" and role not in MOVING_ROLES:
        yield Problem(
            f"operators of the kind '{role}' are not carried out by this version; leave '{node.node_type.name}' out, "
            'or switch it off with "enabled": false',
            place,
            path,
        )
    particles = not node.node_type.language and node.node_type.kind != "geometry"
    for parameter in node.node_type.parameters.values() if particles else ():
        if parameter.type not in (*NUMERIC_TYPES, "mesh"):
            yield Problem(
                f"its parameter '{parameter.name}' is a {parameter.type}, and functions for particles are given "
                f"{', '.join(NUMERIC_TYPES)} alone in this version",
                node.node_type.location,
                node.node_type.name,
            )
    yield from _of_type(node)
    if node.when and node.when != "step":
        yield Problem(f"'when': '{node.when}' is not carried out by this version", place, path)
    if isinstance(node.only, Literal) and node.only.type == "selector":
        yield Problem("a selector node for 'only' is not carried out by this version; give an expression", place, path)
    values = [*node.arguments.values(), *node.sets.values(), *([node.only] if node.only is not None else [])]
    for value in values:
        yield from _of_value(value, value)


def _of_type(node: FlatNode) -> Iterator[Problem]:
    """Yield what a node type declares that is not carried out."""
    declared, name = node.node_type, node.node_type.name
    if "id" in declared.reserved:
        yield Problem("functions for particles are not given 'id' in this version", declared.location, name)
    if declared.role in ("linear", "flow", "noise"):
        flow = declared.role == "flow"
        if not (declared.writes and set(declared.writes) <= {"position", "velocity"} and (flow or len(declared.writes) == 1)):
            yield Problem(
                f"a {declared.role} operator that writes {', '.join(declared.writes) or 'nothing'} is not carried out by this "
                f"version; it may write position or velocity{', or both' if flow else ''}",
                declared.location,
                name,
            )
        elif flow and len(declared.writes) == 2 and not _carries(declared):
            yield Problem(
                "it writes position and velocity, and so must be the whole motion of a particle on which nothing else acts, "
                "P' = P + V dt + ... with both read; write what moves particles otherwise as two operators",
                declared.location,
                name,
            )
        elif declared.role == "noise" and {"position", "velocity"} & set(declared.reads):
            yield Problem(
                "a noise operator holds what it gives for 1/24 s, and so may not read the position or the velocity; write "
                "what follows a particle as an acceleration, or as an applied velocity, of a field such as curl_noise",
                declared.location,
                name,
            )
        elif declared.role == "linear" and declared.writes == ("position",) and {"position", "velocity"} & set(declared.reads):
            yield Problem(
                "a linear operator whose rate of the position reads the position or the velocity is not carried out by "
                "this version; write it as a flow, the exact change over dt",
                declared.location,
                name,
            )


def _carries(declared: NodeType) -> bool:
    """Return whether a flow that gives position and velocity carries a particle by its velocity."""
    function = node_function(declared)
    return carries(declared.function, declared.arguments, function.arguments, declared.writes)


def _of_value(tree: Any, place: Value) -> Iterator[Problem]:
    if isinstance(tree, Value) and tree.path:
        place = tree
    if isinstance(tree, Name) and ("." in tree.name or tree.name == "id"):
        yield Problem(f"'{tree.name}' is not carried out by this version", place.location, place.path)
    if isinstance(tree, (Random, Node)) and tree.per not in SCOPES:
        yield Problem(
            f"draws per {tree.per} are not carried out by this version; choose one of {', '.join(SCOPES)}",
            place.location,
            place.path,
        )
    for part in children(tree):
        yield from _of_value(part, place)
