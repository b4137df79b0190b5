"""Lower values to instructions, each at the slowest rate that serves.

A constant is found when the plan is made; a value that depends on time alone once per step, by the
reference path; what differs by particle becomes instructions on block columns.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np

from graphfx.graph.values import Call, Expression, Keys, Literal, Member, Name, Node, Ramp, Random, Value
from graphfx.math.random import key_of
from graphfx.plan import arithmetic
from graphfx.plan.arithmetic import function_for
from graphfx.plan.rates import CLOCK_NAMES, NOUGHT, Identities, Rate, Scope, lane_type, literal, rate_of
from graphfx.plan.splines import slopes
from graphfx.program import Builder, Column, Function, Operand, Uniform
from graphfx.program.reference import execute

PRODUCTS = (2.0, 3.0, 4.0)
"""Exponents that, where an expression states them, are written as products."""


@dataclass
class StepValues:
    """Values found once per step: a program of one 'particle', and which uniforms take its results."""

    builder: Builder = field(default_factory=lambda: Builder.begin("step values"))
    exports: list[tuple[Uniform, Operand]] = field(default_factory=list)
    writer: ValueWriter | None = None

    def clock(self, name: str) -> Column:
        """Return the column of `time`, `frame` or `dt`."""
        return self.builder.load(name, "float")


class ValueWriter:
    """Writes the instructions that find values at one rate; what is slower is found at its own.

    `clock` gives `time` [s] and `frame` as operands of the builder where there are no step values, and meshes;
    `shared` holds what was found before for the whole program, by id of the value.
    """

    def __init__(
        self,
        builder: Builder,
        scope: Scope,
        clock: dict[str, Operand],
        steps: StepValues | None,
        precision: int,
        rate: Rate = Rate.PARTICLE,
    ):
        self.builder = builder
        self.scope = scope
        self.clock = clock
        self.steps = steps
        self.precision = precision
        self.rate = rate
        self.shared: dict[int, Operand] = {}
        self.called: dict[int, tuple[Operand, ...]] = {}
        self.identities = Identities()
        self._found: dict[int, Operand] = {}

    def again(self) -> ValueWriter:
        """Return another like it, which finds again what it has found."""
        made = ValueWriter(self.builder, self.scope, self.clock, self.steps, self.precision, self.rate)
        made.shared = self.shared
        return made

    def operand(self, tree: Any) -> Operand:
        """Return the operand that holds a value, a part of an expression, or a number; the same for equal ones."""
        key = self.identities.of(tree)
        if key not in self._found:
            self._found[key] = self._find(tree)
        return self._found[key]

    def argument(self, value: Value) -> Operand:
        """Return the operand for a parameter: directions at unit length."""
        if id(value) in self.shared:
            return self.shared[id(value)]
        return self.operand(Call("normalize", (value,)) if value.type == "direction" else value)

    def _find(self, tree: Any) -> Operand:
        if isinstance(tree, (bool, np.bool_)):
            return Uniform(_shown(tree), "bool", bool(tree))
        if isinstance(tree, (int, float, np.floating)):
            return Uniform(_shown(tree), "float", float(tree))
        if isinstance(tree, Literal) and tree.type == "mesh":
            return self.clock[f"mesh {tree.value}"]
        if isinstance(tree, Literal):
            return Uniform(_shown(tree.value), lane_type(tree.type), tree.value)
        rate = rate_of(tree, self.scope)
        if rate == Rate.CONSTANT and self.rate > rate:
            return self._constant(tree)
        if rate == Rate.STEP and self.steps is not None:
            return self._step(tree, self.steps)
        return _Lowering(self.builder, self).write(tree)

    def _constant(self, tree: Any) -> Operand:
        builder = Builder.begin("constant")
        column = ValueWriter(builder, self.scope, {}, None, self.precision, Rate.CONSTANT).operand(tree)
        return column if isinstance(column, Uniform) else _result(builder, column, self.precision)

    def _step(self, tree: Any, steps: StepValues) -> Operand:
        if steps.writer is None:
            clock: dict[str, Operand] = {name: steps.clock(name) for name in CLOCK_NAMES}
            steps.writer = ValueWriter(steps.builder, self.scope, clock, None, self.precision, Rate.STEP)
        column = steps.writer.operand(tree)
        uniform = self.builder.uniform(_name_of(tree), column.type)
        steps.exports.append((uniform, column))
        return uniform


def _shown(value: Any) -> str:
    if isinstance(value, tuple):
        return "(" + ", ".join(f"{float(v):g}" for v in value) + ")"
    return f"{float(value):g}" if not isinstance(value, (bool, np.bool_)) else str(bool(value)).lower()


def _name_of(tree: Any) -> str:
    if isinstance(tree, Name):
        return tree.name
    path = getattr(tree, "path", "")
    return path.rpartition(".")[2] if path else getattr(tree, "function", "value")


def _run(builder: Builder, loaded: dict[str, Any], precision: int) -> dict[int, Any]:
    values: dict[int, Any] = {id(builder.program.context): np.bool_(True)}
    kind = np.float32 if precision == 32 else np.float64
    for name, column in builder.program.loads.items():
        values[id(column)] = kind(loaded[name])
    with np.errstate(all="ignore"):
        execute(builder.program.body, values, precision)
    return values


def _result(builder: Builder, column: Operand, precision: int) -> Uniform:
    """Run instructions that depend on nothing; return what they leave in a column as a constant."""
    value = _run(builder, {}, precision)[id(column)]
    plain = tuple(value) if column.type == "vec3" else value
    return Uniform(_shown(plain), column.type, plain)


def find_step_values(steps: StepValues, time: float, frame: int, precision: int) -> dict[int, Any]:
    """Return the values of a step's uniforms by id(uniform)."""
    if not steps.exports:
        return {}
    values = _run(steps.builder, {"time": time, "frame": float(frame)}, precision)
    return {id(uniform): found.value if isinstance(found, Uniform) else values[id(found)] for uniform, found in steps.exports}


def folded_call(builder: Builder, precision: int, function: Function, *operands: Operand, name: str = "") -> Operand:
    """Write a call of one result; if all operands are constants, find it now."""
    if not all(isinstance(operand, Uniform) and operand.value is not None for operand in operands):
        result: Operand = builder.call(function, *operands, name=name)
        return result
    constant = Builder.begin("constant")
    return _result(constant, constant.call(function, *operands), precision)


class _Lowering:
    """Writes one value into a builder; parts are asked of the writer, which may find them at a slower rate."""

    def __init__(self, builder: Builder, writer: ValueWriter):
        self.builder = builder
        self.writer = writer
        self.scope = writer.scope

    def write(self, tree: Any) -> Operand:
        """Return the operand that holds the value."""
        if isinstance(tree, Expression):
            return self.writer.operand(tree.tree)
        if isinstance(tree, Name):
            return self.writer.clock[tree.name] if tree.name in CLOCK_NAMES else self.scope.attribute(tree.name)
        if isinstance(tree, Call):
            parts = [self.writer.operand(part) for part in tree.arguments]
            if tree.function == "power" and tree.arguments[1] in PRODUCTS:
                return self._product(parts[0], int(tree.arguments[1]))
            return self.builder.call(function_for(tree.function, tuple(part.type for part in parts)), *parts)
        if isinstance(tree, Random):
            return self._random(tree)
        if isinstance(tree, Keys):
            return self._keys(self._repeated(tree), tree.times, tree.values, tree)
        if isinstance(tree, Ramp):
            return self._keys(self.writer.operand(tree.over), tree.positions, tree.values, tree)
        if isinstance(tree, Node):
            return self._results(tree)[0]
        if isinstance(tree, Member) and tree.value is not None:
            return self._results(tree.value)[tree.index]
        raise TypeError(f"no instruction finds {type(tree).__name__}")

    def _product(self, factor: Operand, count: int) -> Operand:
        """Write a power of 2 to 4 as products, which holds for any sign."""
        multiply = function_for("multiply", ("float", "float"))
        square = self.builder.call(multiply, factor, factor, name="square")
        return square if count == 2 else self.builder.call(multiply, square, factor if count == 3 else square, name="power")

    def _draw(self, value: Value, per: str, purpose: str = "") -> Column:
        """Write a draw in a scope: once for the graph, in each frame, for the particle, its life or a hit, or its cluster.

        Draws are counted by (id, life, cell); one for a cluster has the cluster's number in place of the life's.
        """
        scope = self.scope
        key = key_of(scope.seed, scope.emitter, value.seed + purpose)
        own = per in ("life", "particle", "hit", "frame")
        identity: Operand = scope.identity() if own else Uniform("0", "id", 0)
        life = NOUGHT if per in ("graph", "particle") else scope.number("lives" if own else per)
        cell: Operand = NOUGHT
        if per == "frame" and "frame word" in self.writer.clock:
            cell = self.writer.clock["frame word"]
        elif per == "hit":
            cell = scope.number("hits")
        return self.builder.draw(key, identity, life, cell)

    def _random(self, tree: Random) -> Operand:
        low, high = self.writer.operand(tree.low), self.writer.operand(tree.high)
        u = self.builder.call(arithmetic.first_of, self._draw(tree, tree.per), name="u")
        if tree.vary > 0 and tree.per != "life":
            own = self._draw(tree, "life", "/vary")
            u = self.builder.call(arithmetic.varied, u, own, self.writer.operand(float(tree.vary)), name="u")
        function = arithmetic.random_vector if low.type == "vec3" else arithmetic.random_number
        return self.builder.call(function, low, high, u, name=_name_of(tree))

    def _repeated(self, tree: Keys) -> Operand:
        time = self.writer.operand(Name("time"))
        ends = self.writer.operand(tree.times[0]), self.writer.operand(tree.times[-1])
        if tree.repeat == "hold" or tree.times[0] == tree.times[-1]:
            return time
        return self.builder.call(arithmetic.looped if tree.repeat == "loop" else arithmetic.mirrored, time, *ends)

    def _keys(self, x: Operand, positions: tuple[float, ...], points: tuple[Any, ...], tree: Any) -> Operand:
        type_ = lane_type(tree.type)
        held = [point if isinstance(point, Value) else Literal(tree.type, value=point) for point in points]
        values = [self.writer.operand(point) for point in held]
        where = [self.writer.operand(float(position)) for position in positions]
        shape = {"smooth": arithmetic.smooth_between, "step": arithmetic.held_between}.get(tree.interpolation)
        if shape:
            for first, last in pairwise(where):
                x = self.builder.call(shape, x, first, last)
        function = arithmetic.key_vector if type_ == "vec3" else arithmetic.key_number
        bends: list[Operand] = []
        if tree.interpolation == "spline":
            function = arithmetic.spline_vector if type_ == "vec3" else arithmetic.spline_number
            known = [literal(point) for point in held]
            bends = [self.writer.operand(Literal(tree.type, value=slope)) for slope in slopes(positions, known)]
        result: Operand = values[0]
        for k in range(max(len(values) - 1, 1)):
            after = min(k + 1, len(values) - 1)
            ends = [values[k], values[after], *([bends[k], bends[after]] if bends else [])]
            result = self.builder.call(function, result, x, where[k], where[after], *ends, name=_name_of(tree))
        return result

    def _results(self, tree: Node) -> tuple[Operand, ...]:
        """Return all results of a value node: it is called once, however many are used."""
        key = self.writer.identities.of(tree)
        if key not in self.writer.called:
            self.writer.called[key] = self._node(tree)
        return self.writer.called[key]

    def _node(self, tree: Node) -> tuple[Operand, ...]:
        node_type = tree.node_type
        assert node_type is not None
        given = dict(tree.arguments)
        operands: list[Operand] = []
        for name in node_type.arguments:
            if name in given:
                operands.append(self.writer.argument(given[name]))
            elif name == "draw":
                operands.append(self._draw(tree, tree.per))
            elif name == "id":
                operands.append(self.scope.identity())
            else:
                operands.append(self.writer.operand(Name(name)))
        name = _name_of(tree)
        names = " ".join(f"{name}.{result}" for result in node_type.results) or name
        found = self.builder.call(node_function(node_type), *operands, name=names)
        return found if isinstance(found, tuple) else (found,)


_functions: dict[int, tuple[Any, Function]] = {}


def node_function(node_type: Any) -> Function:
    """Return the instruction that a node type's function is."""
    if id(node_type) not in _functions:
        arguments = tuple(lane_type(node_type.argument_type(name)) for name in node_type.arguments)
        results = tuple(lane_type(name) for name in node_type.result)
        made = Function(node_type.name, node_type.function, arguments, results, node_type.branches)
        _functions[id(node_type)] = node_type, made
    return _functions[id(node_type)][1]
