"""Kernels: any operand may be a column or one value for all; masks; draws; bodies put in or called; wrong nodes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphfx.errors import NodeError
from graphfx.machine.assemble import assemble
from graphfx.machine.kernels import kernel_of
from graphfx.math import Vec3, maximum, where
from graphfx.math.random import philox4x32, uniform
from graphfx.motion import basic, linear
from graphfx.program import Builder, Bundle, Column, Function, Uniform, function
from graphfx.program.reference import lane_value

from .programs import FUNCTIONS, KINDS, Setting, arrays_for, on_machine, same_both_ways

HERE = str(Path(__file__))
VALUES = {"float": (0.37, -1.25, 2.5), "vec3": ((0.3, -1.5, 2.0), (1.0, 0.2, -0.7), (0.0, 0.0, 0.0)), "bool": (True, False, True)}
SOLVERS = [linear.fall, linear.damped_fall, linear.spin, linear.spiral_fall]


def uniform_operands(which) -> tuple[Builder, dict[int, object]]:
    """Return a program that calls every small function with the arguments whose number is in `which` given for all."""
    builder, given = Builder.begin("operands"), {}
    for number, called in enumerate(FUNCTIONS):
        operands = []
        for k, type_ in enumerate(called.arguments):
            value = VALUES[type_][k % 3] if type_ in VALUES else None
            name = f"{type_} {k % 3}"
            if type_ == "draw":
                operands.append(_draw(builder))
            elif which(k):
                operands.append(Uniform(name, type_, value) if number % 2 else builder.uniform(name, type_))
                given[id(operands[-1])] = value
            else:
                operands.append(builder.load(name, type_))
        results = builder.call(called, *operands)
        for k, column in enumerate(results if isinstance(results, tuple) else (results,)):
            builder.store(f"{number} {called.name} {k}", column)
    return builder, given


def _draw(builder: Builder) -> Column:
    nought = Uniform("0", "word", 0)
    return builder.draw((1, 2), Uniform("0", "id", 5), nought, nought)


@pytest.mark.parametrize("precision", [32, 64])
def test_uniform_and_column_operands_give_the_same_bits(precision):
    """A value for all, constant or set anew, gives in every function what a column full of it gives."""
    made = []
    for which in (lambda k: False, lambda k: True, lambda k: k % 2 == 0, lambda k: k % 2 == 1):
        builder, given = uniform_operands(which)
        arrays = arrays_for(builder.program, 300, precision)
        for name, column in builder.program.loads.items():
            value = lane_value(VALUES[column.type][int(name[-1])], column.type, KINDS[precision])
            for part, number in zip(arrays[name], value if column.type == "vec3" else (value,), strict=True):
                part[:] = number
        on_machine(builder.program, arrays, Setting(300, precision, uniforms=given))
        made.append({name: arrays[name] for name in builder.program.stores})
    for other in made[1:]:
        for name in other:
            assert all(
                np.array_equal(one[:300], part[:300], equal_nan=True)
                for one, part in zip(made[0][name], other[name], strict=True)
            ), name


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("solver", SOLVERS, ids=lambda solver: solver.name)
def test_exact_flows_are_those_of_plain_python(solver, precision):
    """The exact flows round alike on lanes and in plain Python."""
    builder = Builder.begin(solver.name)
    results = builder.call(solver, *(builder.load(f"given {k}", type_) for k, type_ in enumerate(solver.arguments)))
    for k, column in enumerate(results):
        builder.store(f"made {k}", column)
    same_both_ways(builder.program, Setting(300, precision))


def test_masks_leave_other_lanes_alone():
    """Under a mask, lanes outside keep what they hold, even in groups of lanes with none inside; truths are false there."""
    builder = Builder.begin("masks")
    a, flag = builder.load("a", "float"), builder.load("flag", "bool")
    truth = builder.under(flag).call(basic.is_equal, a, a, name="truth")
    builder.under(flag).call(basic.difference, a, a, into=a)
    builder.store("a", a)
    builder.store("truth", truth)
    arrays = arrays_for(builder.program, 700, 32)
    arrays["flag"][0][:] = np.arange(768) % 300 < 40
    inside, before = arrays["flag"][0][:700] != 0, arrays["a"][0].copy()
    on_machine(builder.program, arrays, Setting(700, 32))
    assert np.array_equal(arrays["a"][0][:700], np.where(inside, 0, before[:700]))
    assert np.array_equal(arrays["truth"][0][:700] != 0, inside)
    assert np.array_equal(arrays["a"][0][700:], before[700:])


def counted(limit: int, depth: int = 1) -> Builder:
    """Return a program that counts in `n` the turns of loops nested `depth` deep, each of three turns if the limit allows."""
    builder = Builder.begin("count")
    one, three = Uniform("1", "float", 1.0), builder.load("a", "float")
    total = builder.call(basic.copy_number, Uniform("0", "float", 0.0), name="n")
    inner, ends = builder, []
    for _ in range(depth):
        turn = inner.call(basic.copy_number, Uniform("0", "float", 0.0), name="turn")
        going = inner.call(basic.is_less, turn, three, name="going")
        ends.append((inner, turn, going))
        inner = inner.loop(going, limit)
    inner.call(basic.sum_of_numbers, total, one, into=total)
    for _, turn, going in reversed(ends):
        inside = Builder(builder.program, going, _body_of(builder, going))
        inside.call(basic.sum_of_numbers, turn, one, into=turn)
        inside.call(basic.is_less, turn, three, into=going)
    builder.store("n", total)
    return builder


def _body_of(builder: Builder, going: Column) -> list:
    return next(loop.body for loop in builder.program.walk() if getattr(loop, "body", None) is not None and loop.mask is going)


@pytest.mark.parametrize("depth, turns", [(1, [0, 1, 3, 5]), (2, [0, 1, 9, 25]), (4, [0, 1, 81, 625])])
def test_nested_loops_turn_for_each_lane_by_itself(depth, turns):
    """Lanes with 0, 1, 3 and 5 turns, side by side in a block, each have as many to the power of the depth."""
    builder = counted(100, depth)
    arrays = arrays_for(builder.program, 256, 32)
    arrays["a"][0][:] = np.resize([0, 1, 3, 5], 256)
    on_machine(builder.program, arrays, Setting(256, 32))
    assert arrays["n"][0].tolist() == turns * 64


@pytest.mark.parametrize("limit", [1, 2, 4])
def test_loop_stops_at_its_limit(limit):
    """A loop runs at most as often as its limit, and others go on."""
    builder = counted(limit)
    arrays = arrays_for(builder.program, 256, 32)
    arrays["a"][0][:] = np.resize([0, 1, 3, 100], 256)
    on_machine(builder.program, arrays, Setting(256, 32))
    assert arrays["n"][0][:4].tolist() == [0, 1, min(3, limit), limit]


def test_loops_too_deep_are_refused():
    """More loops inside loops than the machine has room for are no program."""
    with pytest.raises(ValueError, match="loops are nested 9 deep; the machine holds 8"):
        assemble(counted(2, 9).program)


def test_equal_constants_of_other_bits_stay_apart():
    """0 and -0 are two constants: 1 / 0 and 1 / -0 differ."""
    builder = Builder.begin("signs")
    over = next(member for member in FUNCTIONS if member.name == "divide")
    for name, value in (("plus", 0.0), ("minus", -0.0)):
        builder.store(name, builder.call(over, builder.load("a", "float"), Uniform(name, "float", value)))
    arrays = arrays_for(builder.program, 10, 32)
    arrays["a"][0][:] = 1
    on_machine(builder.program, arrays, Setting(10, 32))
    assert arrays["plus"][0][0] == np.inf and arrays["minus"][0][0] == -np.inf


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("key", [(0, 0), (0xFFFFFFFF, 0x12345678)])
def test_draw_is_philox(precision, key):
    """A draw is Philox of (id, life, cell) under its key, as uniform numbers, for ids of all 64 bits."""
    builder = Builder.begin("draws")
    identity, life, cell = (builder.load(name, type_) for name, type_ in (("id", "id"), ("life", "word"), ("cell", "word")))
    results = builder.call(first_numbers, builder.draw(key, identity, life, cell))
    for k, column in enumerate(results):
        builder.store(f"u{k}", column)
    arrays = arrays_for(builder.program, 300, precision)
    arrays["id"][0][:3] = 0, 1, 2**64 - 1
    on_machine(builder.program, arrays, Setting(300, precision))
    for row in range(300):
        number = int(arrays["id"][0][row])
        words = philox4x32((number & 0xFFFFFFFF, number >> 32, int(arrays["life"][0][row]), int(arrays["cell"][0][row])), key)
        assert [arrays[f"u{k}"][0][row] for k in range(4)] == [uniform(word, KINDS[precision]) for word in words]


@function("draw", "float float float float")
def first_numbers(draw):
    return draw[0], draw[1], draw[2], draw[3]


FACTOR = 3.0
BODIES = Bundle("test_bodies")


@BODIES.function("float vec3", "vec3")
def inlined_in_a_bundle(a, v):
    """A body of one expression, which stands in its kernel."""
    return v * maximum(a, FACTOR) + Vec3(a, 1.0, -a) * FACTOR


@BODIES.function("float vec3", "vec3")
def called_in_a_bundle(a, v):
    scale = maximum(a, FACTOR)
    return v * scale + Vec3(a, 1.0, -a) * FACTOR


@function("float vec3", "vec3")
def inlined(a, v):
    return v * maximum(a, FACTOR) + Vec3(a, 1.0, -a) * FACTOR


def made_by(FACTOR):
    @function("float vec3", "vec3")
    def closed(a, v):
        return v * maximum(a, FACTOR) + Vec3(a, 1.0, -a) * FACTOR

    return closed


@pytest.mark.parametrize("called", [inlined_in_a_bundle, called_in_a_bundle, inlined, made_by(3.0), made_by(5.0)])
def test_bodies_put_in_and_called_are_the_same(called):
    """A one-line body put into a kernel, in a bundle or alone, or closing over a name, means what calling it means."""
    builder = Builder.begin("bodies")
    builder.store("made", builder.call(called, builder.load("a", "float"), builder.load("v", "vec3")))
    same_both_ways(builder.program, Setting(300, 32))


def _halved_until_small(x):
    turns = x * 0.0
    while x > 1.0:
        x = x * 0.5
        turns = turns + 1.0
    if turns > 3.0 and not x < 0.6:
        return -turns
    return turns


@pytest.mark.parametrize("precision", [32, 64])
def test_branches_lane_by_lane(precision):
    """With `branches=True` a body may use `if`, `while`, `and`, `not`: each lane takes its own way."""
    called = Function("halved", _halved_until_small, ("float",), ("float",), branches=True)
    builder = Builder.begin("branches")
    flag = builder.load("flag", "bool")
    a = builder.load("a", "float")
    builder.under(flag).call(called, a, into=a)
    builder.store("a", a)
    same_both_ways(builder.program, Setting(300, precision))


@function("float", "float")
def calls_nothing_known(x):
    y = x + 1.0
    return y + no_such_function(y)  # noqa: F821  unknown


@function("float vec3", "float")
def adds_vector_to_number(x, v):
    y = x + 1.0
    return y + v  # added


@function("float", "vec3")
def returns_a_number(x):
    return x * 2.0  # number


@function("float", "float float float")
def returns_two(x):
    return x, x  # two


@function("float", "float")
def uses_text(x):
    return where(x > 0.0, "a", x)  # text


def line_of(mark: str) -> int:
    return next(k for k, text in enumerate(Path(HERE).read_text().splitlines(), 1) if text.endswith(f"  {mark}"))


WRONG = [
    (calls_nothing_known, "unknown", "there is no 'no_such_function' here."),
    (adds_vector_to_number, "# added", "there is no float + Vec3"),
    (uses_text, "# text", "where takes (condition, a, b), and is given (bool, a, float)"),
    (returns_a_number, "# number", "it returns float where Vec3 is declared"),
    (returns_two, "# two", "tuple index out of range"),
]


@pytest.mark.parametrize("wrong, mark, message", WRONG)
def test_wrong_node_is_told_at_its_own_line(wrong, mark, message):
    """An unknown name, types that do not go together and a wrong result are told at the author's own line."""
    with pytest.raises(NodeError) as caught:
        kernel_of(wrong)
    assert str(caught.value) == f"{HERE}:{line_of(mark)}: {wrong.name}: {message}"
