"""A node type under test, with what several truths ask of it computed once."""

from __future__ import annotations

import inspect
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from graphfx.contract.both_ways import BothWays, Columns
from graphfx.contract.inputs import Inputs, Row
from graphfx.node import NUMERIC_TYPES, Library, NodeType
from graphfx.node.types import RESERVED

_ON_LANES = (*NUMERIC_TYPES, "draw", "id", "mesh")


class Subject:
    """A node type of a library."""

    def __init__(self, node_type: NodeType, library: Library):
        self.node_type, self.library = node_type, library
        self._results: dict[int, Columns] = {}

    @property
    def is_function(self) -> bool:
        """Whether it is a function for particles, and not a part of the language or a thing of the plan."""
        kinds = map(self.node_type.argument_type, self.node_type.arguments)
        return not self.node_type.language and self.node_type.kind != "geometry" and all(kind in _ON_LANES for kind in kinds)

    @property
    def draws(self) -> bool:
        """Whether it is a function that is handed random numbers."""
        return self.is_function and "draw" in self.node_type.arguments

    @property
    def is_shape(self) -> bool:
        """Whether it makes a mesh from numbers and texts alone."""
        required = [parameter.type for parameter in self.node_type.parameters.values() if parameter.required]
        return self.node_type.kind == "geometry" and "path" not in required

    @property
    def is_closed(self) -> bool:
        """Whether its function is handed neither random numbers nor a particle's id."""
        kinds = map(self.node_type.argument_type, self.node_type.arguments)
        return self.is_function and not {"draw", "id"} & {*kinds}

    @cached_property
    def whole(self) -> Subject | None:
        """The exact flow that an acceleration has beside its own function, as a node type of its own."""
        flow = self.node_type.flow
        if flow is None:
            return None
        names = tuple(inspect.signature(flow).parameters)
        read = tuple(name for name in names if name not in self.node_type.parameters and name not in RESERVED)
        declared: dict[str, Any] = {
            "role": "flow", "function": flow, "arguments": names, "reads": read, "reserved": ("dt",),
            "writes": ("position", "velocity"), "result": ("vec3", "vec3"), "flow": None,
        }  # fmt: skip
        return Subject(replace(self.node_type, **declared), self.library)

    @cached_property
    def both_ways(self) -> BothWays:
        """The function as a program."""
        return BothWays(self.node_type)

    @cached_property
    def rows(self) -> list[Row]:
        """Ordinary and extreme particles and parameters."""
        return Inputs(self.node_type).rows()

    def on_machine(self, precision: int, order: np.ndarray | None = None) -> Columns:
        """Return the machine's results for the rows; as they stand, they are computed once."""
        if order is not None:
            return self.both_ways.run(self.rows, precision, on_machine=True, order=order)
        if precision not in self._results:
            self._results[precision] = self.both_ways.run(self.rows, precision, on_machine=True)
        return self._results[precision]
