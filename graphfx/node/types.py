"""The types that a parameter, an attribute or a stream can have, and the declarations made of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from graphfx.errors import Location

INFINITY = float("inf")

NUMERIC_TYPES = {"float": 1, "int": 1, "vec3": 3, "point": 3, "direction": 3, "color": 3, "bool": 1}
"""Types that live on lanes, with their number of components (a bool is a mask)."""
OTHER_TYPES = ("string", "path", "interval", "list", "selector", "surface", "mesh", "stream", "node", "nodes")
"""Types that only the plan sees."""

RESERVED = ("dt", "time", "frame", "id", "draw")
"""Arguments that the engine gives: step [s], time [s], frame number, particle id, and four uniform random numbers."""
NOISE = ("noise",)
"""What it gives to noise operators besides: a random vector, to which the result is proportional."""
WAY = ("start", "end")
"""Arguments that it gives to surfaces besides: where a particle is at the start and at the end of a step [m]."""

COMMON_KEYS = ("type", "id", "doc", "from", "ops", "when", "only", "during", "enabled", "seed_key")
"""Keys that any node of a graph may carry; no parameter may have one of these names."""


@dataclass(frozen=True)
class Attribute:
    """A column that the engine knows: what a name in a signature or a `set` refers to.

    `follows` names the attribute whose value at birth is this one's default.
    """

    name: str
    type: str
    default: Any
    unit: str
    doc: str
    follows: str = ""


ATTRIBUTES = {
    attribute.name: attribute
    for attribute in (
        Attribute("position", "vec3", (0.0, 0.0, 0.0), "m", "Where the particle is."),
        Attribute("velocity", "vec3", (0.0, 0.0, 0.0), "m/s", "Its own velocity; applied velocities are not in it."),
        Attribute("spiral_axis", "vec3", (0.0, 1.0, 0.0), "", "Axis about which `spiral` turns the velocity."),
        Attribute("radius", "float", 0.02, "m", "Radius of the drawn particle."),
        Attribute("color", "color", (1.0, 1.0, 1.0), "", "Linear-light colour."),
        Attribute("opacity", "float", 1.0, "", "1 is opaque at the centre, 0 is not there."),
        Attribute("mass", "float", 1.0, "kg", "Mass, for forces."),
        Attribute("type", "float", 0.0, "", "A number to tell kinds of particles apart."),
        Attribute("rest_position", "vec3", (0.0, 0.0, 0.0), "m", "Where it belongs; where it was born, unless set.", "position"),
        Attribute("initial_velocity", "vec3", (0.0, 0.0, 0.0), "m/s", "The velocity it was born with, unless set.", "velocity"),
        Attribute("fade_color", "color", (1.0, 1.0, 1.0), "", "A colour to fade to."),
        Attribute("normal", "vec3", (0.0, 1.0, 0.0), "", "Normal of the surface that it comes from."),
        Attribute("tangent", "vec3", (0.0, 1.0, 0.0), "", "Up-most tangent of the surface that it comes from."),
        Attribute("hits", "float", 0.0, "", "How often it met a surface, but for slow hits; counted by the engine."),
        Attribute("lives", "float", 0.0, "", "How many lives it had before this one; counted by `recycle`."),
        Attribute("generation", "float", 0.0, "", "How many spawns it is away from an emitter; counted by `spawn`."),
        Attribute("life", "float", INFINITY, "s", "Age at which the particle dies."),
    )
}
"""Attributes that may be set. `age` [s] and `normalized_age` (age / life) can be read besides."""

DERIVED_ATTRIBUTES = {
    "age": Attribute("age", "float", 0.0, "s", "Time since birth."),
    "normalized_age": Attribute("normalized_age", "float", 0.0, "", "age / life, 1 at most."),
}

OTHER_NAMES = {
    "P": "position", "v": "velocity", "Cd": "color", "Alpha": "opacity", "pscale": "radius", "nage": "normalized_age",
    "colour": "color", "size": "radius", "scale": "radius", "alpha": "opacity", "vel": "velocity", "pos": "position",
    "lifetime": "life", "birth_rate": "rate",
}
"""What Houdini, Blender and habit call our names."""


@dataclass(frozen=True)
class Parameter:
    """A parameter of a node type, from `param(...)` in its signature."""

    name: str
    type: str
    default: Any
    unit: str = ""
    min: float | None = None
    max: float | None = None
    choices: tuple[str, ...] = ()
    doc: str = ""
    required: bool = False

    @property
    def label(self) -> str:
        """Return the name with its unit, as messages and docs show it."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


@dataclass(frozen=True)
class NodeType:
    """What a node of one type is: everything comes from one Python file's signature and decorator.

    `role` is how the engine treats it: for operators the decorator's name (`flow`, `linear`, ...),
    for values `value`, for language nodes their own name (`emit`, `image`, ...).
    `reads` are attributes in order of the signature; `arguments` all names in that order.
    `writes` are the attributes that the result replaces; `result` is its type(s).
    Where `exact_if` holds, a flow has `linear`, its rate of change, and an acceleration `flow`, the whole motion.
    """

    name: str
    kind: str
    role: str
    function: Callable[..., Any]
    arguments: tuple[str, ...]
    reads: tuple[str, ...]
    reserved: tuple[str, ...]
    parameters: dict[str, Parameter]
    result: tuple[str, ...]
    writes: tuple[str, ...] = ()
    neutral: str = ""
    exact_if: str = ""
    branches: bool = False
    language: bool = False
    doc: str = ""
    location: Location = field(default=Location())
    linear: Callable[..., Any] | None = None
    flow: Callable[..., Any] | None = None
    results: tuple[str, ...] = ()
    """The names of a value's results, where it has several: `spot.normal`."""

    def argument_type(self, name: str) -> str:
        """Return the lane type of one argument: 'float', 'vec3', 'bool', 'draw' or 'id'."""
        if name in self.parameters:
            return self.parameters[name].type
        if name in ("draw", "id"):
            return name
        if name in (*WAY, *NOISE) and name in self.reserved:
            return "vec3"
        if name in RESERVED:
            return "float"
        return (ATTRIBUTES | DERIVED_ATTRIBUTES)[name].type

    @property
    def draws(self) -> bool:
        """Return whether its function is handed random numbers."""
        return bool({"draw", *NOISE} & {*self.reserved})

    @property
    def parameter_line(self) -> str:
        """Return all parameters with units on one line."""
        return ", ".join(parameter.label for parameter in self.parameters.values()) or "no parameters"
