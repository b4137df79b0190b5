"""The meshes of a plan: made when a program first needs them, moved to where they stand at each step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from graphfx.errors import GraphError, LimitError, Problem
from graphfx.geometry.demands import check_mesh, needs_tree
from graphfx.geometry.mesh import Mesh, checked, transform
from graphfx.geometry.tables import MeshTables
from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.node.declare import TRANSFORM
from graphfx.plan.frame_program import FrameProgram
from graphfx.plan.pictures import plain_value, value_at
from graphfx.plan.rates import depends_on_time
from graphfx.program import Call, Function

STANDING = tuple(parameter.name for parameter in TRANSFORM)
"""Parameters that say where a mesh stands; the others make it."""
Standing = tuple[tuple[float, ...], ...]
KEPT = 4
"""Times at which the tables of a moving mesh are kept."""


class Meshes:
    """The tables of all meshes by path and time."""

    def __init__(self, flat: FlatGraph):
        """Make nothing yet."""
        self.flat = flat
        self._made: dict[str, Mesh] = {}
        self._tables: dict[str, dict[Any, MeshTables]] = {}
        self._searched: set[str] = set()
        self._prepared: set[int] = set()

    def prepare(self, made: FrameProgram) -> None:
        """Make the meshes that a program reads; raise GraphError for one that a function there cannot work on."""
        if id(made) in self._prepared or not made.meshes:
            return
        self._prepared.add(id(made))
        paths = {id(uniform): path for (path, _), uniform in made.meshes.items()}
        for call in made.program.walk():
            for operand in call.operands if isinstance(call, Call) else ():
                if id(operand) in paths and isinstance(call, Call):
                    self._check(self.flat.nodes[paths[id(operand)]], call.function)

    def _check(self, node: FlatNode, function: Function) -> None:
        self._located(node, lambda mesh: check_mesh(mesh, function.body, function.name))
        if needs_tree(function.body):
            self._searched.add(node.path)

    def uniforms(self, made: FrameProgram, start: float, length: float, substeps: int, frame: int) -> dict[int, MeshTables]:
        """Return the meshes of a program over a frame of `length` [s] that begins at `start`, by id of their uniforms."""
        self.prepare(made)
        middles = {key: start + length * ((key[1] + 0.5) / substeps if key[1] >= 0 else 0.5) for key in made.meshes}
        return {id(uniform): self.at(key[0], middles[key], frame) for key, uniform in made.meshes.items()}

    def at(self, path: str, time: float, frame: int) -> MeshTables:
        """Return the tables of a mesh as it stands at a time [s]."""
        node = self.flat.nodes[path]
        standing = self.standing(path, time, frame)
        kept = self._tables.setdefault(path, {})
        key = (standing, path in self._searched)
        if key not in kept:
            while len(kept) >= KEPT:
                del kept[next(iter(kept))]
            kept[key] = MeshTables(self._located(node).moved(*transform(*standing)), path in self._searched)
        return kept[key]

    def mesh(self, path: str, standing: Standing) -> Mesh:
        """Return a mesh as it stands so."""
        return self._located(self.flat.nodes[path]).moved(*transform(*standing))

    def check(self, path: str, check: Callable[[Mesh], None]) -> None:
        """Make a mesh and look at it; what is wrong is told at its node."""
        self._located(self.flat.nodes[path], check)

    def standing(self, path: str, time: float, frame: int) -> Standing:
        """Return how a mesh stands at a time [s]; raise GraphError where a number of that is not finite."""
        node = self.flat.nodes[path]
        return tuple(tuple(float(part) for part in value_at(node, name, time, frame)) for name in STANDING)

    def vertices(self, path: str) -> int:
        """Return how many vertices a mesh has."""
        return len(self._located(self.flat.nodes[path]).vertices)

    def _located(self, node: FlatNode, check: Callable[[Mesh], None] | None = None) -> Mesh:
        """Return the mesh of a node where it was made, after a check of it; what is wrong is told at the node."""
        try:
            if node.path not in self._made:
                self._made[node.path] = checked(node.node_type.function(**self._given(node)), "the mesh")
            if check is not None:
                check(self._made[node.path])
        except (GraphError, LimitError) as error:
            found = [replace(problem, location=node.location, path=f"nodes.{node.path}") for problem in error.problems]
            raise type(error)(found) from error.__cause__
        return self._made[node.path]

    def _given(self, node: FlatNode) -> dict[str, Any]:
        """Return the arguments that make a mesh: numbers, whole where they are declared so, texts and lists."""
        given: dict[str, Any] = {}
        for name in node.node_type.arguments:
            value = node.arguments[name]
            if depends_on_time(value):
                raise GraphError(Problem(f"{name} changes with time; of a mesh only {', '.join(STANDING)} may"))
            found = plain_value(value)
            given[name] = int(found) if node.node_type.parameters[name].type == "int" else found
        return given
