"""`when`: the moment at which a node acts, and the surfaces whose hits count."""

from __future__ import annotations

from graphfx.graph.checking import Checking, listed, nearest
from graphfx.graph.items import Item
from graphfx.graph.model import Entry, Graph
from graphfx.graph.names import MOMENTS


def is_hit(item: Item | None) -> bool:
    """Return whether a `when` means a hit."""
    return item is not None and (item.value == "hit" or (item.is_object and "hit" in item.value))


def read_moment(checking: Checking, entry: Entry, item: Item) -> None:
    """Fill `when`, which stays '' at the default, and `surfaces`; what they name is looked up later."""
    path = f"{entry.path}.when"
    moments = tuple(moment for moment in MOMENTS.get(entry.role, ()) if moment)
    if not moments:
        checking.complain(item.location, path, f"{entry.type_name} acts through the whole step and has no moment; "
                          "leave 'when' out, or say \"during\"")
    elif item.is_object and "hit" in moments:
        _surfaces(checking, entry, item, path)
    else:
        found = checking.choice(item, path, "when", moments)
        entry.when = found if found != MOMENTS[entry.role][0] else ""


def _surfaces(checking: Checking, entry: Entry, item: Item, path: str) -> None:
    checking.unknown_keys(item, path, ("hit",), "'when'")
    given = item.value.get("hit")
    if given is None:
        checking.mismatch(item, path, 'when should be a moment, or {"hit": [surfaces]}')
    elif not given.is_list or not given.value:
        checking.mismatch(given, f"{path}.hit", "\"hit\" should be a list of the ids of surfaces; any hit is \"when\": \"hit\"")
    else:
        entry.when = "hit"
        for index, part in enumerate(given.value):
            text = checking.text(part, f"{path}.hit[{index}]", "a surface, the id of an operator,")
            if text:
                entry.surfaces.append((text, part.location))


def check_spawn(checking: Checking, entry: Entry, item: Item) -> None:
    """Complain unless a spawn says when it makes particles: at events or at a rate, and not both."""
    if "when" in item.value and "rate" in item.value:
        checking.complain(item.key_location("rate"), f"{entry.path}.rate", "spawn makes particles at events or at a rate; "
                          "keep \"when\" or \"rate\", or write two nodes")
    elif "when" not in item.value and "rate" not in item.value:
        checking.complain(item.location, entry.path,
                          f'{entry.type_name} needs "when": "birth", "hit" or "death", or a "rate" for each parent')
    elif "rate" in item.value and "count" in item.value:
        checking.complain(item.key_location("count"), f"{entry.path}.count", "with a rate particles are made one by one; "
                          "leave 'count' out, or say \"when\"")


def check_surfaces(checking: Checking, graph: Graph, entry: Entry) -> None:
    """Complain of surfaces that are none; a stack or a group stands for those inside it."""
    if not entry.surfaces:
        return
    places = {inner.place: inner for node in graph.nodes.values() for inner in (node, *node.ops)}
    known = [place for place, node in places.items() if node.has_surface]
    note = f"surfaces: {listed(known)}"
    for index, (target, location) in enumerate(entry.surfaces):
        path = f"{entry.path}.when.hit[{index}]"
        node = places.get(target)
        if node is None:
            checking.complain(location, path, f"there is no operator '{target}'." + nearest(target, known), note)
        elif node.role and not node.has_surface:
            is_none = "holds none" if node.role in ("stack", "group") else f"is of type {node.type_name}"
            checking.complain(location, path, f"a hit is on a surface, and '{target}' {is_none}", note)
