"""The operators that move particles, each as it will run: as what it is declared, or in a form that is exact."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Any

from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Value
from graphfx.motion.probe import LinearForm, probe
from graphfx.node import NodeType
from graphfx.plan.evaluate import holds
from graphfx.plan.holder import is_brownian, names_in
from graphfx.plan.rates import depends_on_time, lane_type
from graphfx.plan.values import node_function
from graphfx.program import Function

INNER_ROLES = ("flow", "velocity", "acceleration")
"""Roles of the operators that are composed around the linear motion."""
STATE = ("position", "velocity")
"""What the whole motion of a particle changes."""


@dataclass(frozen=True)
class MatrixForm:
    """A rate of change M (P, V) + b: whether there is a matrix M, and a constant b.

    `uniform` are the arguments that are one for all particles, apart from which M depends on nothing.
    """

    matrix: bool
    constant: bool
    uniform: dict[str, Value]


@dataclass
class Mover:
    """One operator of the motion, as it will run: its function, the names of its arguments, and its role.

    A linear one has a form, or that of a matrix. An `idle` one acts at no time that is simulated. `changing` are the
    attributes that are set within a frame. An acceleration whose `exact_if` holds has its exact flow in `whole`: all motion
    of a particle on which nothing else acts.
    """

    node: FlatNode
    function: Function
    arguments: tuple[str, ...]
    role: str
    form: LinearForm | None = None
    idle: bool = False
    changing: frozenset[str] = frozenset()
    whole: Mover | None = None
    matrix: MatrixForm | None = None

    @property
    def writes(self) -> tuple[str, ...]:
        """Return what its function gives, in order."""
        declared = self.node.node_type
        return STATE if self.role == "flow" and declared.role == "acceleration" else declared.writes

    @property
    def writes_velocity(self) -> bool:
        """Return whether it changes the velocity, and through it alone the position; else the position."""
        return "velocity" in self.node.node_type.writes

    @property
    def is_brownian(self) -> bool:
        """Return whether it is noise that is a Wiener process, and not held for each cell."""
        return is_brownian(self.node)

    @property
    def carries(self) -> bool:
        """Return whether it is a flow that gives all of a particle's motion: its velocity carries it too."""
        return self.role == "flow" and set(STATE) <= set(self.writes)

    @property
    def time_free(self) -> bool:
        """Return whether what it does to a particle stays the same: its parameters, and that it acts."""
        reads_time = {"time", "frame"}.intersection(self.arguments)
        return self.node.during is None and self.node.only is None and self.constant and not reads_time

    @property
    def constant(self) -> bool:
        """Return whether the values of its parameters stay the same for a particle."""
        return not any(depends_on_time(value, self.changing) for value in self.node.arguments.values())

    @property
    def follows_state(self) -> bool:
        """Return whether its parameters depend on where the particle is, or on how it moves."""
        return self.follows("position") or self.follows("velocity")

    def follows(self, name: str) -> bool:
        """Return whether its parameters depend on an attribute."""
        return any(name in names_in(value) for value in self.node.arguments.values())


def base_of(movers: list[Mover]) -> Mover | None:
    """Return the first acceleration with an exact flow that acts on all, at all times: all else is composed around that."""
    whole = (mover for mover in movers if mover.whole is not None)
    return next((mover for mover in whole if mover.node.during is None and mover.node.only is None), None)


def linear_form(mover: Mover) -> Mover | None:
    """Return a flow as the rate of change that it has in its linear form, if it has one."""
    if mover.role != "flow" or mover.node.node_type.linear is None:
        return None
    return Mover(mover.node, *_rate_function(mover.node.node_type), "linear")


def mover_of(node: FlatNode, idle: bool = False, changing: frozenset[str] = frozenset()) -> Mover:
    """Return an operator as it will run.

    A flow whose `exact_if` holds runs as the linear operator that it then is; a linear operator without a simple form
    is an acceleration or an applied velocity, unless all together have the form of a matrix: see `matrix_form`.
    An acceleration whose `exact_if` holds stays one, and has its flow beside it.
    """
    node_type = node.node_type
    function, arguments, role = node_function(node_type), node_type.arguments, node_type.role
    if role == "flow" and node_type.exact_if and node_type.linear is not None and holds(node, node_type.exact_if):
        function, arguments, role = *_rate_function(node_type), "linear"
    form = None
    if role == "linear" and "velocity" in node_type.writes:
        form = probe(function.body, arguments, function.arguments)
        role = "linear" if form is not None else "acceleration"
    elif role == "linear" and {"position", "velocity"} & {*node_type.reads}:
        role = "velocity"
    mover = Mover(node, function, arguments, role, form, idle, changing)
    if node_type.flow is not None and holds(node, node_type.exact_if):
        flow = _beside(node_type, node_type.flow, "flow", ("vec3", "vec3"))
        mover.whole = Mover(node, *flow, "flow", idle=idle, changing=changing)
    return mover


def _rate_function(node_type: NodeType) -> tuple[Function, tuple[str, ...]]:
    """Return the rate of change that a flow has in its linear form."""
    return _beside(node_type, node_type.linear, "rate", ("vec3",))


def _beside(node_type: NodeType, body: Any, kind: str, results: tuple[str, ...]) -> tuple[Function, tuple[str, ...]]:
    """Return a function that a node type has beside its own, and the names of its arguments."""
    names = tuple(inspect.signature(body).parameters)
    types = tuple(lane_type(node_type.argument_type(name)) for name in names)
    return Function(f"{node_type.name}_{kind}", body, types, results), names
