"""What must be true of every node, each as a function that raises AssertionError with the case that breaks it."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np

from graphfx.authoring.sample import example
from graphfx.contract.both_ways import finite, plainly, same_bits
from graphfx.contract.inputs import Inputs, shown
from graphfx.contract.subject import Subject
from graphfx.errors import GraphfxError
from graphfx.geometry.mesh import checked
from graphfx.node import NUMERIC_TYPES, Parameter

Truth = Callable[[Subject], None]
PRECISIONS = (32, 64)
ROWS = 3


def is_documented(subject: Subject) -> None:
    """The file opens with a summary that ends a sentence, and the function says what it returns."""
    node_type = subject.node_type
    summary = node_type.doc.strip().splitlines()[0]
    assert summary[:1].isupper(), f"the first line of its file should begin with a capital: {summary!r}"
    assert re.search(r"[.:\]]$", summary), f"the first line of its file should be a sentence with a full stop: {summary!r}"
    own = (node_type.function.__doc__ or "").strip()
    assert own.endswith("."), "the function itself needs a docstring, one sentence on what it returns"
    for parameter in node_type.parameters.values():
        sentence = not parameter.doc[:1].islower() and parameter.doc.endswith(".")
        assert sentence, f"the doc of '{parameter.name}' should be a sentence"


def has_defaults_in_range(subject: Subject) -> None:
    """Every parameter that is not required has a default of its type, within its range."""
    node_type = subject.node_type
    for parameter in node_type.parameters.values():
        if not parameter.required and not (node_type.language and parameter.default is None):
            problem = _wrong_default(parameter)
            assert not problem, f"the default of '{parameter.name}' {problem}"


def _wrong_default(parameter: Parameter) -> str:
    default = parameter.default
    if parameter.choices and parameter.type == "string":
        return "" if default in parameter.choices else f"is none of {parameter.choices}"
    if parameter.type not in NUMERIC_TYPES or parameter.type == "bool":
        return ""
    low = -np.inf if parameter.min is None else parameter.min
    high = np.inf if parameter.max is None else parameter.max
    if np.size(default) != NUMERIC_TYPES[parameter.type]:
        return f"has {np.size(default)} numbers"
    if not np.all((np.asarray(default) >= low) & (np.asarray(default) <= high)):
        return f"lies outside {low:g} to {high:g}"
    if parameter.type == "direction" and abs(np.linalg.norm(default) - 1) > 1e-6:
        return "has not length 1"
    return ""


def machine_is_plain_python(subject: Subject) -> None:
    """The block machine gives what plain Python gives, to the last bit, in float32 and in float64."""
    for precision in PRECISIONS:
        plain = subject.both_ways.run(subject.rows, precision, on_machine=False)
        wrong = np.flatnonzero(~same_bits(subject.on_machine(precision), plain))
        assert not wrong.size, (f"{wrong.size} of {len(subject.rows)} rows differ from plain Python in float{precision}, "
                                f"for instance with {shown(subject.rows[wrong[0]])}")


def stays_finite(subject: Subject) -> None:
    """Its results are finite for whatever its declaration allows."""
    for precision in PRECISIONS:
        wrong = np.flatnonzero(~finite(subject.on_machine(precision)))
        assert not wrong.size, (f"{wrong.size} of {len(subject.rows)} rows are not finite in float{precision}, for instance "
                                f"with {shown(subject.rows[wrong[0]])}; bound the parameter, or the result by where(...)")


def stays_finite_at_the_ends_of_draws(subject: Subject) -> None:
    """Its results are finite for the least and the greatest random numbers: 0, and the last before 1."""
    rows = Inputs(subject.node_type, seed=5).ordinary_rows(ROWS)
    for real, last in ((np.float32, 1 - 2.0**-24), (np.float64, 1 - 2.0**-32)):
        for row, draw in product(rows, product((0.0, last), repeat=4)):
            results = plainly(subject.node_type, row, real, draw=draw)
            assert all(np.isfinite(result).all() for result in results), f"it is not finite for the draw {draw} with {shown(row)}"


def makes_sound_meshes(subject: Subject) -> None:
    """A geometry's mesh has points, all finite, and no corner that is not there, at the ends of its parameters too."""
    parameters = [subject.node_type.parameters[name] for name in subject.node_type.arguments]
    usual = {parameter.name: example(parameter) if parameter.required else parameter.default for parameter in parameters}
    cases = [usual, *({**usual, parameter.name: end} for parameter in parameters for end in _ends(parameter))]
    for given in cases:
        try:
            checked(subject.node_type.function(**given), "the mesh")
        except GraphfxError as error:
            raise AssertionError(f"{error} with {shown(given)}") from error


def _ends(parameter: Parameter) -> list[Any]:
    """Return the least value of a numeric parameter, and one that is larger than usual."""
    if parameter.type not in ("float", "int", "vec3") or parameter.required:
        return [False, True] if parameter.type == "bool" else []
    least = [] if parameter.min is None else [np.full(np.shape(parameter.default), parameter.min)]
    ends = [*least, 2 * np.asarray(parameter.default) + 1]
    plain = [end.tolist() for end in ends if parameter.max is None or np.all(end <= parameter.max)]
    return [tuple(end) if isinstance(end, list) else int(end) if parameter.type == "int" else end for end in plain]


def does_not_depend_on_order(subject: Subject) -> None:
    """A particle's result is the same in whatever order particles run."""
    order = np.random.default_rng(1).permutation(len(subject.rows))
    same = same_bits(subject.on_machine(32), subject.on_machine(32, order))
    assert same.all(), f"{(~same).sum()} of {len(subject.rows)} rows differ when the particles are permuted"
