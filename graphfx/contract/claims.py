"""What an operator claims by its role, checked in plain Python in float64."""

from __future__ import annotations

import inspect
import re
from dataclasses import replace
from typing import Any

import numpy as np

import graphfx.math
from graphfx.contract.both_ways import plainly
from graphfx.contract.inputs import Inputs, Row, pairs, shown
from graphfx.contract.subject import Subject
from graphfx.math import Vec3
from graphfx.node import NodeType

COUNT = 40
CLOSE = 1e-7
"""Largest defect, relative to the size of what is compared."""
STATES = ("position", "velocity")
NUDGE = 1e-4
"""Step along a normal [m]."""
SOON = 1e-6
"""Time in which a rate of change is measured [s]."""


def is_linear(subject: Subject) -> None:
    """A linear operator's rate of change is affine in position and velocity: f(a + b) + f(0) = f(a) + f(b)."""
    node_type = subject.node_type
    state = [name for name in node_type.reads if name in STATES]
    for one, other in pairs(_rows(subject)):
        other = one | {name: other[name] for name in state}
        total = one | {name: _sum(one[name], other[name]) for name in state}
        zero = one | dict.fromkeys(state, (0.0, 0.0, 0.0))
        parts = [plainly(node_type, row)[0] for row in (total, zero, one, other)]
        _close(parts[0] + parts[1], parts[2] + parts[3], f"it is not linear in {' and '.join(state)}", one)


def is_proportional(subject: Subject) -> None:
    """What a noise operator gives is proportional to its random vector: f(a + b) = f(a) + f(b), and f(0) = 0."""
    for one, other in pairs(_rows(subject)):
        total = _sum(one["noise"], other["noise"])
        whole, first, second, none = (
            plainly(subject.node_type, one, noise=vector)[0] for vector in (total, one["noise"], other["noise"], (0.0, 0.0, 0.0))
        )
        _close(first + second, whole, "it is not proportional to noise", one)
        _close(none, np.zeros(3), "it is not 0 without noise", one)


def composes(subject: Subject) -> None:
    """A flow is exact: two half steps are one whole step, and a step of no time changes nothing."""
    node_type = subject.node_type
    for row in _rows(subject):
        whole = plainly(node_type, row)
        half = row["dt"] / 2
        between = dict(zip(node_type.writes, map(tuple, plainly(node_type, row, dt=half)), strict=True))
        twice = plainly(node_type, row, dt=half, **between)
        still = plainly(node_type, row, dt=0.0)
        for name, one, two, none in zip(node_type.writes, whole, twice, still, strict=True):
            _close(one, two, f"two half steps do not give the {name} of a whole one", row)
            _close(none, np.asarray(row[name], float), f"a step of no time changes the {name}", row)


def has_a_surface(subject: Subject) -> None:
    """A surface's normal has length 1 and points to greater distance, and no distance changes faster than the particle moves."""
    node_type = subject.node_type
    for one, other in pairs(_rows(subject)):
        other = one | {"position": other["position"]}
        (distance,), normal = plainly(node_type, one)
        size = float(np.linalg.norm(normal))
        assert abs(size - 1) < 1e-6, f"its normal has length {size:g} with {shown(one)}"
        moved = tuple(np.asarray(one["position"]) + NUDGE * normal)
        (beyond,), _ = plainly(node_type, one, position=moved)
        assert beyond > distance, f"its normal does not point to greater distance with {shown(one)}"
        (elsewhere,), _ = plainly(node_type, other)
        way = np.linalg.norm(np.subtract(one["position"], other["position"]))
        slow = abs(distance - elsewhere) <= way * (1 + CLOSE)
        assert slow, f"its distance changes faster than the particle moves: {shown(one)}"


def stops_a_way(subject: Subject) -> None:
    """A surface that a way meets stops it at a plane between its ends, whose normal of length 1 looks to the start."""
    node_type = subject.node_type
    met = 0
    for row in _rows(subject):
        (meets,), point, normal = plainly(node_type, row)
        if not meets:
            continue
        met += 1
        size = float(np.linalg.norm(normal))
        assert abs(size - 1) < 1e-6, f"its normal has length {size:g} with {shown(row)}"
        before, behind = (float(np.dot(np.subtract(row[end], point), normal)) for end in ("start", "end"))
        assert before >= -NUDGE and behind <= NUDGE, f"its plane does not part start from end with {shown(row)}"
    assert met, "no way meets it"


def does_nothing_when_neutral(subject: Subject) -> None:
    """Where its `neutral` condition holds, an operator changes nothing."""
    node_type = subject.node_type
    named = [name for name in node_type.parameters if re.search(rf"\b{name}\b", node_type.neutral)]
    for row in _rows(subject):
        still = row | {name: (0.0, 0.0, 0.0) if np.size(row[name]) == 3 else 0.0 for name in named}
        names = {name: Vec3(*still[name]) if np.size(still[name]) == 3 else still[name] for name in named}
        if not eval(node_type.neutral, vars(graphfx.math) | {"infinity": float("inf")} | names):
            return  # neutral at other values than zeros
        before = [np.asarray(still[name], float) if node_type.role in ("flow", "assign") else 0.0 for name in node_type.writes]
        if node_type.role == "flow" and {"position", "velocity"} <= {*node_type.writes}:
            before[node_type.writes.index("position")] += np.multiply(still["velocity"], still["dt"])
        for result, kept in zip(plainly(node_type, still), before, strict=True):
            complaint = f"it says that it is neutral when {node_type.neutral}, and is not"
            _close(result, kept + np.zeros_like(result), complaint, still)


def has_its_linear_form(subject: Subject) -> None:
    """Where its `exact_if` holds, a flow's rate of change is that of its linear form: (f(h) - f(0)) / h for a small h."""
    node_type = subject.node_type
    assert node_type.linear is not None
    names = inspect.signature(node_type.linear).parameters
    rate_type = replace(node_type, function=node_type.linear, arguments=tuple(names))
    for row in _rows(subject):
        exact = row | _exact_values(node_type)
        after, before = (plainly(node_type, exact, dt=dt)[-1] for dt in (SOON, 0.0))
        (rate,) = plainly(rate_type, exact)
        _close((after - before) / SOON, rate, "its linear form is not its rate of change", exact, 1e-3)


def has_its_exact_flow(subject: Subject) -> None:
    """Where its `exact_if` holds, an acceleration's flow composes, carries by the velocity, and changes it as is declared."""
    node_type, whole = subject.node_type, subject.whole
    assert whole is not None
    composes(whole)
    for row in Inputs(replace(node_type, arguments=_together(node_type, whole.node_type)), seed=7).ordinary_rows(COUNT):
        exact = row | _exact_values(node_type)
        (_, before), (place, after) = (plainly(whole.node_type, exact, dt=dt) for dt in (0.0, SOON))
        (rate,) = plainly(node_type, exact)
        _close((after - before) / SOON, rate, "its flow does not change the velocity as it declares", exact, 1e-3)
        way = np.subtract(place, row["position"]) / SOON
        _close(way, before, "its flow does not carry by the velocity", exact, 1e-3)


def _together(one: NodeType, other: NodeType) -> tuple[str, ...]:
    return tuple(dict.fromkeys((*one.arguments, *other.arguments)))


def _exact_values(node_type: NodeType) -> Row:
    """Return values of parameters under which `exact_if` holds."""
    conditions = re.findall(r"(\w+) == ([\w.+-]+)", node_type.exact_if)
    return {name: float(value.replace("infinity", "inf")) for name, value in conditions}


def _rows(subject: Subject) -> list[Row]:
    return Inputs(subject.node_type, seed=7).ordinary_rows(COUNT)


def _sum(one: Any, other: Any) -> tuple[float, ...]:
    return tuple(np.add(one, other))


def _close(one: np.ndarray, other: np.ndarray, complaint: str, row: Row, close: float = CLOSE) -> None:
    size = 1 + np.abs(other).max(initial=0.0)
    assert np.all(np.abs(one - other) <= close * size), f"{complaint}: {one} against {other} with {shown(row)}"


BY_ROLE = {
    "linear": (is_linear,),
    "noise": (is_proportional,),
    "flow": (composes, has_its_linear_form),
    "acceleration": (has_its_exact_flow,),
    "surface": (has_a_surface, stops_a_way),
}
"""The claims of each role."""
ALL = tuple(dict.fromkeys((*sum(BY_ROLE.values(), ()), does_nothing_when_neutral)))


def applies(subject: Subject, claim: Any) -> bool:
    """Return whether a claim can be put to the test: its function is handed numbers alone, and a flow reads no clock."""
    node_type = subject.node_type
    if claim is does_nothing_when_neutral:
        return subject.is_closed and bool(node_type.neutral) and node_type.role in ("linear", "flow", "acceleration", "assign")
    if not subject.is_closed or claim not in BY_ROLE.get(node_type.role, ()):
        return False
    if claim in (has_a_surface, stops_a_way):
        return ("start" in node_type.arguments) == (claim is stops_a_way)
    if claim is has_its_linear_form:
        return node_type.linear is not None
    if claim is has_its_exact_flow:
        return node_type.flow is not None
    return claim is not composes or not {"time", "frame"} & {*node_type.reserved}
