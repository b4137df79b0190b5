"""What `graphfx nodes` prints: all of it from the node's own file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from itertools import groupby
from typing import Any

from graphfx.authoring.sample import sample
from graphfx.cli.failure import from_here
from graphfx.errors import NodeError, Problem
from graphfx.graph.document import document_of
from graphfx.graph.format import canonical
from graphfx.node import Library, NodeType, Parameter
from graphfx.node.roles import treatment


def first_line(node_type: NodeType) -> str:
    """Return a node type's summary: the first line of its file's docstring."""
    return node_type.doc.strip().splitlines()[0]


def load_all(library: Library) -> tuple[dict[str, NodeType], list[Problem]]:
    """Return all node types that can be loaded, by kind and name, and what is wrong with the others."""
    types: dict[str, NodeType] = {}
    problems: list[Problem] = []
    for name in sorted(library, key=lambda name: (library.kind_of(name), name)):
        try:
            types[name] = library[name]
        except NodeError as error:
            problems += error.problems
    return types, problems


def table(types: Mapping[str, NodeType]) -> str:
    """Return node types by kind, a line each."""
    width = max(map(len, types))
    lines: list[str] = []
    for kind, group in groupby(types.values(), key=lambda node_type: node_type.kind):
        lines += ["", kind, *(f"  {node_type.name:{width}}  {first_line(node_type)}" for node_type in group)]
    return "\n".join(lines[1:])


def describe(node_type: NodeType, library: Library) -> str:
    """Return everything about a node type."""
    parts = [f"{node_type.name} ({node_type.kind}, {role(node_type)})", "", node_type.doc.strip(), ""]
    if node_type.parameters:
        parts += ["Parameters", *parameter_lines(node_type.parameters), ""]
    parts += [f"{name.replace('_', ' ')}: {text}" for name, text in facts(node_type).items() if text]
    text = canonical(document_of(sample(node_type, library)), library)
    return "\n".join([*parts, "", "A graph that runs", "", text.rstrip()])


def facts(node_type: NodeType) -> dict[str, str]:
    """Return what a node type's declaration says besides its parameters, in the order of its docs."""
    own = [name for name in node_type.reserved if not node_type.language]
    return {
        "signature": "" if node_type.language else signature(node_type),
        "reads": ", ".join(node_type.reads),
        "given_by_the_engine": ", ".join(own),
        "writes": ", ".join(node_type.writes),
        "gives": ", ".join(node_type.result) if node_type.kind == "values" else "",
        "the_engine": treatment(node_type.role),
        "runs": "one particle after another, since its function branches" if node_type.branches else "",
        "left_out_when": node_type.neutral,
        "exact_when": node_type.exact_if,
        "declared_in": from_here(node_type.location.file),
    }


def signature(node_type: NodeType) -> str:
    """Return a function's signature: what it reads, what the engine gives, its parameters with their units, and its results."""
    parameters = node_type.parameters
    arguments = [parameters[name].label if name in parameters else name for name in node_type.arguments]
    results = ", ".join(node_type.writes or node_type.results or node_type.result)
    return f"{node_type.name}({', '.join(arguments)}) -> {results}"


def node_data(node_type: NodeType, library: Library) -> dict[str, Any]:
    """Return everything about a node type as JSON data."""
    return {"name": node_type.name, "kind": node_type.kind, "role": node_type.role, "doc": node_type.doc.strip(),
            "parameters": parameter_data(node_type.parameters), **facts(node_type), "sample": sample(node_type, library)}


def parameter_data(parameters: Mapping[str, Parameter]) -> dict[str, Any]:
    """Return the declarations of parameters as JSON data, by name."""
    return {
        parameter.name: {"type": parameter.type, "default": json.loads(default_text(parameter)) if _stated(parameter) else None,
                         "required": parameter.required, "unit": parameter.unit, "min": parameter.min, "max": parameter.max,
                         "choices": list(parameter.choices), "doc": parameter.doc}
        for parameter in parameters.values()}


def mentions(word: str, texts: Mapping[str, tuple[str, ...]]) -> list[str]:
    """Return what speaks of a word, a line each: names with their texts, the summary first, by which of them has it."""
    wanted = word.lower().replace("_", " ")
    ranks: dict[str, int] = {}
    for name, places in texts.items():
        found = [rank for rank, place in enumerate((name.replace("_", " "), *places)) if wanted in place.lower()]
        if found:
            ranks[name] = found[0]
    width = max(map(len, ranks), default=0)
    return [f"{name:{width}}  {texts[name][0]}" for name in sorted(ranks, key=lambda name: (ranks[name], name))]


def texts_of(types: Mapping[str, NodeType]) -> dict[str, tuple[str, ...]]:
    """Return, of each node type, its summary, its docs, and those of its parameters."""
    return {name: (first_line(each), each.doc, parameter_words(each.parameters)) for name, each in types.items()}


def parameter_words(parameters: Mapping[str, Parameter]) -> str:
    """Return the names and docs of parameters as one text."""
    return " ".join(f"{parameter.name} {parameter.doc}" for parameter in parameters.values())


def role(node_type: NodeType) -> str:
    """Return how the engine treats a node type, in words."""
    return "part of the language" if node_type.language else node_type.role


def parameter_lines(parameters: dict[str, Parameter]) -> list[str]:
    """Return a table of parameters: name with unit, type, default, range, and what it means."""
    rows = [(parameter.label, parameter.type, default_text(parameter), range_text(parameter))
            for parameter in parameters.values()]
    widths = [max(len(row[k]) for row in rows) for k in range(4)]
    return ["  " + "  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)) + f"  {parameter.doc}"
            for row, parameter in zip(rows, parameters.values(), strict=True)]


def default_text(parameter: Parameter) -> str:
    """Return a default as a graph would state it."""
    if parameter.required or parameter.default is None:
        return "required" if parameter.required else "none"
    return json.dumps(_plain(parameter.default)).replace("Infinity", '"infinity"')


def _stated(parameter: Parameter) -> bool:
    return not parameter.required and parameter.default is not None


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


def range_text(parameter: Parameter) -> str:
    """Return what a parameter may be, where that is limited."""
    if parameter.choices:
        return " | ".join(parameter.choices)
    low, high = (None if bound is None else f"{bound:g}" for bound in (parameter.min, parameter.max))
    if low is not None and high is not None:
        return f"{low} to {high}"
    return f"at least {low}" if low is not None else f"at most {high}" if high is not None else ""
