"""What `graphfx nodes` prints of the language's own values: `{"keys": [...]}` and the like."""

from __future__ import annotations

from typing import Any

from graphfx.cli.word_docs import TOPIC, function_lines
from graphfx.graph.document import document_of
from graphfx.graph.format import canonical
from graphfx.graph.names import INTERPOLATIONS, REPEATS, SCOPES, VALUE_KEYS
from graphfx.node import Library

SUMMARIES = {
    "param": "The value that a parameter of the graph has.",
    "expr": "An expression: arithmetic, comparisons, functions, attributes, named values, `time`, `param.x`, `birth.x`.",
    "keys": "Keys in time [s]: pairs of a time and a value.",
    "ramp": "Points over the normalized age, or over what `over` says: pairs of a position and a value.",
    "rand": "Drawn evenly between two values, once for each life of a particle unless `per` says otherwise.",
}
MODIFIERS = {
    "interpolation": f"How it goes from point to point: {', '.join(INTERPOLATIONS)}.",
    "repeat": f"What it does outside its keys: {', '.join(REPEATS)}.",
    "over": "An attribute, a named value or an expression.",
    "per": f"Once for each {', '.join(SCOPES)}, or cluster of a name.",
    "vary": "Share, 0 to 1, of the way between the two by which single particles differ from their scope's.",
}
EXAMPLES: dict[str, Any] = {
    "param": {"param": "lift"},
    "expr": {"expr": "0.02 * (1 - age / life)"},
    "keys": {"keys": [[0, 0.01], [1, 0.05], [2, 0.01]], "interpolation": "smooth", "repeat": "loop"},
    "ramp": {"ramp": [[0, 0], [0.2, 0.05], [1, 0]], "interpolation": "spline"},
    "rand": {"rand": [0.01, 0.04], "per": "particle"},
}
"""Each as a radius in a graph."""


def value_texts() -> dict[str, tuple[str, ...]]:
    """Return, of each value, its summary and what its modifiers do."""
    return {name: (SUMMARIES[name], " ".join(MODIFIERS[key] for key in VALUE_KEYS[name])) for name in VALUE_KEYS}


def value_lines() -> list[str]:
    """Return the values, a line each."""
    width = max(map(len, VALUE_KEYS))
    return [f"{name:{width}}  {SUMMARIES[name]}" for name in VALUE_KEYS]


def describe_value(name: str, library: Library) -> str:
    """Return everything about a value of the language."""
    modifiers = [f"  {key:13}  {MODIFIERS[key]}" for key in VALUE_KEYS[name]]
    parts = [f"{name} (a value of the language)", "", SUMMARIES[name], "", *([*modifiers, ""] if modifiers else [])]
    if name == "expr":
        parts += [f"Names: those of 'graphfx nodes {TOPIC}', time, frame, clusters, named values, param.x.", ""]
        parts += [*(f"  {line}" for line in function_lines()), ""]
    return "\n".join([*parts, "A graph that runs", "", canonical(document_of(value_sample(name)), library).rstrip()])


def value_sample(name: str) -> dict[str, Any]:
    """Return a small graph with a value of the language in it."""
    nodes = {
        "source": {"type": "emit", "rate": 200, "life": 2, "set": {"velocity": [0, 1, 0], "position": {"in_sphere": {}}}},
        "motion": {"type": "stack", "from": "source", "ops": [{"type": "set", "set": {"radius": EXAMPLES[name]}}]},
        "view": {"type": "camera", "position": [0, 1, 8], "target": [0, 1, 0]},
        "frames": {"type": "image", "from": "motion", "camera": "view", "size": [640, 360]},
    }
    params = {"params": {"lift": {"type": "float", "default": 0.02, "min": 0, "unit": "m"}}} if name == "param" else {}
    return {"graphfx": 1, "time": {"frames": [1, 48]}, **params, "nodes": nodes}
