"""The contract finds what is wrong with a node, and says with which numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from graphfx.contract import Subject, subject, truths_of
from graphfx.contract.inputs import Inputs

HERE = Path(__file__).parent
FAULTS = [
    ("bent", "is_linear", "it is not linear in velocity: ["),
    ("gusty", "is_proportional", "it is not proportional to noise: ["),
    ("hasty", "composes", "two half steps do not give the position of a whole one: ["),
    ("jumpy", "composes", "a step of no time changes the position: ["),
    ("unbounded", "stays_finite", " rows are not finite in float32, for instance with position="),
    ("slanted", "has_a_surface", "its normal has length "),
    ("inverted", "has_a_surface", "its normal does not point to greater distance with position="),
    ("steep", "has_a_surface", "its distance changes faster than the particle moves: position="),
    ("misled", "has_its_linear_form", "its linear form is not its rate of change: ["),
    ("strayed", "has_its_exact_flow", "its flow does not change the velocity as it declares: ["),
    ("averted", "stops_a_way", "its plane does not part start from end with start="),
    ("busy", "does_nothing_when_neutral", "it says that it is neutral when strength == 0, and is not: ["),
    ("endless", "stays_finite_at_the_ends_of_draws", "it is not finite for the draw (0.0, 0.0, 0.0, 0.0) with "),
    ("torn", "makes_sound_meshes",
     "the mesh has triangles with corners that are not there: vertices count from 0 to 2 with size=3"),
    ("terse", "is_documented", "the first line of its file should begin with a capital: 'no sentence'"),
    ("silent", "cooks", "the plan of its sample leaves the node out"),
]


def test_every_faulty_node_is_listed() -> None:
    """Each node of the faulty library stands in the table of faults."""
    assert {name for name, _, _ in FAULTS} == {file.stem for file in (HERE / "faulty" / "nodes").rglob("[!_]*.py")}


@pytest.mark.parametrize(("name", "truth", "complaint"), FAULTS)
def test_fault_is_found(name: str, truth: str, complaint: str) -> None:
    """A node with one fault breaks the truth that is about it, and only that one."""
    wrong = subject(name, HERE / "faulty")
    told: dict[str, str] = {}
    for each in truths_of(wrong):
        try:
            each(wrong)
        except AssertionError as error:
            told[each.__name__] = str(error)
    assert list(told) == [truth]
    assert complaint in told[truth]


def _bumped(wrong: Subject) -> None:
    """Change the last bit of one of the machine's results."""
    part = wrong.on_machine(32)["result 0"][1]
    part[5] = np.nextafter(part[5], np.float32(np.inf))


@pytest.mark.parametrize("truth", ["machine_is_plain_python", "does_not_depend_on_order"])
def test_one_bit_is_found(truth: str) -> None:
    """A result that differs in its last bit is found."""
    wrong = subject("vortex")
    check = next(each for each in truths_of(wrong) if each.__name__ == truth)
    check(wrong)
    _bumped(wrong)
    with pytest.raises(AssertionError, match=r"1 of .* rows differ"):
        check(wrong)


@pytest.mark.parametrize("name", ["vortex", "attract", "in_cone", "bounce_plane"])
def test_inputs_keep_to_the_declaration(name: str) -> None:
    """Whatever the contract gives a node lies within the ranges that it declares, and reaches both of their ends."""
    node_type = subject(name).node_type
    rows = Inputs(node_type).rows()
    for parameter in node_type.parameters.values():
        if parameter.name not in rows[0]:
            continue
        given = np.array([row[parameter.name] for row in rows], float)
        for bound, extreme in ((parameter.min, given.min()), (parameter.max, given.max())):
            assert bound is None or extreme == bound, parameter.name
        if parameter.type == "direction":
            assert np.allclose(np.linalg.norm(given, axis=1), 1)


def test_inputs_are_the_same_each_time() -> None:
    """The contract is the same each time that it is run."""
    node_type = subject("vortex").node_type
    assert Inputs(node_type).rows() == Inputs(node_type).rows()
