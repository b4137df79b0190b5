"""What `graphfx nodes attributes` and `graphfx nodes expr` print: the words that graphs are written with."""

from __future__ import annotations

from graphfx.graph.checking import number
from graphfx.graph.functions import CONSTANTS, FUNCTIONS
from graphfx.node import ATTRIBUTES, DERIVED_ATTRIBUTES, Attribute

TOPIC = "attributes"


def _default(attribute: Attribute) -> str:
    if attribute.follows:
        return f"{attribute.follows} at birth"
    value = attribute.default
    return "[" + ", ".join(f"{part:g}" for part in value) + "]" if isinstance(value, tuple) else number(value)


def attribute_lines(names: tuple[str, ...] = ()) -> list[str]:
    """Return a line for each attribute, or for some: its type, its default, what it is."""
    known = {name: (attribute, _default(attribute)) for name, attribute in ATTRIBUTES.items()}
    known |= {name: (attribute, "only read") for name, attribute in DERIVED_ATTRIBUTES.items()}
    labels = {name: f"{name} [{attribute.unit}]" if attribute.unit else name for name, (attribute, _) in known.items()}
    width, widest = max(map(len, labels.values())), max(len(default) for _, default in known.values())
    return [
        f"{labels[name]:{width}}  {attribute.type:5}  {default:{widest}}  {attribute.doc}"
        for name, (attribute, default) in known.items()
        if name in names or not names
    ]


def describe_attributes() -> str:
    """Return all attributes of particles."""
    lines = [
        "Attributes of particles: given by `set` on emit, spawn and the operator set, read in expressions.",
        "",
        *(f"  {line}" for line in attribute_lines()),
        "",
        'A graph declares its own: "attributes": {"heat": {"type": "float", "default": 0, "unit": "K", "doc": "..."}}.',
        "birth.x is the value at birth; parent.x, in a spawn, the parent's; hit.normal, hit.point and hit.speed tell of a hit.",
        "tail.radius, tail.color and tail.opacity, given by the operator set, are those of a streak's other end.",
    ]
    return "\n".join(lines)


def function_lines() -> list[str]:
    """Return a line for each function and operator of expressions, and one for the constants."""
    width = max(len(function.spelling) for function in FUNCTIONS.values())
    lines = [f"{function.spelling:{width}}  {function.doc}" for function in FUNCTIONS.values()]
    return [*lines, f"constants: {', '.join(CONSTANTS)}"]
