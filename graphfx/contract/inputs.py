"""Particles and parameters for one node type: ordinary ones, and the extremes of all that it declares."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from graphfx.node import INFINITY, NodeType, Parameter

HUGE, TINY = 1e6, 1e-6
"""What an unbounded number is given at the extremes, in its own unit."""
ORDINARY, COMBINED = 120, 120
"""Rows with ordinary values, and rows in which every argument is at one of its extremes."""

_STATES: dict[str, tuple[float, float]] = {
    "age": (0, 20), "normalized_age": (0, 1), "life": (0.1, 20), "radius": (0, 0.1), "opacity": (0, 1), "mass": (0.01, 100),
    "color": (0, 2), "fade_color": (0, 2), "type": (0, 4), "hits": (0, 9), "lives": (0, 9), "generation": (0, 9),
    "dt": (0, 0.05), "time": (-10, 100), "frame": (1, 240),
}
"""Ordinary values of what an engine hands over, where they are not about zero."""
_EXTREMES: dict[str, tuple[float, ...]] = {
    "dt": (0, TINY, 1), "time": (0, -HUGE, HUGE), "frame": (0, 1, 100000), "age": (0, TINY, HUGE), "life": (TINY, HUGE, INFINITY),
    "normalized_age": (0, 1), "opacity": (0, 1), "mass": (1e-3, HUGE), "radius": (0, TINY, HUGE),
}
_WHOLE = ("type", "hits", "lives", "generation", "frame")
_AXES = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0)]
Row = dict[str, Any]


class Inputs:
    """Makes values for the arguments of a node's function; the same ones each time."""

    def __init__(self, node_type: NodeType, seed: int = 0):
        self.node_type = node_type
        self.draw = np.random.default_rng(seed)
        self.names = [name for name in node_type.arguments if node_type.argument_type(name) not in ("draw", "mesh", "id")]

    def rows(self) -> list[Row]:
        """Return defaults with each argument at each of its extremes in turn, ordinary rows, and extremes combined."""
        base = self.ordinary()
        alone = [{**base, name: extreme} for name in self.names for extreme in self.extremes(name)]
        combined = [{name: self._one(self.extremes(name)) for name in self.names} for _ in range(COMBINED)]
        return [*alone, *self.ordinary_rows(), *combined]

    def ordinary_rows(self, count: int = ORDINARY) -> list[Row]:
        """Return rows of ordinary values."""
        return [self.ordinary() for _ in range(count)]

    def ordinary(self) -> Row:
        """Return one row of ordinary values, within what is declared."""
        return {name: self._ordinary(name) for name in self.names}

    def _ordinary(self, name: str) -> Any:
        kind = self.node_type.argument_type(name)
        if kind == "bool":
            return bool(self.draw.integers(2))
        parameter = self.node_type.parameters.get(name)
        low, high = _bounds(parameter) if parameter else _STATES.get(name, (-3.0, 3.0))
        if kind == "direction":
            return tuple(unit(self.draw.normal(size=3)))
        if kind in ("vec3", "point", "color"):
            return tuple(self.draw.uniform(low, high, 3).tolist())
        number = float(self.draw.uniform(low, high))
        return float(np.clip(round(number), np.ceil(low), np.floor(high))) if kind == "int" or name in _WHOLE else number

    def extremes(self, name: str) -> list[Any]:
        """Return the extreme values of an argument."""
        kind = self.node_type.argument_type(name)
        parameter = self.node_type.parameters.get(name)
        if kind == "bool":
            return [False, True]
        if kind == "direction":
            return list(_AXES)
        numbers = list(_EXTREMES.get(name, ())) if parameter is None else []
        numbers = numbers or _extreme_numbers(parameter)
        if kind not in ("vec3", "point", "color"):
            return [float(round(number)) if kind == "int" and np.isfinite(number) else number for number in numbers]
        along = [tuple(number * part for part in axis) for number in numbers if number > 0 for axis in _AXES]
        allowed = [vector for vector in along if parameter is None or all(_allowed(part, parameter) for part in vector)]
        return [(0.0, 0.0, 0.0), *allowed, *((number,) * 3 for number in numbers)]

    def _one(self, values: list[Any]) -> Any:
        return values[int(self.draw.integers(len(values)))]


def unit(vector: Any) -> np.ndarray:
    """Return a vector at unit length."""
    array = np.asarray(vector, float)
    scaled: np.ndarray = array / np.linalg.norm(array)
    return scaled


def _bounds(parameter: Parameter) -> tuple[float, float]:
    """Return the ordinary part of what a parameter may be: its range, within some units of its default."""
    default = np.asarray(parameter.default if parameter.default is not None else 1.0, float).ravel()
    finite = float(np.abs(default[np.isfinite(default)]).max(initial=1.0))
    reach = max(3.0, 2 * finite)
    low = -reach if parameter.min is None else max(parameter.min, -reach)
    high = reach if parameter.max is None else min(parameter.max, max(reach, low))
    return low, high


def _allowed(number: float, parameter: Parameter) -> bool:
    low, high = parameter.min, parameter.max
    return (low is None or number >= low) and (high is None or number <= high)


def _extreme_numbers(parameter: Parameter | None) -> list[float]:
    candidates = [0.0, TINY, -TINY, HUGE, -HUGE, 1.0]
    if parameter is None:
        return candidates
    bounds = [float(bound) for bound in (parameter.min, parameter.max) if bound is not None]
    default = parameter.default if isinstance(parameter.default, float | int) else 1.0
    return list(dict.fromkeys([*bounds, float(default), *(number for number in candidates if _allowed(number, parameter))]))


def shown(row: Row) -> str:
    """Return a row for a message."""
    return ", ".join(f"{name}={value}" for name, value in row.items())


def pairs(rows: list[Row]) -> Iterator[tuple[Row, Row]]:
    """Yield neighbouring rows, two by two."""
    return zip(rows[::2], rows[1::2], strict=False)
