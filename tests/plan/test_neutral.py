"""Operators that say when they do nothing do nothing then."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.math import Vec3
from graphfx.node import Library
from graphfx.node.types import NodeType

LIBRARY = Library()
NEUTRAL = {
    "vortex": {"magnitude": 0.0, "lift": 0.0},
    "spiral": {"speed": 0.0},
    "damp": {"damping": 0.0},
    "gravity": {"acceleration": Vec3(0.0, 0.0, 0.0)},
    "translate": {"rate": Vec3(0.0, 0.0, 0.0)},
    "rotate": {"speed": 0.0},
    "scale": {"rate": 0.0},
    "attract": {"strength": 0.0},
    "attract_line": {"strength": 0.0},
    "wind": {"drag": 0.0},
    "spring": {"frequency": 0.0},
    "undamp": {"rate": 0.0},
    "drag": {"strength": 0.0},
    "random_acceleration": {"strength": 0.0},
    "random_translate": {"speed": 0.0},
    "curl_noise": {"speed": 0.0},
    "turbulence": {"strength": 0.0},
}
"""Parameters at which each operator's `neutral` holds."""


def random_argument(node_type: NodeType, name: str, generator: np.random.Generator) -> object:
    if node_type.argument_type(name) in ("float", "int"):
        return np.float64(generator.uniform(0.1, 2.0))
    if name == "draw":
        return tuple(generator.uniform(size=4))
    if node_type.argument_type(name) == "bool":
        return np.bool_(generator.integers(2))
    vector = generator.normal(size=3)
    return Vec3(*(vector / np.linalg.norm(vector) if node_type.argument_type(name) == "direction" else vector))


def test_every_neutral_operator_is_tried() -> None:
    """No operator with a `neutral` condition is forgotten here."""
    assert {name for name in LIBRARY if LIBRARY[name].neutral} == NEUTRAL.keys()


@pytest.mark.parametrize("name", NEUTRAL)
def test_a_neutral_operator_does_nothing(name: str) -> None:
    """Where `neutral` holds, a flow leaves the position where it is, or where the velocity takes it; a rate of change is 0."""
    node_type, generator = LIBRARY[name], np.random.default_rng(3)
    for _ in range(100):
        given = {argument: random_argument(node_type, argument, generator) for argument in node_type.arguments} | NEUTRAL[name]
        with np.errstate(all="ignore"):
            result = node_type.function(**given)
        if len(node_type.writes) == 2:
            position, velocity = (np.array(list(part)) for part in (given["position"], given["velocity"]))
            expected = np.stack([position + velocity * given["dt"], velocity])
            result = np.stack([list(part) for part in result])
        else:
            expected = np.array(list(given["position"])) if node_type.role == "flow" else np.zeros(3)
            result = np.array(list(result))
        np.testing.assert_allclose(result, expected, rtol=0, atol=1e-14)
