"""Say what a graph asks for that this version does not carry out yet: all of it at once, before any work."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from graphfx.errors import GraphError, Problem
from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.values import Literal
from graphfx.motion.probe import carries
from graphfx.node import DERIVED_ATTRIBUTES, INFINITY, NUMERIC_TYPES, NodeType
from graphfx.plan.hits import response_of
from graphfx.plan.holder import ENDING_ROLES, SETTING_ROLES, Holder, moment_of, names_in
from graphfx.plan.liveness import values_of
from graphfx.plan.values import node_function

MOVING_ROLES = ("linear", "flow", "acceleration", "velocity", "noise", "surface")


def check_support(flat: FlatGraph, order: list[str]) -> None:
    """Raise GraphError with everything among the nodes that run that cannot be carried out."""
    problems = [problem for path in order for problem in _of_node(flat.nodes[path])]
    if problems:
        raise GraphError(problems)


def _of_node(node: FlatNode) -> Iterator[Problem]:
    path, place = f"nodes.{node.path}", node.location
    role = node.node_type.role
    if node.node_type.kind == "operators" and role not in (*MOVING_ROLES, *SETTING_ROLES, *ENDING_ROLES):
        yield Problem(
            f"operators of the kind '{role}' are not carried out by this version; leave '{node.node_type.name}' out, "
            'or switch it off with "enabled": false',
            place,
            path,
        )
    particles = not node.node_type.language and node.node_type.kind != "geometry"
    for parameter in node.node_type.parameters.values() if particles else ():
        if parameter.type not in (*NUMERIC_TYPES, "mesh") and parameter.name in node.node_type.arguments:
            yield Problem(
                f"its parameter '{parameter.name}' is a {parameter.type}, and functions for particles are given "
                f"{', '.join(NUMERIC_TYPES)} alone in this version",
                node.node_type.location,
                node.node_type.name,
            )
    yield from _of_type(node)


def _of_type(node: FlatNode) -> Iterator[Problem]:
    """Yield what a node type declares that is not carried out."""
    declared, name = node.node_type, node.node_type.name
    if "id" in declared.reserved:
        yield Problem("functions for particles are not given 'id' in this version", declared.location, name)
    if declared.role in ("linear", "flow", "noise"):
        flow = declared.role == "flow"
        if not (set(declared.writes) <= {"position", "velocity"} and (flow or len(declared.writes) == 1)):
            yield Problem(
                f"a {declared.role} operator that writes {', '.join(declared.writes)} is not carried out by this "
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


def _carries(declared: NodeType) -> bool:
    """Return whether a flow that gives position and velocity carries a particle by its velocity."""
    function = node_function(declared)
    return carries(declared.function, declared.arguments, function.arguments, declared.writes)


def check_names(holders: Mapping[str, Holder], flat: FlatGraph) -> None:
    """Raise GraphError where a value reads what the particles that reach it do not have: a cluster of another emitter."""
    problems = []
    roles = {node.node_type.role for node in flat.nodes.values()}
    for holder in holders.values():
        known = {*holder.table, *DERIVED_ATTRIBUTES, *holder.clusters}
        for node in (*holder.operators, *holder.spawns):
            for value in values_of(node):
                for name in sorted(names_in(value) - known - (node.sets.keys() if node in holder.spawns else set())):
                    if "." not in name:
                        whose = f"the particles of '{holder.path}' have no '{name}'; if it is a cluster, give it to their emitter"
                        problems.append(Problem(whose, value.location if value.location.line else node.location, value.path))
        problems += [*_orphans(holder), *_unheard(holder, roles)]
    if problems:
        raise GraphError(problems)


def _orphans(holder: Holder) -> Iterator[Problem]:
    """Yield what would recycle particles of a spawn: there is no parent from which they could be born again."""
    for node in holder.of_role("recycle") if holder.maker.node_type.role == "spawn" else ():
        yield Problem(
            f"recycle lets particles be born again as their emitter makes them, and those of the spawn '{holder.path}' "
            'have no emitter; recycle its parents, or have it add to an emitter with "into"',
            node.location,
            f"nodes.{node.path}",
        )


def _unheard(holder: Holder, roles: set[str]) -> Iterator[Problem]:
    """Yield what waits for events that cannot be: hits where nothing is met, deaths of what lives for ever.

    `roles` are those of all nodes of the graph, switched off ones too: what could be switched on is no mistake.
    """
    life = holder.value("life")
    immortal = not holder.varies("life") and isinstance(life, Literal) and life.value == INFINITY
    immortal &= not ({"kill", "recycle"} & roles or any(response_of(node) == "die" for node in holder.of_role("surface")))
    for node in (*holder.operators, *holder.spawns):
        moment = moment_of(node) if node.node_type.role in (*SETTING_ROLES, *ENDING_ROLES, "spawn") else ""
        if moment == "hit" and "surface" not in roles:
            what = f"the particles of '{holder.path}' meet no surface; put one such as bounce_plane into their stack"
        elif moment == "death" and immortal:
            what = f"the particles of '{holder.path}' never die; give them a life, or a kill"
        else:
            continue
        yield Problem(f"{node.node_type.name} waits for a {moment}, and {what}", node.location, f"nodes.{node.path}")
