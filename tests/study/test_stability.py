"""What the stability runs find: nothing of a sample of the library, and whatever is wrong with a node."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from graphfx.node import Library, library_roots
from graphfx.study.data import paths_in
from graphfx.study.stability import (
    GREAT,
    Case,
    Stability,
    cases_of,
    ends_of,
    graph_of,
    run_case,
    stability,
    states,
    tried,
)
from graphfx.study.stability_page import FIELDS, lines, stability_data, stability_page

from .problems import LIBRARY

NODE = '''"""Doubtful: an operator.

    A = {formula}
"""

from graphfx.math import Vec3, sqrt
from graphfx.node import operator, param


@operator.acceleration()
def doubtful(position: Vec3, strength: float = param(1.0, unit="m/s^2", min=-4, doc="Strength.")) -> Vec3:
    """Return the acceleration."""
    return {formula}
'''


def outcome_of(operators, method="strang", precision=64, step=1 / 24, library=LIBRARY) -> Case:
    case = Case(tuple(operators), method, precision, step)
    run_case(case, graph_of(operators, library))
    return case


def defaults(name, library=LIBRARY):
    return ends_of(library[name])[0]


@pytest.fixture(scope="module")
def sample() -> Stability:
    return stability(LIBRARY, every=250)


def test_no_sampled_operator_leaves_the_numbers_untold(sample):
    """Of a sample of all operators, alone and in pairs, every run is finite, or given up with its reason, or not made."""
    assert len(sample.cases) > 80
    assert {case.outcome for case in sample.cases} <= {"finite", "failed", "refused", "not_tried"}
    assert all(case.message for case in sample.cases if case.outcome != "finite")


def test_every_operator_that_moves_is_tried():
    """The library's operators are found by themselves; every pair of them is tried."""
    names = {found.name for found in tried(LIBRARY)[0]}
    assert names >= {"attract", "vortex", "bounce_mesh", "random_acceleration", "spring", "transform"} and "fade" not in names
    pairs = {tuple(each.name for each in case) for case in cases_of(LIBRARY)[0] if len(case) == 2}
    assert len(pairs) == len(names) * (len(names) - 1) // 2


def test_ends_are_those_declared():
    """damp: damping from -50 to a million, threshold from 0; every parameter alone, and all together."""
    given = [dict(each.arguments) for each in ends_of(LIBRARY["damp"])]
    assert given[:3] == [{}, {"damping": -50, "threshold": 0}, {"damping": GREAT, "threshold": GREAT}]
    assert {"damping": -50} in given and {"threshold": GREAT} in given


def test_places_and_speeds_of_all_sizes():
    """Particles begin at rest and at 1e5 m/s, in the middle and at 1e6 m, along their ways and across."""
    position, velocity = states()
    assert position.shape == velocity.shape == (50, 3)
    assert {float(f"{math.hypot(*each):.6g}") for each in position} == {0.0, 1e-30, 1e-3, 1.0, 1e6}
    assert {float(f"{math.hypot(*each):.6g}") for each in velocity} == {0.0, 1e-30, 1e-3, 1.0, 1e5}


@pytest.mark.parametrize("formula, step, wanted", [
    ("position * strength", 1 / 24, "finite"),
    ("position * sqrt(strength)", 1 / 24, "finite"),
    ("position * sqrt(-strength)", 1 / 24, "failed"),
    ("position * sqrt(-strength)", 1e-3, "bug"),
    ("position * (strength * 1e300 * 1e300)", 1e-6, "bug"),
    ("Vec3(1.0, 1.0, 1.0) * (strength * 1e308) * 1e308", 1.0, "failed"),
])
def test_a_doubtful_node_is_found_out(tmp_path: Path, formula, step, wanted):
    """What is sound is finite; the root of a negative number, infinity, and that times zero are given up, and wrong in a step
    so short that nothing grows in it."""
    (tmp_path / "nodes" / "operators").mkdir(parents=True)
    (tmp_path / "nodes" / "operators" / "doubtful.py").write_text(NODE.format(formula=formula), encoding="utf-8")
    library = Library(library_roots([tmp_path]))
    case = outcome_of([defaults("doubtful", library)], step=step, library=library)
    assert (case.outcome, case.message) == (wanted, "" if wanted == "finite" else "a step would lead beyond the numbers")


def test_a_refusal_keeps_its_message():
    """What the plan refuses is told with what it says."""
    case = outcome_of([defaults("vortex"), defaults("gravity")], method="exact")
    assert case.outcome == "refused" and case.message.startswith("there is no exact solution")


def test_noise_over_very_long_steps_is_not_tried():
    """A step that would meet many thousand cells of noise is told, and not tried."""
    case = outcome_of([defaults("random_acceleration")], step=1e3)
    assert case.outcome == "not_tried" and "24,000 cells" in case.message


def test_results_are_told(sample):
    """The first line counts all runs; data have the documented fields; the page is whole and needs nothing else."""
    assert next(lines(sample)).startswith(f"{len(sample.cases):,} runs of ")
    data = stability_data(sample)
    assert sum(data["counts"].values()) == len(sample.cases)
    inner = {path for path in paths_in(data) if not path.startswith(("counts.", "outcomes.", "greatest.", "left_out."))}
    assert inner <= FIELDS.keys()
    page = stability_page(sample)
    assert page.count("<tr") == page.count("</tr") == len(sample.operators) + 1
    assert "http" not in page and "<script" not in page


def test_ctrl_c_keeps_what_is_done():
    """What was tried before is kept, and it is said that it was stopped."""
    def stop(what: str, share: float) -> None:
        if share > 0.4:
            raise KeyboardInterrupt

    found = stability(LIBRARY, stop, every=800)
    assert found.stopped and len(found.cases) > 0 and stability_data(found)["stopped"] is True


def test_runs_alike_are_told_together():
    """Runs of the same operators with the same outcome stand in one line, by method and precision."""
    fast = (defaults("vortex"),)
    cases = [Case(fast, "strang", bits, step, "infinite") for bits in (32, 64) for step in (1.0, 1e3)]
    told = list(lines(Stability(cases)))
    assert told[1:] == ["grows beyond the numbers: vortex (defaults): strang, 32 bits, steps of 1 and 1e+03 s; "
                        "strang, 64 bits, steps of 1 and 1e+03 s"]
