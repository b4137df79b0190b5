"""How large a graph may be: each limit is a clear refusal, and each can be raised."""

from __future__ import annotations

from dataclasses import dataclass

from graphfx.errors import UsageError

DEEPEST = 100
"""No document may nest deeper, whatever the limit asked for: reading recurses."""


@dataclass(frozen=True)
class Limits:
    """Limits on documents, before any work begins."""

    bytes: int = 16 * 2**20
    """Size of one document."""
    depth: int = 64
    """How deep objects and lists may nest in a document."""
    nodes: int = 100_000
    """Nodes of the flattened graph, operators of stacks and insides of groups included."""
    group_depth: int = 32
    """How deep groups may use groups."""
    expression: int = 2000
    """Characters of one expression."""
    expression_depth: int = 100
    """How deep an expression, or a value with all that it refers to, may nest."""
    value_size: int = 10_000
    """Parts of one value, with all that it refers to written out."""

    def __post_init__(self) -> None:
        """Refuse limits that make no sense."""
        for name in ("depth", "group_depth", "expression_depth"):
            if not 1 <= getattr(self, name) <= DEEPEST:
                raise UsageError(f"the limit '{name}' is {getattr(self, name)}; it can be 1 to {DEEPEST}")
        for name in ("bytes", "nodes", "expression", "value_size"):
            if getattr(self, name) < 1:
                raise UsageError(f"the limit '{name}' is {getattr(self, name)}; it must be at least 1")
