"""What an instruction would find again is not found again; what may have changed is."""

from __future__ import annotations

import numpy as np

from graphfx.motion import basic
from graphfx.plan.sharing import share
from graphfx.program import Builder, Call, Column, Uniform
from graphfx.program.reference import run_particle

TWO = Uniform("2", "float", 2.0)


def calls(program):
    """Return the names of a program's functions in order, those inside loops too."""
    return [step.function.name for step in program.walk() if isinstance(step, Call)]


def outcome(program, loaded):
    """Return what plain Python stores for one particle."""
    values = run_particle(program, loaded, {})
    return {name: float(values[id(column)]) for name, column in program.stores.items()}


def test_the_same_call_is_made_once():
    """Two equal sums of the same numbers are one instruction, and both names are stored."""
    builder = Builder.begin("sums")
    a = builder.load("a", "float")
    builder.store("x", builder.call(basic.sum_of_numbers, a, TWO))
    builder.store("y", builder.call(basic.sum_of_numbers, a, Uniform("two", "float", 2.0)))
    share(builder.program)
    assert calls(builder.program) == ["sum_of_numbers"]
    assert outcome(builder.program, {"a": 1.0}) == {"x": 3.0, "y": 3.0}


def test_a_result_of_a_shared_call_is_shared_too():
    """What rests on equal results is equal."""
    builder = Builder.begin("chain")
    a = builder.load("a", "float")
    for name in ("x", "y"):
        builder.store(name, builder.call(basic.half, builder.call(basic.sum_of_numbers, a, TWO)))
    assert calls(share(builder.program)) == ["sum_of_numbers", "half"]


def test_zeros_of_either_sign_are_two_constants():
    """0 and -0 are equal numbers but not equal bits."""
    builder = Builder.begin("zeros")
    a = builder.load("a", "float")
    for name, zero in (("x", 0.0), ("y", -0.0)):
        builder.store(name, builder.call(basic.sum_of_numbers, a, Uniform(name, "float", zero)))
    share(builder.program)
    assert [np.signbit(number) for number in outcome(builder.program, {"a": -0.0}).values()] == [False, True]


def test_a_changed_operand_is_another():
    """A sum is found again after its operand was written in place."""
    builder = Builder.begin("changed")
    a = builder.load("a", "float")
    builder.store("x", builder.call(basic.sum_of_numbers, a, TWO))
    builder.call(basic.sum_of_numbers, a, TWO, into=a)
    builder.store("y", builder.call(basic.sum_of_numbers, a, TWO))
    assert calls(share(builder.program)) == ["sum_of_numbers"] * 3
    assert outcome(builder.program, {"a": 1.0}) == {"x": 3.0, "y": 5.0}


def test_another_mask_is_another_call():
    """What was found for some particles is not there for others."""
    builder = Builder.begin("masks")
    a = builder.load("a", "float")
    small = builder.call(basic.is_less, a, TWO)
    builder.under(small).call(basic.half, a)
    builder.store("x", builder.call(basic.half, a))
    assert calls(share(builder.program)) == ["is_less", "half", "half"]


def test_every_turn_of_a_loop_finds_its_own():
    """A doubling in a loop that changes its operand is not the one from before the loop, nor is one after it."""
    builder = Builder.begin("loop")
    a, x = builder.load("a", "float"), Column("x", "float")
    builder.call(basic.copy_number, TWO, into=x)
    builder.call(basic.sum_of_numbers, a, a)
    going = builder.call(basic.is_less, a, Uniform("100", "float", 100.0))
    inner = builder.loop(going, 9)
    everyone = inner.under(builder.mask)
    for _ in range(2):
        inner.call(basic.copy_number, everyone.call(basic.sum_of_numbers, a, a), into=x)
    inner.call(basic.copy_number, x, into=a)
    inner.call(basic.is_less, a, Uniform("100", "float", 100.0), into=going)
    builder.store("x", x)
    builder.store("y", builder.call(basic.sum_of_numbers, a, a))
    share(builder.program)
    assert calls(builder.program).count("sum_of_numbers") == 3
    assert outcome(builder.program, {"a": 3.0}) == {"x": 192.0, "y": 384.0}
