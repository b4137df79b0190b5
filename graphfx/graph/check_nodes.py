"""Nodes and operators of a document to `Entry`s: types, keys, parameters, attributes and common keys."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from graphfx.errors import Location, suggestion
from graphfx.graph.check_streams import references
from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking, counted, declared, takes
from graphfx.graph.conditions import ConditionReader
from graphfx.graph.items import Item, shown
from graphfx.graph.model import Entry, Graph
from graphfx.graph.moments import check_spawn, is_hit, read_moment
from graphfx.graph.named import NamedValues
from graphfx.graph.names import ID, REFERENCE_TYPES, keys_of
from graphfx.graph.own import check_inherited, read_clusters
from graphfx.graph.scope import Scope
from graphfx.graph.sets import AttributeReader
from graphfx.graph.values import Node, Random, children
from graphfx.node import ATTRIBUTES, COMMON_KEYS, OTHER_NAMES, Parameter

_NODE_KINDS = ("emitters", "selectors", "operators", "renders", "geometry")
_ENABLED = Parameter("enabled", "bool", None)
_DURING = Parameter("during", "interval", None, unit="s")
_SETTLED = "it is decided before the cook, from parameters alone"


@dataclass
class NodeReader:
    """Reads the nodes of one graph; `values` are the graph's named values."""

    checking: Checking
    graph: Graph
    reader: ValueReader
    values: NamedValues

    def entry(self, name: str, item: Item, place: str, path: str, stack: str = "") -> Entry:
        """Return one node, or one operator of `stack`; where its type is wrong it has neither type nor group."""
        entry = Entry(name, place, path, item.location)
        if not item.is_object:
            known = item.is_text and (item.value in self.checking.library or item.value in self.graph.use)
            self.checking.mismatch(item, path, "a node should be an object with a \"type\""
                                   + (f': {{"type": "{item.value}"}}' if known else ""))
            return entry
        if not self._type(entry, item, bool(stack)):
            entry.node_type = entry.group = None
            return entry
        seed_key = item.value.get("seed_key")
        text = self.checking.text(seed_key, f"{path}.seed_key", "seed_key") if seed_key else ""
        entry.seed = f"={text}" if text else place
        self._keys(entry, item, bool(stack))
        self._common(entry, item)
        values = self.values
        if "values" in item.value and "values" in keys_of(entry.role, entry.kind):
            values = NamedValues(self.checking, self.reader, item.value["values"], self.scope(entry, item), self.values)
        self._arguments(entry, item, values)
        if "set" in keys_of(entry.role, entry.kind):
            scope = self.scope(entry, item, values)
            AttributeReader(self.checking, self.reader).read(entry, item.value.get("set"), of_the_born(entry, scope))
        references(self.checking, entry, item, bool(stack))
        if entry.role == "stack":
            self._ops(entry, item)
        return entry

    def scope(self, entry: Entry, item: Item, values: NamedValues | None = None, uniform: str = "") -> Scope:
        """Return what the values of a node may read."""
        values = values or self.values
        qualifiers = {"birth"} if entry.kind in ("operators", "selectors", "group") or entry.role == "spawn" else set()
        if entry.role == "spawn":
            qualifiers.add("parent")
        if is_hit(item.value.get("when")):
            qualifiers.add("hit")
        return replace(values.scope, path=entry.path, seed=entry.seed, uniform=uniform, qualifiers=frozenset(qualifiers))

    def _type(self, entry: Entry, item: Item, inside: bool) -> bool:
        given = item.value.get("type")
        if given is None:
            self.checking.complain(item.location, entry.path, 'this node has no "type"; say what it is, such as "type": "emit"')
            return False
        name = entry.type_name = self.checking.text(given, f"{entry.path}.type", "a type")
        entry.type_location = given.location
        library = self.checking.library
        if not name:
            return False
        if name in self.graph.use:
            entry.group = self.graph.use[name]
        elif name in library and library.kind_of(name) != "values":
            entry.node_type = self.checking.node_type(name)
        elif name in library:
            self.checking.complain(given.location, f"{entry.path}.type", f"'{name}' is a value, not a node; "
                                   f'give it to a parameter or an attribute: {{"{name}": {{...}}}}')
        elif f"use.{name}" not in self.graph.broken:
            near = suggestion(name, [*self.checking.types_of(*_NODE_KINDS), *self.graph.use], library.other_names)
            self.checking.complain(given.location, f"{entry.path}.type", f"there is no node type '{name}'." + near,
                                   "" if near else f'a group is named under "use": {{"{name}": "groups/{name}.json"}}')
        if entry.node_type is None and entry.group is None:
            return False
        return self._stands(entry, given.location, inside)

    def _stands(self, entry: Entry, location: Location, inside: bool) -> bool:
        """Complain where a type may not stand in a stack."""
        if not inside:
            return True
        name, path = entry.type_name, f"{entry.path}.type"
        if entry.group is not None:
            if not entry.group.sound or len(entry.group.inputs) == len(entry.group.outputs) == 1:
                return True
            self.checking.complain(location, path, f"{name} has {counted(len(entry.group.inputs), 'input')} and "
                                   f"{counted(len(entry.group.outputs), 'output')}, and a stack holds groups with one of each; "
                                   "make it a node of its own")
            return False
        if entry.kind == "operators" and entry.role != "stack":
            return True
        what = "not another stack" if entry.role == "stack" else f"and {name} is one of the {entry.kind}"
        self.checking.complain(location, path, f"a stack holds operators and groups, {what}; make it a node of its own")
        return False

    def _keys(self, entry: Entry, item: Item, inside: bool) -> None:
        """Complain of keys that this type does not take."""
        name, path = entry.type_name, entry.path
        parameters = self._parameters(entry)
        keys = [key for key in keys_of(entry.role, entry.kind) if key != ("from" if inside else "id")]
        where = declared(entry.node_type) if entry.node_type else f"declared in {entry.group.file}" if entry.group else ""
        for key, _ in item.entries():
            if key in parameters or key in keys:
                continue
            location, at = item.key_location(key), f"{path}.{key}"
            if key == "id":
                self.checking.complain(location, at, "a node's id is its key under \"nodes\"; leave 'id' out")
            elif key == "from" and inside:
                self.checking.complain(location, at, "the operators of a stack take the stack's stream; leave 'from' out")
            elif key in ATTRIBUTES and "set" in keys:
                self.checking.complain(location, at, f"'{key}' is an attribute; write it inside \"set\": {{\"{key}\": ...}}")
            elif key in COMMON_KEYS:
                self.checking.complain(location, at, f"{name} does not take '{key}'", f"its keys: {', '.join(keys)}")
            else:
                near = suggestion(key, [*parameters, *keys], OTHER_NAMES)
                self.checking.complain(location, at, f"{name} has no parameter '{key}'." + near,
                                       takes(name, parameters.values()), where)

    def _parameters(self, entry: Entry) -> dict[str, Parameter]:
        return entry.group.params if entry.group else entry.node_type.parameters if entry.node_type else {}

    def _common(self, entry: Entry, item: Item) -> None:
        scope = self.scope(entry, item)
        settled = replace(scope, uniform=_SETTLED, settled=True, names=())
        keys = keys_of(entry.role, entry.kind)
        if "doc" in item.value:
            self.checking.text(item.value["doc"], f"{entry.path}.doc", "doc")
        if "enabled" in item.value and "enabled" in keys:
            entry.enabled = self.reader.read(item.value["enabled"], _ENABLED, settled, "enabled")
        if "during" in item.value and "during" in keys and "during" not in self._parameters(entry):
            entry.during = self.reader.read(item.value["during"], _DURING, settled, "during")
        if "when" in item.value and "when" in keys:
            read_moment(self.checking, entry, item.value["when"])
        if "only" in item.value and "only" in keys:
            entry.only = ConditionReader(self.checking, self.reader).read(item.value["only"], scope, "only")
        if "clusters" in item.value and "clusters" in keys:
            read_clusters(self.reader, entry, item.value["clusters"], settled)
        if "per" in item.value and "per" in keys:
            entry.per = scope.per(self.checking, item.value["per"], f"{entry.path}.per")
        if entry.role == "spawn":
            check_spawn(self.checking, entry, item)

    def _arguments(self, entry: Entry, item: Item, values: NamedValues) -> None:
        parameters = self._parameters(entry)
        for parameter in parameters.values():
            given = item.value.get(parameter.name)
            path = f"{entry.path}.{parameter.name}"
            if given is None:
                if parameter.required:
                    notes = (takes(entry.type_name, parameters.values()), declared(entry.node_type) if entry.node_type else "")
                    self.checking.complain(item.location, entry.path, f"{entry.type_name} needs '{parameter.name}'"
                                           + (f": {parameter.doc}" if parameter.doc else ""), *notes)
            elif parameter.type == "nodes":
                self._named_nodes(entry, parameter, given, path)
            elif parameter.type in REFERENCE_TYPES and not (parameter.type == "mesh" and given.is_object):
                text = self.checking.text(given, path, f"{parameter.name}, the id of a node,")
                if text:
                    entry.references[parameter.name] = (text, given.location)
            else:
                scope = self.scope(entry, item, values, why_uniform(entry, parameter))
                if parameter.name in ATTRIBUTES:
                    scope = of_the_born(entry, scope)
                value = self.reader.read(given, parameter, scope, parameter.name)
                if value is not None:
                    entry.arguments[parameter.name] = value
        if entry.role == "spawn":
            check_inherited(self.checking, entry.arguments.get("inherit"), self.graph)

    def _named_nodes(self, entry: Entry, parameter: Parameter, given: Item, path: str) -> None:
        """Note the nodes of a list, each as `parameter[index]`."""
        if not given.is_list:
            self.checking.mismatch(given, path, f"{parameter.name} should be a list of ids of nodes")
        for index, item in enumerate(given.value if given.is_list else ()):
            name = f"{parameter.name}[{index}]"
            text = self.checking.text(item, f"{entry.path}.{name}", f"an entry of {parameter.name}, the id of a node,")
            if text:
                entry.references[name] = (text, item.location)

    def _ops(self, stack: Entry, item: Item) -> None:
        ops = item.value.get("ops")
        path = f"{stack.path}.ops"
        if ops is None:
            self.checking.complain(item.location, stack.path, 'a stack needs "ops", the list of its operators')
        elif not ops.is_list:
            self.checking.mismatch(ops, path, '"ops" should be a list of operators')
        if ops is None or not ops.is_list:
            return
        seen: dict[str, Location] = {}
        for index, given in enumerate(ops.value):
            at = f"{path}[{index}]"
            name = self._op_name(given, at)
            first = seen.get(name) if name != "?" else None
            stated = given.is_object and "id" in given.value
            own = name if first is None or stated else _next_name(name, seen)
            op = self.entry(own, given, f"{stack.place}/{own}", at, stack.name)
            if first is not None and (stated or _draws(op)):
                self.checking.complain(
                    given.value["id"].location if stated else op.type_location, f"{at}.{'id' if stated else 'type'}",
                    f"a second operator of this stack is called '{name}', the first at {first.line}:{first.column}; "
                    + ("choose another id" if stated
                       else f'as it draws random numbers, give it an id: {{"type": "{name}", "id": "{own}", ...}}'))
                continue
            seen[own] = op.type_location
            if op.role:
                stack.ops.append(op)

    def _op_name(self, item: Item, path: str) -> str:
        if not item.is_object:
            return "?"
        given = item.value.get("id")
        if given is not None:
            text = self.checking.text(given, f"{path}.id", "an id")
            if text and not ID.fullmatch(text):
                self.checking.complain(given.location, f"{path}.id", "an id is made of letters, digits, '_' and '-', and begins "
                                       f"with a letter; {shown(text)} is not")
            return text or "?"
        kind = item.value.get("type")
        return kind.value if kind is not None and kind.is_text else "?"


def of_the_born(entry: Entry, scope: Scope) -> Scope:
    """Return the scope of attributes that a node sets: what `spawn` makes is only being born, so its birth.x is none yet."""
    return replace(scope, qualifiers=scope.qualifiers - {"birth"}) if entry.role == "spawn" else scope


def _next_name(name: str, taken: Mapping[str, Location]) -> str:
    """Return a name that is not taken for another operator of a type."""
    number = 2
    while f"{name}_{number}" in taken:
        number += 1
    return f"{name}_{number}"


def _draws(op: Entry) -> bool:
    """Return whether an operator draws random numbers, which its name keys; a group may."""
    waiting: list[Any] = [*op.arguments.values(), *op.sets.values(), op.only]
    while waiting:
        tree = waiting.pop()
        if isinstance(tree, Random) or (isinstance(tree, Node) and tree.node_type and "draw" in tree.node_type.reserved):
            return True
        waiting += children(tree)
    return op.group is not None or bool(op.node_type and op.node_type.draws)


def why_uniform(entry: Entry, parameter: Parameter) -> str:
    """Return why a parameter cannot vary by particle, or '' where it can."""
    if entry.role == "emit" and parameter.name not in ATTRIBUTES:
        return f"{parameter.name} is one for the whole emitter; it may read time, frame and parameters"
    if entry.role == "spawn" and parameter.name == "generations":
        return f"{parameter.name} is one for the whole node; it may read time, frame and parameters"
    if entry.kind in ("renders", "geometry"):
        return f"{entry.type_name} has no particle to read; {parameter.name} may read time, frame and parameters"
    return ""
