"""Declare node types and find them."""

from graphfx.node.declare import geometry, language, operator, selector, value
from graphfx.node.library import Library, bundled_root, library_roots
from graphfx.node.signature import param
from graphfx.node.types import (
    ATTRIBUTES,
    COMMON_KEYS,
    DERIVED_ATTRIBUTES,
    INFINITY,
    NUMERIC_TYPES,
    OTHER_NAMES,
    RESERVED,
    Attribute,
    NodeType,
    Parameter,
)

__all__ = [
    "ATTRIBUTES", "COMMON_KEYS", "DERIVED_ATTRIBUTES", "INFINITY", "NUMERIC_TYPES", "OTHER_NAMES", "RESERVED", "Attribute",
    "Library", "NodeType", "Parameter", "bundled_root", "geometry", "language", "library_roots", "operator", "param", "selector",
    "value",
]
