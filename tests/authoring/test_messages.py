"""Mistakes in Python are told at the author's own line, in the words of the checks."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

import graphfx
from graphfx.errors import GraphError

HERE = __file__


def line() -> int:
    """Return the line of the test that calls this."""
    frame = inspect.currentframe()
    assert frame is not None and frame.f_back is not None
    return frame.f_back.f_lineno


def told(error: pytest.ExceptionInfo[GraphError]) -> str:
    return str(error.value)


def test_unknown_type() -> None:
    """A name that the library lacks is told with the nearest one."""
    with pytest.raises(GraphError) as error:
        graphfx.Graph().emitt("sky")
    assert told(error) == f"{HERE}:{line() - 1}: there is no node type, value or group 'emitt'. Did you mean 'emit'?"


def test_other_names() -> None:
    """What another tool calls a node type is understood."""
    with pytest.raises(GraphError, match=r"there is no node type, value or group 'attractor'\. Did you mean 'attract'\?"):
        graphfx.Graph().attractor()


def test_unknown_parameter() -> None:
    """A parameter that a node lacks is told with what it takes."""
    g = graphfx.Graph()
    with pytest.raises(GraphError) as error:
        g.emit("sky", rte=3)
    assert told(error) == (f"{HERE}:{line() - 1}: nodes.sky.rte: emit has no parameter 'rte'. Did you mean 'rate'?\n"
                           + "\n".join(map(str, told(error).splitlines()[1:])))
    assert told(error).splitlines()[1].startswith("  emit takes: rate [1/s], life [s]")
    assert told(error).splitlines()[2] == "  declared in nodes/emitters/emit.py"


def test_unknown_parameter_of_a_value() -> None:
    """A parameter that a value lacks is told where the value is made."""
    with pytest.raises(GraphError) as error:
        graphfx.Graph().in_box(mini=(0, 0, 0))
    assert told(error) == (f"{HERE}:{line() - 1}: in_box.mini: in_box has no parameter 'mini'. Did you mean 'min'?\n"
                           "  in_box takes: min, max\n  declared in nodes/values/in_box.py")


def test_line_is_that_of_the_part() -> None:
    """In a call over several lines, the value that is wrong is told at its own line."""
    g = graphfx.Graph()
    with pytest.raises(GraphError) as error:
        g.emit("sky", set={
            "position": g.in_box(),
            "radius": g.rand(1, "x"),
        })
    assert told(error).startswith(f"{HERE}:{line() - 2}: nodes.sky.set.radius.rand[1]: ")


def test_all_mistakes_of_a_call_are_told() -> None:
    """Every mistake of a call is told, not only the first; an operator in a chain has its own line."""
    stack = graphfx.Graph().emit("sky").stack("fall")
    with pytest.raises(GraphError) as error:
        (stack
            .gravity()
            .vortex(magnitud=2, tightness=9))
    problems = error.value.problems
    assert [problem.path for problem in problems] == ["nodes.fall.ops[1].magnitud", "nodes.fall.ops[1].tightness"]
    assert {(problem.location.file, problem.location.line) for problem in problems} == {(HERE, line() - 3)}


def test_wrong_call_leaves_the_graph_alone() -> None:
    """What was refused is not in the graph."""
    g = graphfx.Graph()
    stack = g.emit("sky").stack("fall")
    for wrong in (lambda: g.emit("b", rate=-1), lambda: stack.vortex(tightness=9), lambda: g.param("x", "red", type="float")):
        before = g.text
        with pytest.raises(GraphError):
            wrong()
        assert g.text == before


def test_second_node_of_a_name() -> None:
    """An id is used once; the message says where it was."""
    g = graphfx.Graph()
    g.emit("sky")
    with pytest.raises(GraphError) as error:
        g.emit("sky")
    assert told(error) == (f"{HERE}:{line() - 1}: nodes.sky: there is a node 'sky' already, made at {HERE}:{line() - 3}; "
                           "give this one another id")


def test_what_only_the_whole_shows(tmp_path: Path) -> None:
    """A reference to no node is told when the graph is saved, at the line of the node that makes it."""
    g = graphfx.Graph()
    g.vortex("turn", of="skyy")
    made = line() - 1
    g.emit("sky")
    with pytest.raises(GraphError) as error:
        g.save(tmp_path / "wrong.json")
    assert told(error) == (f"{HERE}:{made}: nodes.turn.from: there is no node 'skyy'. Did you mean 'sky'?\n"
                           "  nodes that make a stream: turn, sky")
    assert not (tmp_path / "wrong.json").exists()


def test_saving_where_a_group_is_not(tmp_path: Path) -> None:
    """A graph whose groups are not to be found from where it is saved is not saved there."""
    (tmp_path / "out").mkdir()
    group = graphfx.Graph("Nothing.")
    group.output(particles=group.input("particles").gravity("fall"))
    group.save(tmp_path / "fall.json")
    g = graphfx.Graph(folder=tmp_path)
    g.use("fall.json", "falling")
    used = line() - 1
    g.emit("sky").stack("all").falling()
    g.save(tmp_path / "whole.json")
    with pytest.raises(GraphError) as error:
        g.save(tmp_path / "out" / "whole.json")
    assert told(error).splitlines()[0] == f"{HERE}:{used}: use.falling: there is no file 'fall.json'."


@pytest.mark.parametrize(("call", "message"), [
    (lambda g: g.emit(4000), "what stands first in emit(...) is its id, a text; give everything else by name"),
    (lambda g: g.in_box("a"), "in_box is a value and has no id; give its parameters by name"),
    (lambda g: g.emit("a", rate=float("nan")), "nodes.a.rate: NaN is no value; give a number"),
    (lambda g: g.emit("a", set={"mass": object()}),
     "nodes.a.set.mass: object is nothing that a graph holds; give a number, a text, a list, or a value of the graph"),
    (lambda g: bool(g.expr("age > 1") and g.expr("age < 2")),
     "whether particles pass is known only in the cook; combine conditions with &, | and ~"),
    (lambda g: g["skyy"], "there is no node 'skyy'. Did you mean 'sky'?"),
    (lambda g: g.values(age=1), "values.age: a value cannot be called 'age', which already means something in expressions; "
                                "choose another name"),
    (lambda g: g.use("groups/gst.json"),
     "use.gst: there is no file 'groups/gst.json'. Did you mean 'groups/gust.json'?"),
])
def test_wrong_calls(call, message: str) -> None:
    """Whatever a call gets wrong is told with its line."""
    g = graphfx.Graph()
    g.emit("sky")
    with pytest.raises(GraphError) as error:
        call(g)
    assert told(error).splitlines()[0] == f"{HERE}:{call.__code__.co_firstlineno}: {message}"


def test_unknown_setting() -> None:
    """A setting that graphs lack is told with those that they have."""
    with pytest.raises(GraphError) as error:
        graphfx.Graph(fbs=24)
    assert told(error) == (f"{HERE}:{line() - 1}: a graph has no setting 'fbs'. Did you mean 'fps'?\n  Graph takes: doc, seed, "
                           "name, folder, library, fps, frames, preroll, substeps, method, order, tolerance, precision")


def test_unknown_names_are_no_attributes() -> None:
    """`hasattr` is false for a name that nothing has, and copying asks in vain for Python's own."""
    g = graphfx.Graph()
    assert (hasattr(g, "teapot"), hasattr(g, "_repr_html_"), hasattr(g, "vortex")) == (False, False, True)


def test_line_of_what_is_written_again() -> None:
    """What is written again is told at its new line, and not at those of its former parts."""
    g = graphfx.Graph()
    g.values(speed=g.in_box(min=g.expr("vec(0, 0, 0)")))
    g.values(speed=2)
    written = line() - 1
    g._draft.data["values"]["speed"] = {"in_box": {"min": "x"}}
    assert [problem.location.line for problem in g.problems() if problem.path == "values.speed.in_box.min"] == [written]
