"""Choose how motion is computed: the most exact form that the operators allow, with the reason."""

from __future__ import annotations

from dataclasses import dataclass

from graphfx.errors import NOWHERE, GraphError, Problem
from graphfx.graph.flat import FlatGraph, TimeSettings
from graphfx.motion.clock import most_cells
from graphfx.plan.movers import INNER_ROLES, Mover, base_of
from graphfx.plan.scheme import COUNTS, SIMPLE, Scheme

MOST_CELLS = 240
"""Cells of noise in a step: it is written once for each."""
LINEAR_ROLES = ("linear", "noise")


@dataclass(frozen=True)
class Choice:
    """How motion is computed: the method, why, its scheme of a step, and what is to be told if none tried was good enough."""

    method: str
    reason: str
    scheme: Scheme = SIMPLE
    doubt: str = ""


def _has_role(movers: list[Mover], *roles: str) -> bool:
    return any(mover.role in roles for mover in movers)


def _acting(movers: list[Mover]) -> list[Mover]:
    """Return the operators that act at all: one that never does changes nothing, not even the method."""
    return [mover for mover in movers if not mover.idle]


def cells_met(movers: list[Mover], time: TimeSettings, method: str) -> int:
    """Return how many cells of noise a step may meet; it is split where they meet. The paper's steps are whole.

    In those held noise is that of the middle, and Brownian noise the sum over all cells.
    """
    noise = [mover for mover in _acting(movers) if mover.role == "noise"]
    if not noise or (method == "sims" and not any(mover.is_brownian for mover in noise)):
        return 1
    cells = most_cells(time.fps, time.preroll, time.substeps)
    if cells > MOST_CELLS:
        node = noise[0].node
        message = (
            f"its noise is drawn anew every 1/24 s, {cells:,} times in a step of this graph, and {MOST_CELLS} are the most; "
            "take more frames a second, or more substeps"
        )
        raise GraphError(Problem(message, node.location, f"nodes.{node.path}"))
    return cells


def choose_method(movers: list[Mover], flat: FlatGraph, drifts: bool, chosen: Choice | None = None) -> Choice:
    """Return how the motion is computed, and why: the most exact form that the operators allow.

    `drifts` tells whether velocities carry particles beside the operators; `chosen` is what was tried and found best.
    """
    asked = flat.time.method
    if asked == "sims":
        return Choice("sims", "asked for: the paper's scheme, first order, operations in stack order")
    movers = _acting(movers)
    inner = [mover for mover in movers if mover.role in INNER_ROLES]
    if asked == "rk45":
        return _runge_kutta(inner, flat)
    parts = [mover.node.node_type.name for mover in movers if mover.role != "surface"]
    if not parts or (drifts and not _has_role(movers, *LINEAR_ROLES) and base_of(inner) is None):
        parts.insert(0, "free flight")
    names = ", ".join(parts)
    if not inner:
        return Choice("exact", f"all motion is linear ({names}): {_how_exact(movers)}")
    lone = len(inner) == 1 and not _has_role(movers, *LINEAR_ROLES)
    if lone and inner[0].whole is not None and inner[0].whole.time_free and asked in ("auto", "exact"):
        name = inner[0].node.node_type.name
        return Choice("exact", f"one acceleration with an exact flow ({name}): {_told(inner[0].whole)}")
    if lone and _is_alone(inner[0], drifts):
        what = "one flow, which carries by the velocity too" if inner[0].carries else "one flow and nothing else"
        return Choice("exact", f"{what} ({inner[0].node.node_type.name}): one exact step")
    if asked == "exact":
        message = f"there is no exact solution for {names} together; choose 'auto' or 'adaptive'"
        raise GraphError(Problem(message, flat.time.locations.get("method", NOWHERE), "time.method"))
    order_one = _of_order_one(movers)
    base = base_of(inner) if drifts else None
    around = f", around the exact orbit about {base.node.path}" if base is not None else ""
    why = f"{_why_composed(inner)} ({names}){around}"
    if asked == "adaptive":
        time = flat.time
        reason = f"{why}: order {time.order} by extrapolation, steps of each particle's own, {time.tolerance:g} m a second"
        return Choice("adaptive", reason + order_one, Scheme(COUNTS[time.order], time.tolerance))
    if asked == "auto" and chosen is not None:
        return Choice(chosen.method, f"{why}: {chosen.reason}{order_one}", chosen.scheme)
    return Choice("strang", f"{why}: composed symmetrically, second order{order_one}")


def _runge_kutta(inner: list[Mover], flat: FlatGraph) -> Choice:
    flows = [mover.node for mover in inner if mover.role == "flow"]
    if flows:
        message = f"rk45 needs rates of change, and {flows[0].node_type.name} is a flow; choose 'auto' or 'adaptive'"
        raise GraphError(Problem(message, flows[0].location, f"nodes.{flows[0].path}"))
    tolerance = flat.time.tolerance
    reason = f"asked for: Runge-Kutta pair of orders 5 and 4, steps of each particle's own, {tolerance:g} m a second"
    return Choice("rk45", reason, Scheme(tolerance=tolerance, runge_kutta=True))


def _how_exact(movers: list[Mover]) -> str:
    """Return how exact the steps of linear motion are, and what in them is not."""
    changing = [mover for mover in movers if mover.role == "linear" and not mover.constant]
    noise = [mover for mover in movers if mover.role == "noise"]
    held = " in each 1/24 s, for which noise holds" if any(not mover.is_brownian for mover in noise) else ""
    held += _of_order_one(movers)
    if changing:
        names = ", ".join(mover.node.node_type.name for mover in changing)
        return f"exact{held} but for {names}, taken at the middle of each step"
    matrices = [mover for mover in movers if mover.matrix]
    matrix = ", by the exponential of a matrix" if matrices else ""
    if any(mover.node.only is not None for mover in matrices):
        matrix += " for each class of particles"
    return f"one exact step{matrix}{held}"


def _of_order_one(movers: list[Mover]) -> str:
    """Return what is to be said of Brownian noise: how its motion comes nearer to that along its one path."""
    names = [mover.node.node_type.name for mover in movers if mover.is_brownian]
    return f", of Brownian noise ({', '.join(names)}) right in distribution and of order 1 in the step" if names else ""


def _is_alone(mover: Mover, drifts: bool) -> bool:
    """Return whether a flow is all of the motion, and the same at all times."""
    return mover.role == "flow" and mover.time_free and (mover.carries or not drifts)


def _told(mover: Mover) -> str:
    """Return what the first sentence of an exact flow's docstring says."""
    sentence = (mover.function.body.__doc__ or "").strip().partition(".")[0]
    return sentence[:1].lower() + sentence[1:]


def _why_composed(inner: list[Mover]) -> str:
    """Return what keeps a motion from being exact."""
    fields = [mover for mover in inner if mover.role != "flow"]
    return "fields that change along the way" if fields and len(fields) == len(inner) else "flows that do not commute"
