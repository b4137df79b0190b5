"""Values of a document as the numbers that plain Python finds by the program that they become."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from graphfx.graph.document import document_of
from graphfx.graph.flat import FlatNode
from graphfx.graph.flatten import flatten
from graphfx.math import Vec3
from graphfx.motion import basic
from graphfx.node import Library
from graphfx.plan.rates import LANE_TYPES, Scope
from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Call, Program, Uniform
from graphfx.program.reference import run_particle

LANES = {"position": "vec3", "velocity": "vec3"}


def emitted(library: Library, sets: dict[str, Any], **top: Any) -> FlatNode:
    """Return the flat node of an emitter with these attributes."""
    return flatten(document_of({"graphfx": 1, **top, "nodes": {"sky": {"type": "emit", "set": sets}}}), library).nodes["sky"]


def lowered(values: Mapping[str, Any]) -> Program:
    """Return the program that finds values by name for a particle; attributes and the clock are loaded."""
    builder = Builder.begin("values")
    scope = Scope(0, "sky", lambda name: builder.load(name, LANES.get(name, "float")), lambda: builder.load("id", "id"),
                  lambda name: True)
    writer = ValueWriter(builder, scope, {name: builder.load(name, "float") for name in ("time", "frame")}, None, 64)
    for name, value in values.items():
        operand = writer.operand(value)
        if isinstance(operand, Uniform):
            operand = builder.call(basic.copy_vector if LANE_TYPES[value.type] == "vec3" else basic.copy_number, operand)
        builder.store(name, operand)
    return builder.program


def found(program: Program, precision: int = 64, **state: Any) -> dict[str, Any]:
    """Return what the program finds for one particle: numbers, and tuples of three."""
    state = {"time": 0.0, "frame": 0.0, "id": 7} | state
    values = run_particle(program, {name: state[name] for name in program.loads}, {}, precision)
    results = {name: values[id(column)] for name, column in program.stores.items()}
    return {name: tuple(map(float, value)) if isinstance(value, Vec3 | tuple) else value for name, value in results.items()}


def calls(program: Program) -> list[str]:
    """Return the names of the functions that it calls, in order."""
    return [step.function.name for step in program.walk() if isinstance(step, Call)]
