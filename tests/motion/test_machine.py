"""The block machine gives the bits of plain Python for every moving operator, alone and together."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten

from .one_particle import LIBRARY

RAND = {"rand": [0.5, 2.5]}
MOVING = {
    "position": {"in_box": {"min": [-1, 0.5, -1], "max": [1, 2, 1]}},
    "velocity": {"in_box": {}},
    "mass": RAND,
    "spiral_axis": {"in_box": {"min": [0.1, 1, -1]}},
    "rest_position": {"in_box": {}},
}
SPRING = {"type": "spring", "frequency": RAND, "damping_ratio": 0.3}
CASES: dict[str, list[Any]] = {
    "rotate and scale": [{"type": "rotate", "speed": RAND}, {"type": "scale", "rate": {"rand": [-1, 1]}}],
    "attraction": [
        {"type": "attract", "strength": RAND, "as_force": True},
        {"type": "attract_line", "axis": {"in_cone": {"angle": 20}}, "falloff": RAND},
        {"type": "gravity"},
    ],
    "orbit": [{"type": "attract", "strength": RAND, "softening": 0, "as_force": True, "center": [0, 1, 0]}],
    "wind": [{"type": "wind", "wind": {"keys": [[0, [1, 0, 0]], [1, [0, 0, 2]]]}, "drag": RAND}, {"type": "gravity"}],
    "spring": [SPRING],
    "springs and all that is linear": [
        SPRING,
        {"type": "spring", "id": "weak", "frequency": 0.5, "during": [0.1, 9], "only": {"expr": "mass > 1"}},
        {"type": "gravity"},
        {"type": "spiral", "speed": RAND},
        {"type": "translate", "rate": [1, 0, 0]},
        {"type": "rotate"},
    ],
    "damping to a threshold": [{"type": "damp", "threshold": RAND}],
    "flows that carry": [
        {"type": "undamp", "rate": RAND, "threshold": 3},
        {"type": "drag", "strength": RAND, "during": [0.1, 0.4]},
        {"type": "damp", "damping": RAND, "threshold": {"expr": "0.1 * mass"}},
        {"type": "gravity"},
    ],
    "drag on a plane": [{"type": "drag"}, {"type": "bounce_plane", "normal": [0, 1, 1], "resilience": 0.6}],
    "noise": [{"type": "random_acceleration", "strength": RAND}, {"type": "random_translate", "along": [1, 0, 1]}],
    "Brownian noise": [
        {"type": "random_acceleration", "strength": RAND, "process": "brownian"},
        {"type": "random_translate", "process": "brownian", "only": {"expr": "position.y > 1"}},
        {"type": "random_translate", "id": "held"},
    ],
    "Brownian noise among others": [
        {"type": "random_acceleration", "process": "brownian", "during": [0.1, 0.4]},
        {"type": "vortex", "magnitude": {"expr": "position.x"}},
        {"type": "gravity"},
        {"type": "recycle"},
        {"type": "bounce_plane", "resilience": 0.6},
    ],
    "noise among others": [
        {"type": "random_acceleration", "strength": RAND, "during": [0.1, 0.4], "only": {"expr": "position.y > 1"}},
        {"type": "random_translate", "speed": {"keys": [[0, 0], [1, 2]]}},
        {"type": "vortex", "magnitude": {"expr": "position.x"}},
        {"type": "gravity"},
        {"type": "damp"},
        {"type": "bounce_plane", "resilience": 0.6},
    ],
    "curl noise": [
        {"type": "curl_noise", "speed": RAND, "size": 0.3},
        {"type": "curl_noise", "id": "fine", "seed": 5000, "rate": {"expr": "mass"}, "only": {"expr": "mass > 1"}},
        {"type": "turbulence", "strength": 3},
        {"type": "damp"},
    ],
    "curl noise alone": [{"type": "curl_noise", "rate": 0}],
    "spring on a plane": [SPRING, {"type": "gravity"}, {"type": "bounce_plane", "resilience": 0.6}],
}
TIMES = {
    "32 bits": {},
    "64 bits, 3 steps": {"precision": 64, "substeps": 3},
    "preroll": {"preroll": 0.13, "fps": 25, "substeps": 2},
    "split steps": {"fps": 20, "frames": [1, 13]},
    "sims": {"method": "sims", "precision": 64},
}


def effect_of(ops: list[Any], time: dict[str, Any], **emit: Any) -> Effect:
    """Return the effect of an emitter under operators, of 30 particles a second unless told."""
    document = {
        "graphfx": 1,
        "seed": 3,
        "time": {"fps": 24, "frames": [1, 13], **time},
        "nodes": {
            "sky": {"type": "emit", "rate": 30, "set": MOVING, **emit},
            "act": {"type": "stack", "from": "sky", "ops": ops},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view"},
        },
    }
    return Effect(flatten(document_of(document), LIBRARY))


def bits(columns: dict[str, np.ndarray]) -> dict[str, bytes]:
    """Return columns as bytes, every NaN alike."""
    return {
        name: np.where(array == array, array, np.nan).tobytes() if array.dtype.kind == "f" else array.tobytes()
        for name, array in columns.items()
    }


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("case", CASES)
def test_machine_is_plain_python(case, time):
    """Every stored column has the same bits by both ways, and all are finite."""
    rate = 10 if "noise" in case else 30  # plain Python takes long for noise
    found = effect_of(CASES[case], TIMES[time], life=0.6, rate=rate)
    last = found.flat.time.last
    machine, plain = found.simulate(last, threads=2)["sky"], found.simulate(last, reference=True)["sky"]
    assert bits(machine) == bits(plain), [name for name in plain if bits(machine)[name] != bits(plain)[name]]
    assert len(machine["position"]) >= rate / 3 and np.isfinite(machine["position"]).all()
