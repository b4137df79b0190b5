"""Choose how motion is computed: the most exact form that the operators allow, with the reason."""

from __future__ import annotations

from graphfx.errors import GraphError, Problem
from graphfx.graph.flat import FlatGraph, TimeSettings
from graphfx.motion.clock import most_cells
from graphfx.plan.motion import Mover


def _has_role(movers: list[Mover], role: str) -> bool:
    return any(mover.role == role for mover in movers)


def cells_met(movers: list[Mover], time: TimeSettings, method: str) -> int:
    """Return how many cells of held noise a step may meet; it is split where they meet. The paper's steps are whole."""
    if not _has_role(movers, "noise") or method == "sims":
        return 1
    return most_cells(time.fps, time.preroll, time.substeps)


def choose_method(movers: list[Mover], flat: FlatGraph, drifts: bool) -> tuple[str, str]:
    """Return how the motion is computed, and why: the most exact form that the operators allow.

    `drifts` tells whether velocities carry particles beside the operators.
    """
    asked = flat.time.method
    if asked == "sims":
        return "sims", "asked for: the paper's scheme, first order, operations in stack order"
    inner = [mover for mover in movers if mover.role in ("flow", "acceleration")]
    parts = [mover.node.node_type.name for mover in movers if mover.role != "surface"]
    if not parts or (drifts and not _has_role(movers, "linear")):
        parts.insert(0, "free flight")
    names = ", ".join(parts)
    if not inner:
        changing = [mover.node.node_type.name for mover in movers if mover.role == "linear" and not mover.constant]
        if changing:
            held = ", ".join(changing)
            return "exact", f"all motion is linear ({names}): exact but for {held}, taken at the middle of each step"
        return "exact", f"all motion is linear ({names}): one exact step"
    if len(inner) == 1 and inner[0].role == "flow" and inner[0].time_free and not drifts and not _has_role(movers, "linear"):
        return "exact", f"one flow and nothing else ({names}): one exact step"
    if asked == "exact":
        raise GraphError(
            Problem(f"there is no exact solution for {names} together; choose 'auto' or 'strang'", path="time.method")
        )
    return "strang", f"flows that do not commute ({names}): composed symmetrically, second order"
