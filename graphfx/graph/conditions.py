"""`only`: a condition, which may name selector nodes and be made of conditions by all, any and not."""

from __future__ import annotations

import json
from typing import Any

from graphfx.graph.check_values import ValueReader
from graphfx.graph.checking import Checking, listed, nearest
from graphfx.graph.items import Item
from graphfx.graph.model import Graph
from graphfx.graph.names import CONDITIONS, ID
from graphfx.graph.scope import Scope
from graphfx.graph.values import Call, Expression, Literal, Value, parts_of
from graphfx.node import Parameter

_ONLY = Parameter("only", "bool", None, doc="Particles that it acts on.")
_JOINED = {"all": "and", "any": "or"}
_MEANT = {"and": "all", "or": "any"}


def is_selector(tree: Any) -> bool:
    """Return whether a part of a condition stands for the test of a selector node."""
    return isinstance(tree, Literal) and tree.type == "selector"


class ConditionReader:
    """Reads the conditions of one graph."""

    def __init__(self, checking: Checking, reader: ValueReader):
        """Complain to `checking`; read values by `reader`."""
        self.checking, self.reader = checking, reader

    def read(self, item: Item, scope: Scope, key: str) -> Value | None:
        """Return a condition, or None after a complaint; selectors that it names are looked up later."""
        path = f"{scope.path}.{key}"
        tree = self._read(item, scope, key)
        if tree is None or (isinstance(tree, Value) and not is_selector(tree)):
            return tree
        return self.reader.within_limits(Expression("bool", item.location, path, "", tree), item, path)

    def _read(self, item: Item, scope: Scope, key: str) -> Any:
        """Return a tree of calls, values and literals that stand for selectors, or None after a complaint."""
        path = f"{scope.path}.{key}"
        if item.is_text:
            return Literal("selector", item.location, path, "", item.value)
        found = [name for name, _ in item.entries() if name in CONDITIONS]
        joining = next((word for word, _ in item.entries() if word in _MEANT), "")
        if joining and not found:
            self.checking.complain(item.key_location(joining), f"{path}.{joining}",
                                   f'conditions are joined by "{_MEANT[joining]}": {{"{_MEANT[joining]}": [...]}}')
            return None
        if not found:
            return self.reader.read(item, _ONLY, scope, key)
        if len(list(item.entries())) > 1:
            self.checking.unknown_keys(item, path, found[:1], f"the condition '{found[0]}'",
                                       f'a condition is one of {{"{found[0]}": ...}}, {{"expr": ...}} or a selector; '
                                       'several are joined by {"all": [...]} or {"any": [...]}')
            return None
        name = found[0]
        inner = item.value[name]
        if name == "not" and inner.is_list:
            self.checking.mismatch(inner, f"{path}.not", "not takes one condition; write {\"not\": {\"any\": [...]}} for several")
            return None
        if name == "not":
            part = self._read(inner, scope, f"{key}.not")
            return None if part is None else Call("not", (part,))
        if not inner.is_list or not inner.value:
            self.checking.mismatch(inner, f"{path}.{name}", f"{name} should be a list of at least one condition")
            return None
        parts = [self._read(given, scope, f"{key}.{name}[{index}]") for index, given in enumerate(inner.value)]
        return None if any(part is None for part in parts) else _joined(_JOINED[name], parts)


def _joined(function: str, parts: list[Any]) -> Any:
    """Return one condition of many, as a balanced tree."""
    if len(parts) == 1:
        return parts[0]
    half = len(parts) // 2
    return Call(function, (_joined(function, parts[:half]), _joined(function, parts[half:])))


def check_condition(checking: Checking, graph: Graph, condition: Value | None) -> None:
    """Complain of names in a condition that are no selector nodes."""
    known = [name for name, node in graph.nodes.items() if node.kind == "selectors"]
    for named in filter(is_selector, parts_of(condition)):
        node = graph.nodes.get(named.value)
        if node is None and not ID.fullmatch(named.value):
            message = f"a text is the id of a selector; a condition is written {{\"expr\": {json.dumps(named.value[:100])}}}"
        elif node is None:
            message = f"there is no node '{named.value}'." + nearest(named.value, known)
        elif node.role and node.kind != "selectors":
            message = f"only should be the id of a selector; '{named.value}' is a node of type {node.type_name}"
        else:
            continue
        checking.complain(named.location, named.path, message, f"nodes that fit: {listed(known)}")
