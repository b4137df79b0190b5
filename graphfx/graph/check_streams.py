"""Who takes whose stream: `from`, `inputs`, references to nodes, and circles among them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import pairwise

from graphfx.errors import Location, suggestion
from graphfx.graph.checking import Checking, declared, listed, nearest
from graphfx.graph.conditions import check_condition
from graphfx.graph.items import Item
from graphfx.graph.model import Entry, Graph, StreamReference
from graphfx.graph.moments import check_surfaces
from graphfx.graph.names import LOOKS, PICTURES
from graphfx.graph.values import Literal, parts_of
from graphfx.node import NodeType, Parameter

_TAKES_FROM = ("stack", "spawn", *PICTURES)


def references(checking: Checking, entry: Entry, item: Item, inside: bool) -> None:
    """Fill `sources` and `inputs` of a node from the document; what they name is looked up later."""
    given = item.value.get("from")
    path = f"{entry.path}.from"
    if entry.role == "group":
        _group_inputs(checking, entry, item, inside)
    elif inside:
        return
    elif entry.role in _TAKES_FROM or entry.kind in ("operators", "selectors"):
        if given is None and entry.kind == "selectors":
            return
        if given is None:
            checking.complain(item.location, entry.path,
                              f'{entry.type_name} needs "from", the id of the node whose particles it takes')
        else:
            entry.sources = _streams(checking, given, path, entry.role in PICTURES)


def _group_inputs(checking: Checking, entry: Entry, item: Item, inside: bool) -> None:
    group = entry.group
    assert group is not None
    given, named = item.value.get("from"), item.value.get("inputs")
    if inside:
        if named is not None:
            checking.complain(named.location, f"{entry.path}.inputs",
                              "a group in a stack takes the stack's stream; leave 'inputs' out")
        return
    if given is not None and len(group.inputs) != 1:
        names = ", ".join(group.inputs) or "none"
        checking.complain(given.location, f"{entry.path}.from", f"{entry.type_name} has {len(group.inputs)} inputs ({names}); "
                          + ('write "inputs": {name: id, ...}' if group.inputs else "leave 'from' out"))
    elif given is not None:
        entry.inputs[next(iter(group.inputs))] = _streams(checking, given, f"{entry.path}.from", False)
    if named is not None and not named.is_object:
        checking.mismatch(named, f"{entry.path}.inputs", "\"inputs\" should be an object {name: id}")
    for name, value in named.entries() if named is not None else ():
        if name not in group.inputs:
            checking.complain(named.key_location(name), f"{entry.path}.inputs.{name}",  # type: ignore[union-attr]
                              f"{entry.type_name} has no input '{name}'." + suggestion(name, group.inputs),
                              f"its inputs: {', '.join(group.inputs) or 'none'}")
        else:
            entry.inputs[name] = _streams(checking, value, f"{entry.path}.inputs.{name}", False)
    for name in group.inputs:
        if name not in entry.inputs and (given is None or len(group.inputs) != 1):
            way = f'"from": id or "inputs": {{"{name}": id}}' if len(group.inputs) == 1 else f'"inputs": {{"{name}": id}}'
            checking.complain(item.location, entry.path, f"{entry.type_name} needs a stream for its input '{name}': write {way}")


def _streams(checking: Checking, item: Item, path: str, looks: bool) -> list[StreamReference]:
    single = not item.is_list
    found = []
    for index, given in enumerate([item] if single else item.value):
        at = path if single else f"{path}[{index}]"
        if given.is_text:
            node, _, port = given.value.partition(".")
            found.append(StreamReference(node, port, given.location, at))
        elif looks and given.is_object:
            found += _look(checking, given, at)
        else:
            shape = "the id of a node, or {\"stream\": id, ...}" if looks else "the id of a node, or a list of them"
            checking.mismatch(given, at, f"'from' should be {shape}")
    if not single and not item.value:
        checking.complain(item.location, path, "the list is empty; name at least one node whose particles are taken")
    return found


def _look(checking: Checking, item: Item, path: str) -> list[StreamReference]:
    checking.unknown_keys(item, path, ("stream", *LOOKS), "an entry of 'from'")
    looks: dict[str, object] = {}
    for key, choices in LOOKS.items():
        given = item.value.get(key)
        if given is None:
            continue
        curved = key == "falloff" and given.is_object
        found = _curve(checking, given, f"{path}.{key}") if curved else checking.choice(given, f"{path}.{key}", key, choices)
        if found:
            looks[key] = found
    stream = item.value.get("stream")
    if stream is None:
        checking.complain(item.location, path, 'this entry needs "stream", the id of the node whose particles are drawn')
        return []
    text = checking.text(stream, f"{path}.stream", "a stream, the id of a node,")
    node, _, port = text.partition(".")
    return [StreamReference(node, port, stream.location, f"{path}.stream", looks)] if text else []


def _curve(checking: Checking, item: Item, path: str) -> tuple[tuple[float, float], ...]:
    """Return the points of a falloff of one's own: pairs of q = distance / radius and the opacity there, both 0 to 1."""
    checking.unknown_keys(item, path, ("ramp",), "a falloff")
    ramp = item.value.get("ramp")
    if ramp is None and item.value:
        return ()
    rows = ramp.value if ramp is not None and ramp.is_list else []
    pairs = [row.value for row in rows if row.is_list and len(row.value) == 2]
    points = [(float(q.value), float(opacity.value)) for q, opacity in pairs if q.is_number and opacity.is_number]
    rising = all(one[0] < other[0] for one, other in pairwise(points))
    inside = all(0 <= q <= 1 and 0 <= opacity <= 1 for q, opacity in points)
    if len(points) == len(rows) and rising and inside and any(opacity > 0 for _, opacity in points):
        return tuple(points)
    wanted = 'a falloff of one\'s own is {"ramp": [[q, opacity], ...]}: q is the distance from the centre over the radius, '
    checking.complain((ramp or item).location, path, wanted + "both numbers from 0 to 1, q rising, and some opacity more than 0")
    return ()


def _drawable(checking: Checking, node: Entry, reference: StreamReference) -> bool:
    """Complain where polygons are given what only a stream has."""
    if reference.port:
        checking.complain(reference.location, reference.path,
                          f"'{node.name}' is polygons and has no outputs; write '{node.name}'")
    elif reference.looks:
        checking.complain(reference.location, reference.path,
                          f"{', '.join(reference.looks)}: particles have that, and '{node.name}' is polygons; write its id alone")
    return not (reference.port or reference.looks)


def check_stream(checking: Checking, graph: Graph, reference: StreamReference, drawn: bool = False) -> bool:
    """Complain unless a reference names a node that makes such a stream, or is drawn as polygons where that may be."""
    name, path = reference.node, reference.path
    if name in graph.inputs:
        if reference.port:
            checking.complain(reference.location, path,
                              f"'{name}' is an input of this group, one stream; leave '.{reference.port}' out")
        return not reference.port
    node = graph.nodes.get(name)
    if drawn and node is not None and node.role == "polygons":
        return _drawable(checking, node, reference)
    if node is None:
        makers = [*graph.inputs, *(known for known, entry in graph.nodes.items() if entry.streams)]
        checking.complain(reference.location, path, f"there is no node '{name}'." + nearest(name, makers),
                          f"nodes that make a stream: {listed(makers)}")
        return False
    if not node.role or (node.group and not node.group.sound):
        return False
    if not node.streams:
        makers = [known for known, entry in graph.nodes.items() if entry.streams]
        checking.complain(reference.location, path,
                          f"'{name}' is a node of type {node.type_name}, which makes no stream of particles"
                          + ('; give it "from", and it passes on those that fit' if node.kind == "selectors" else ""),
                          f"nodes that make a stream: {listed(makers)}")
        return False
    ports = [port for port in node.streams if port]
    if reference.port and reference.port not in ports:
        near = suggestion(reference.port, ports)
        checking.complain(reference.location, path, f"'{name}' has no output '{reference.port}'." + near,
                          f"its outputs: {', '.join(ports)}" if ports else f"it makes one stream; write '{name}'")
        return False
    if not reference.port and len(ports) > 1:
        checking.complain(reference.location, path, f"'{name}' has {len(ports)} outputs; write one of "
                          + ", ".join(f"'{name}.{port}'" for port in ports))
        return False
    return True


def check_references(checking: Checking, graph: Graph, meshes: Iterable[Literal] = ()) -> None:
    """Check all streams, references, selectors and meshes that values name, then look for circles."""
    for mesh in dict.fromkeys(meshes):
        _check_target(checking, graph, Parameter("mesh", "mesh", None), mesh.value, mesh.location, mesh.path)
    for entry in walk(graph):
        for reference in streams_of(entry):
            check_stream(checking, graph, reference, entry.role in PICTURES)
        parameters = entry.group.params if entry.group else entry.node_type.parameters if entry.node_type else {}
        for name, (target, location) in entry.references.items():
            parameter = replace(parameters[name.partition("[")[0]], name=name)
            _check_target(checking, graph, parameter, target, location, f"{entry.path}.{name}", entry.node_type)
        if entry.kind == "geometry":
            _check_geometry(checking, entry)
        check_condition(checking, graph, entry.only)
        check_surfaces(checking, graph, entry)
    _check_circles(checking, graph)


def _check_target(checking: Checking, graph: Graph, parameter: Parameter, target: str, location: Location, path: str,
                  node_type: NodeType | None = None) -> None:
    """Check a parameter that names a node; its `choices` are the node types that it may name."""
    def fits(node: Entry) -> bool:
        if parameter.type == "selector":
            return node.kind == "selectors"
        if parameter.type in ("mesh", "surface"):
            return node.kind == "geometry"
        return bool(node.streams) if parameter.type == "stream" else not parameter.choices or node.type_name in parameter.choices

    wanted = " or ".join(parameter.choices) or {"node": "node", "mesh": "geometry node"}.get(parameter.type, parameter.type)
    wanted = ("an " if wanted[0] in "aeiou" else "a ") + wanted
    known = [name for name, node in graph.nodes.items() if fits(node)]
    note = f"nodes that fit: {listed(known)}"
    node = graph.nodes.get(target)
    if node is None:
        checking.complain(location, path, f"there is no node '{target}'." + nearest(target, known), note,
                          declared(node_type) if node_type and not known else "")
    elif node.role and not fits(node):
        checking.complain(location, path,
                          f"{parameter.name} should be the id of {wanted}; '{target}' is a node of type {node.type_name}", note)


def _check_geometry(checking: Checking, entry: Entry) -> None:
    """Complain of a geometry that takes points of a mesh, which might be its own."""
    for value in entry.arguments.values():
        mesh = next((part for part in parts_of(value) if isinstance(part, Literal) and part.type == "mesh"), None)
        if mesh is not None:
            checking.complain(value.location, value.path, f"what a geometry is made of reads no mesh; this reads '{mesh.value}'")


def walk(graph: Graph) -> Iterator[Entry]:
    """Yield all nodes of a graph, and the operators of its stacks."""
    for node in graph.nodes.values():
        yield node
        yield from node.ops


def streams_of(entry: Entry) -> Iterator[StreamReference]:
    """Yield all streams that a node takes."""
    yield from entry.sources
    for sources in entry.inputs.values():
        yield from sources


def _check_circles(checking: Checking, graph: Graph) -> None:
    """Put the nodes in order, sources first; complain of each circle of nodes that take from one another, with its names."""
    done: set[str] = set()
    for start in graph.nodes:
        trail: dict[str, Iterator[StreamReference]] = {}
        if start not in done:
            trail[start] = streams_of(graph.nodes[start])
        while trail:
            last = next(reversed(trail))
            reference = next(trail[last], None)
            if reference is None:
                del trail[last]
                done.add(last)
                graph.order.append(last)
            elif reference.node in trail:
                names = list(trail)
                circle = " -> ".join([*names[names.index(reference.node):], reference.node][::-1])
                checking.complain(reference.location, reference.path, f"these nodes take from one another in a circle: {circle}; "
                                  "particles must come from an emitter; break it at one of them")
            elif reference.node in graph.nodes and reference.node not in done:
                trail[reference.node] = streams_of(graph.nodes[reference.node])
