"""Which attributes of a source's particles are stored: only what something kept reads, and that differs."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Literal, Value
from graphfx.node import INFINITY
from graphfx.plan.holder import SETTING_ROLES, Holder, draws_in, is_brownian, moment_of, names_in
from graphfx.plan.rates import lane_type
from graphfx.plan.shutter import Exposure

MEASURED = "what is measured"
"""A reader that is no part of the graph."""


@dataclass
class Attributes:
    """`columns` maps what is stored to the store's column type; `constants` what is one for all to its value.

    `reasons` says for each column who reads it. `unread` are those that differ and that nobody reads. `types` are
    the lane types of what is stored for values; the rest is the engine's own.
    """

    columns: dict[str, str] = field(default_factory=dict)
    constants: dict[str, Value] = field(default_factory=dict)
    reasons: dict[str, str] = field(default_factory=dict)
    unread: list[str] = field(default_factory=list)
    types: dict[str, str] = field(default_factory=dict)
    read: frozenset[str] = frozenset()
    """All that is read, stored or not."""

    def store(self, name: str, type_: str, reason: str, lane: str = "") -> None:
        """Have an attribute stored."""
        self.columns[name], self.reasons[name] = type_, reason
        if lane:
            self.types[name] = lane


def values_of(node: FlatNode) -> list[Value]:
    """Return all values that a node is given, its condition among them."""
    return [*node.arguments.values(), *node.sets.values(), *([node.only] if node.only is not None else [])]


def _read_by(node: FlatNode) -> set[str]:
    """Return the names that an operator reads, apart from the attributes that a `set` of it gives."""
    values = [*node.arguments.values(), *([node.only] if node.only is not None else [])]
    return set(node.node_type.reads).union(*(names_in(value) for value in values))


@dataclass
class Reading:
    """Who reads what of a source: `readers` by name of the attribute, each with one reader."""

    holder: Holder
    readers: dict[str, str] = field(default_factory=dict)

    def note(self, names: Iterable[str], reader: str) -> None:
        """Note that somebody reads names; `birth.x` of what never changes is x itself."""
        for name in sorted(names):
            if name.startswith("birth.") and name[6:] not in self.holder.written:
                name = name[6:]
            if not name.startswith(("parent.", "hit.")):
                self.readers.setdefault(name, reader)
            if name == "normalized_age":
                self.readers.setdefault("life", reader)

    def operators(self) -> None:
        """Note what the operators read: those that set attributes count only if what they set is read."""
        for node in self.holder.operators:
            if node.node_type.role not in SETTING_ROLES:
                self.note(_read_by(node), node.path)
        if self.holder.moves:
            self.note(["velocity", "position"], "the motion")
        for node in self.holder.of_role("recycle"):
            self.note(["lives"], node.path)
        for node in self.holder.adders:
            self.note(["generation"], node.path)
        setting = self.holder.of_role(*SETTING_ROLES)
        noted: set[tuple[str, str]] = set()
        while True:
            found = [(node, name) for node in setting for name in self.targets(node) if (node.path, name) not in noted]
            if not found:
                return
            for node, name in found:
                noted.add((node.path, name))
                self.note(_read_by(node), node.path)
                self.note(names_in(node.sets[name]) if name in node.sets else (), node.path)

    def targets(self, node: FlatNode) -> list[str]:
        """Return the attributes that a setting operator gives and that are read; at birth as `birth.x` as well."""
        at_birth = moment_of(node) == "birth"
        return [name for name in node.gives if name in self.readers or (at_birth and f"birth.{name}" in self.readers)]


def find_attributes(reading: Reading, exposure: Exposure, prune: bool = True) -> Attributes:
    """Decide what is stored; without `prune`, all attributes are."""
    holder, readers = reading.holder, reading.readers
    if not prune:
        for name in (*holder.table, "age"):
            readers.setdefault(name, "nothing")
        for value in (value for node in holder.of_role(*SETTING_ROLES) for value in values_of(node)):
            for name in names_in(value):
                readers.setdefault(name, "nothing")
    found = Attributes(read=frozenset(name for name, reader in readers.items() if reader != "nothing"))
    for name, attribute in holder.table.items():
        if name == "life":
            continue
        differs = holder.varies(name) or not prune
        if name in readers and differs:
            lane = lane_type(attribute.type)
            found.store(name, lane, f"read by {readers[name]}", lane)
        elif differs:
            found.unread.append(name)
        else:
            found.constants[name] = holder.value(name)
        _note_birth(found, holder, readers, name)
    _add_tails(found, holder, readers)
    _add_hidden(found, reading, exposure)
    return found


def _note_birth(found: Attributes, holder: Holder, readers: dict[str, str], name: str) -> None:
    """Store the value at birth of what changes, where it is read."""
    at_birth = f"birth.{name}"
    if at_birth not in readers:
        return
    if holder.varies_at_birth(name):
        lane = lane_type(holder.table[name].type)
        found.store(at_birth, lane, f"read by {readers[at_birth]}", lane)
    else:
        found.constants[at_birth] = holder.value(name)


def _add_tails(found: Attributes, holder: Holder, readers: dict[str, str]) -> None:
    for node in holder.of_role("set"):
        for name in node.sets:
            if name.startswith("tail.") and name in readers:
                lane = lane_type(holder.table[name[5:]].type)
                found.store(name, lane, f"set by {node.path}, for the renderer", lane)


def _add_hidden(found: Attributes, reading: Reading, exposure: Exposure) -> None:
    holder, readers = reading.holder, reading.readers
    life = holder.value("life")
    differs = holder.varies("life")
    mortal = differs or not (isinstance(life, Literal) and life.value == INFINITY)
    if differs:
        found.store("life", "float", "read at death", "float")
    else:
        found.constants["life"] = life
    if mortal or {"age", "normalized_age"} & readers.keys():
        found.store("birth", "time", "for age and death")
    elif any(map(is_brownian, holder.operators)):
        found.store("birth", "time", "since when Brownian noise moves it")
    elif exposure.deep:
        found.store("birth", "time", "since when it is seen, for motion blur")
    needs_id = _needs_id(reading)
    if needs_id:
        found.store("id", "id", needs_id)
    for name in holder.clusters:
        if name in readers or (holder.of_role("recycle") and reads_at_birth(holder, found, name)):
            found.store(name, "float", f"read by {readers.get(name, 'recycle')}", "float")
    for instant in exposure.instants if "position" in found.columns and "position" in holder.written else ():
        found.store(instant.column, "vec3", instant.reason)
    if holder.of_role("surface"):
        found.store("resting", "mask", "who has come to rest on a surface")
    for spawn in holder.spawns:
        if moment_of(spawn) == "rate":
            found.store(f"made {spawn.path}", "time", "how far it is with its next spawn")


def _needs_id(reading: Reading) -> str:
    """Return why particles need their ids, or '' where they do not."""
    holder = reading.holder
    for node in holder.operators:
        if node.node_type.draws or "id" in node.node_type.reserved or any(draws_in(value) for value in values_of(node)):
            return "keys the random numbers of the operators"
    if holder.spawns:
        return f"names the parents of {holder.spawns[0].path}"
    if holder.of_role("recycle"):
        return "keys the random numbers of later lives"
    if reading.readers.get("id") in ("the renderer", MEASURED):
        return f"read by {reading.readers['id']}"
    return "keys the random numbers of a picture's selection" if "id" in reading.readers else ""


def reads_at_birth(holder: Holder, found: Attributes, cluster: str) -> bool:
    """Tell whether the birth of a stored attribute reads a cluster's number."""
    stored = [name for name in found.columns if name in holder.table]
    return any(cluster in names_in(holder.value(name)) for name in holder.birth_order(stored))


def reads_of_spawn(holder: Holder, maker: FlatNode, parents: list[Holder], stored: Iterable[str]) -> set[str]:
    """Return what a spawn reads of its parents: for how many there are, and for the attributes that are stored."""
    of_parents = [maker.arguments[name] for name in ("count", "probability", "rate")]
    found = set().union(*(names_in(value) for value in (*of_parents, *([maker.only] if maker.only is not None else []))))
    of_children = [holder.value_from(maker, name, parents) for name in holder.birth_order(list(stored), maker)]
    for value in (*of_children, maker.arguments["spread"], maker.arguments["life"]):
        found |= {name[7:] for name in names_in(value) if name.startswith("parent.")}
    found |= holder.clusters.keys() & set(stored).union(*(names_in(value) for value in of_children))
    if moment_of(maker) == "hit":
        found.add("hits")
    if "into" in maker.references:
        found.add("generation")
    return {name.removeprefix("parent.") for name in found if not name.startswith("hit.")}
