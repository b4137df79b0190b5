"""One source of particles with all that acts on it, and what its attributes are at birth."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from graphfx.graph.flat import Cluster, FlatNode
from graphfx.graph.names import MOMENTS, SCOPES
from graphfx.graph.values import Call, Expression, Literal, Member, Name, Node, Random, Value, children, parts_of
from graphfx.node import ATTRIBUTES, Attribute
from graphfx.plan.rates import CLOCK_NAMES, Rate, Scope, rate_of
from graphfx.plan.sources import Sources

SETTING_ROLES = ("set", "fade", "assign")
"""Roles of operators that give attributes new values."""
ENDING_ROLES = ("kill", "recycle")
ALWAYS_INHERITED = ("position", "life", "generation")
"""What a spawn's children have of their parents, whatever else they inherit: they start where those are."""


def names_in(tree: Any) -> set[str]:
    """Return the names that a value reads: attributes, clusters, `birth.x`, `parent.x`, `hit.x`; not the clock."""
    names: set[str] = set()
    for part in parts_of(tree):
        if isinstance(part, Name):
            names |= {part.name} - set(CLOCK_NAMES)
        elif isinstance(part, Node) and part.node_type is not None:
            names |= set(part.node_type.reads)
        if isinstance(part, (Random, Node)):
            names |= {"hits"} if part.per == "hit" else set() if part.per in SCOPES else {part.per}
    return names


def draws_in(tree: Any) -> bool:
    """Return whether a value draws random numbers for each particle, or reads its id."""
    return any(map(_draws_itself, parts_of(tree)))


def _draws_itself(part: Any) -> bool:
    """Return whether a part of a value draws for each particle, or reads its id, itself."""
    own = isinstance(part, Random) or (
        isinstance(part, Node) and part.node_type is not None and "draw" in part.node_type.reserved
    )
    scoped = part.per in ("life", "particle", "hit", "frame") or getattr(part, "vary", 0.0) > 0 if own else False
    reads = isinstance(part, Node) and part.node_type is not None and "id" in part.node_type.reserved
    return bool(scoped) or reads


def _beside_position(maker: FlatNode, name: str) -> Member | None:
    """Return the normal or the tangent that comes with a place on a mesh, where the position is one."""
    found: list[Node] = []
    waiting: list[Any] = [maker.sets.get("position")] if name in ("normal", "tangent") else []
    while waiting:
        tree = waiting.pop()
        if isinstance(tree, Node) and tree.node_type is not None and name in tree.node_type.results:
            found += [tree] if tree not in found else []
        waiting += children(tree)
    if len(found) != 1:
        return None
    index = found[0].node_type.results.index(name)  # type: ignore[union-attr]
    return Member("vec3", found[0].location, found[0].path, "", found[0], index)


def _draws(tree: Any) -> bool:
    """Return whether a value draws at all: its numbers are its own maker's."""
    return isinstance(tree, (Random, Node)) or any(map(_draws, children(tree)))


def _listed(maker: FlatNode) -> tuple[str, ...] | None:
    """Return the names of what a spawn's children inherit, None for all."""
    value = getattr(maker.arguments["inherit"], "value", None)
    return None if value is None else tuple(value)


def moment_of(node: FlatNode) -> str:
    """Return when an operator or a spawn acts: birth, step, frame, hit, death, or rate."""
    if node.node_type.role == "spawn" and "rate" in node.given:
        return "rate"
    return node.when or MOMENTS.get(node.node_type.role, ("step",))[0]


def is_brownian(node: FlatNode) -> bool:
    """Return whether an operator is noise that is a Wiener process."""
    return node.node_type.role == "noise" and getattr(node.arguments.get("process"), "value", "") == "brownian"


@dataclass(eq=False)
class Holder:
    """`maker` is an `emit` or a `spawn`, `adders` the spawns whose children join, `operators` what acts on the
    particles, `spawns` who takes them as parents, and `parents` whose particles a spawn's parents are."""

    maker: FlatNode
    table: dict[str, Attribute]
    adders: list[FlatNode] = field(default_factory=list)
    operators: list[FlatNode] = field(default_factory=list)
    spawns: list[FlatNode] = field(default_factory=list)
    parents: list[Holder] = field(default_factory=list)
    homes: dict[str, list[Holder]] = field(default_factory=dict)
    """The sources of the parents of each adder."""

    @property
    def path(self) -> str:
        """Return the maker's path."""
        return self.maker.path

    @property
    def changing(self) -> frozenset[str]:
        """Return the attributes that change within a frame, beside position and velocity."""
        nodes = [node for node in self.of_role(*SETTING_ROLES) if moment_of(node) in ("step", "hit")]
        return frozenset(name for node in nodes for name in node.gives) | {"hits"}

    @property
    def places_again(self) -> bool:
        """Return whether anything but motion puts particles somewhere in the course of a life."""
        return any("position" in node.gives for node in self.of_role(*SETTING_ROLES))

    def parents_of(self, maker: FlatNode) -> list[Holder]:
        """Return the sources of a maker's parents; an `emit` has none."""
        return self.parents if maker is self.maker else self.homes[maker.path]

    def of_role(self, *roles: str) -> list[FlatNode]:
        """Return the operators of some roles, in order."""
        return [node for node in self.operators if node.node_type.role in roles]

    @property
    def clusters(self) -> dict[str, Cluster]:
        """Return the numbers that its particles are given; what a spawn makes has those that all its parents have."""
        if not self.parents:
            return self.maker.clusters
        first, *others = [parent.clusters for parent in self.parents]
        return {name: cluster for name, cluster in first.items() if all(name in other for other in others)}

    def value(self, name: str) -> Value:
        """Return what an attribute is at birth."""
        return self.value_from(self.maker, name, self.parents)

    def value_from(self, maker: FlatNode, name: str, parents: list[Holder]) -> Value:
        """Return what a maker gives an attribute: what it sets, what a parent had, or the default."""
        if name == "life" and "life" in maker.given:
            return maker.arguments["life"]
        if name in maker.sets:
            return maker.sets[name]
        beside = _beside_position(maker, name)
        if beside is not None:
            return beside
        attribute = self.table[name]
        if name == "life" and maker.node_type.role == "emit":
            return maker.arguments["life"]
        if maker.node_type.role == "spawn":
            return self._inherited(maker, attribute, parents)
        return self._default(attribute)

    @staticmethod
    def _default(attribute: Attribute) -> Value:
        if attribute.follows:
            return Expression(attribute.type, tree=Name(attribute.follows))
        return Literal(attribute.type, value=attribute.default)

    def _inherited(self, maker: FlatNode, attribute: Attribute, parents: list[Holder]) -> Value:
        """Return what a spawn copies from the parent: the place always; one more of `generation`; hits and lives begin anew."""
        name = attribute.name
        if name in ("hits", "lives"):
            return Literal("float", value=0.0)
        listed = _listed(maker)
        if listed is not None and name not in (*listed, *ALWAYS_INHERITED):
            return self._default(attribute)
        tree: Any = Name(f"parent.{name}")
        if len(parents) == 1 and not parents[0].varies(name):
            same = parents[0].value(name)
            tree = tree if _draws(same) or names_in(same) else same
        if name == "generation":
            tree = Call("add", (tree, 1.0))
        return Expression(attribute.type, tree=tree)

    @cached_property
    def written(self) -> set[str]:
        """Return the attributes that change after birth, or differ by who made the particle."""
        found = {name for node in self.operators for name in node.node_type.writes}
        for node in self.of_role(*SETTING_ROLES):
            found |= {name for name in node.sets if name in self.table}
        if self.of_role("surface"):
            found |= {"position", "velocity", "hits"}
        if self.of_role("recycle"):
            found.add("lives")
        found |= self.made_apart
        return found | ({"position"} if self.moving(found) else set())

    @cached_property
    def made_apart(self) -> set[str]:
        """Return the attributes that differ at birth by who made the particle, or that are set or spread at birth."""
        at_birth = [node for node in self.of_role("set", "assign") if moment_of(node) == "birth"]
        found = {name for node in at_birth for name in node.gives if name in self.table}
        for adder in self.adders:
            found |= {"generation", *adder.sets, *(["life"] if "life" in adder.given else [])}
            listed = _listed(adder)
            found |= set() if listed is None else set(self.table) - {*listed, *ALWAYS_INHERITED}
            if self.homes[adder.path] != [self]:
                found |= set(self.table)
            if "spread" in adder.given:
                found.add("velocity")
        if "spread" in self.maker.given:
            found.add("velocity")
        return found

    def moving(self, written: set[str]) -> bool:
        """Return whether the particles' own velocities carry them."""
        velocity = self.value("velocity")
        return "velocity" in written or not (isinstance(velocity, Literal) and not any(velocity.value))

    @property
    def moves(self) -> bool:
        """Return whether the particles' own velocities carry them."""
        return self.moving(self.written)

    def varies_at_birth(self, name: str) -> bool:
        """Return whether an attribute differs by particle at birth."""
        if name not in self.table or name in self.made_apart:
            return True
        reading = Scope(0, "", None, None, lambda inner: inner != name and self.varies_at_birth(inner))  # type: ignore[arg-type]
        return rate_of(self.value(name), reading) > Rate.CONSTANT

    def varies(self, name: str) -> bool:
        """Return whether an attribute is not one for all particles at all times."""
        if name.startswith("birth."):
            return self.varies_at_birth(name[6:])
        return name not in self.table or name in self.written or self.varies_at_birth(name)

    def birth_order(self, wanted: list[str], maker: FlatNode | None = None) -> list[str]:
        """Return the attributes to find at birth, each after those that its value reads."""
        maker = maker or self.maker
        parents = self.parents_of(maker)
        ordered: list[str] = []

        def visit(name: str) -> None:
            if name in ordered or name not in self.table:
                return
            for read in sorted(names_in(self.value_from(maker, name, parents)) - {name}):
                visit(read)
            ordered.append(name)

        for name in wanted:
            visit(name)
        return ordered


def find_holders(sources: Sources) -> dict[str, Holder]:
    """Return all sources of a graph by path, parents first."""
    table = ATTRIBUTES | sources.flat.attributes
    holders: dict[str, Holder] = {}
    for path in sources.paths:
        maker, *adders = sources.makers(path)
        parents = [holders[parent] for parent in sources.parents(path)] if maker.node_type.role == "spawn" else []
        holders[path] = Holder(maker, table, adders, sources.operators(path), sources.spawns(path), parents)
    for holder in holders.values():
        holder.homes = {adder.path: [holders[parent] for parent in sources.parents(adder.path)] for adder in holder.adders}
    return holders
