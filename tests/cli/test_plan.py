"""`graphfx plan`: a listing that reads the same every time and says what is true."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from graphfx.graph.flatten import flatten
from graphfx.motion import basic
from graphfx.node import Library, bundled_root
from graphfx.plan.listing import ProgramListing, bytes_of, listing, plan_data
from graphfx.plan.make import Plan, make_plan
from graphfx.program import Builder, Call, Column, Draw, Loop
from graphfx.store.processors import Column as StoredColumn
from graphfx.store.processors import ProcessorSet

LIBRARY = Library()
PLANS = Path(__file__).parent / "plans"
EFFECTS = sorted((bundled_root() / "graphs" / "effects").glob("*.json"))


def planned(graph: Path) -> Plan:
    return make_plan(flatten(graph, LIBRARY))


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("type_", ["float", "vec3", "color", "mask", "id", "time", "count"])
def test_bytes_are_those_of_the_store(type_: str, precision: int) -> None:
    """The listing's bytes of every column type are what the store takes."""
    assert bytes_of(type_, precision) == ProcessorSet({"x": StoredColumn(type_)}, precision).bytes_per_row


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.stem)
def test_bytes_per_particle(effect: Path) -> None:
    """The sum shown for an emitter is what its processor set takes for a row."""
    plan = planned(effect)
    for shown, emitter in zip(plan_data(plan)["emitters"], plan.emitters.values(), strict=True):
        store = ProcessorSet({name: StoredColumn(type_) for name, type_ in emitter.attributes.columns.items()}, plan.precision)
        assert shown["bytes"] == store.bytes_per_row
        assert f"  {store.bytes_per_row} bytes a particle" in listing(plan).splitlines()


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.stem)
def test_listing_is_always_the_same(effect: Path) -> None:
    """Two plans of one graph read the same."""
    assert listing(planned(effect)) == listing(planned(effect))


@pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.stem)
def test_every_instruction_is_a_line(effect: Path) -> None:
    """A program has a line for each of its instructions, loops included, and the number stated is theirs."""
    plan = planned(effect)
    programs = [program for emitter in plan.emitters.values() for program in emitter.programs]
    listed = [program for emitter in plan_data(plan)["emitters"] for program in emitter["programs"]]
    for program, shown in zip(programs, listed, strict=True):
        count = sum(1 for _ in program.walk())
        assert shown["instructions"] == count
        body = [line for line in shown["lines"] if not line.startswith(("given ", "load ", "once, ", "reject ", "store ", "  "))]
        loops = sum(isinstance(instruction, Loop) for instruction in program.body)
        assert len(body) == len(program.body)
        assert sum(line.startswith("while ") for line in body) == loops


def test_nothing_is_lost_between_kept_and_dropped() -> None:
    """Every node of the flattened graph is either kept, or dropped with a reason."""
    plan = planned(PLANS / "overgrown.json")
    nodes = {node["path"]: node for node in plan_data(plan)["nodes"]}
    assert nodes.keys() == plan.flat.nodes.keys()
    assert {path: node["reason"] for path, node in nodes.items() if not node["kept"]} == {
        "fall/still": "it does nothing: magnitude == 0 and lift == 0", "fall/off": "not enabled",
        "fall/late": "acts from 9 to 10 s, outside the simulated 0 to 0.208333 s", "unseen": "no output depends on it"}


@pytest.mark.parametrize("graph", sorted(PLANS.glob("*.json")), ids=lambda graph: graph.stem)
def test_listing_is_as_kept(graph: Path) -> None:
    """The whole listing of a small graph is as in the file beside it; `graphfx plan X.json > X.txt` writes it anew."""
    assert listing(planned(graph)) + "\n" == graph.with_suffix(".txt").read_text()


def test_repeated_names_are_numbered() -> None:
    """Two columns of one name are told apart; one column keeps its name throughout."""
    plan = planned(EFFECTS[0])
    for program in (program for emitter in plan.emitters.values() for program in emitter.programs):
        names: dict[int, str] = {}
        shown = ProgramListing(program)
        for instruction in program.walk():
            for column in _columns(instruction):
                assert names.setdefault(id(column), shown.name(column)) == shown.name(column)
        assert len(set(names.values())) == len(names)


def _columns(instruction: object) -> list[Column]:
    if isinstance(instruction, Call):
        return [*instruction.results, *(operand for operand in instruction.operands if isinstance(operand, Column))]
    return [instruction.result] if isinstance(instruction, Draw) else []


def test_command_prints_the_listing(invoke, folder: Path) -> None:
    """`plan` prints the listing, `--json` the same facts, and `--source` a kernel for each function used."""
    plan = planned(folder / "fountain.json")
    assert invoke("plan", "fountain.json") == (0, listing(plan) + "\n", "")
    assert json.loads(invoke("plan", "fountain.json", "--json").out) == json.loads(json.dumps(plan_data(plan)))
    code, out, err = invoke("plan", "fountain.json", "--source")
    assert (code, err) == (0, "")
    assert out.startswith(listing(plan))
    functions = [call.function for emitter in plan.emitters.values() for program in emitter.programs
                 for call in program.walk() if isinstance(call, Call)]
    kernels = {function.bundle.name if function.bundle else function.name for function in functions}
    assert set(re.findall(r"^kernel (\w+)$", out, re.MULTILINE)) == kernels
    assert out.count("  def kernel(") == len(kernels)


def test_set_changes_the_plan(invoke) -> None:
    """A parameter given on the command line is in the program as a constant."""
    assert "(0, 5, 0)" in invoke("plan", "fountain.json", "--set", "speed=5").out


def test_constants_of_loops_and_masks() -> None:
    """Loops are indented under their condition; a mask other than the program's context stands in brackets."""
    builder = Builder.begin("test")
    x = builder.load("x", "float")
    going = builder.call(basic.is_less, x, x, name="still going")
    builder.loop(going, 7, "a note").call(basic.copy_number, x, into=x)
    builder.store("y", x)
    assert [re.sub(" +;", " ;", line) for line in ProgramListing(builder.program).lines()] == [
        "load    x", "still_going = is_less x, x", "while still_going, at most 7 times: ; a note",
        "  x = copy_number x [still_going] ; a note", "store   y = x"]
