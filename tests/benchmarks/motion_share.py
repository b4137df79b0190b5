"""What a few particles near an attractor cost the many that are far from it."""

from __future__ import annotations

import time

import numpy as np
from motion_problems import LIBRARY

from graphfx.cook.trial import Trials
from graphfx.graph.document import document_of
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten

COUNT, FRAMES, BLOCK = 100_000, 12, 256
ROUNDS = 3
SHARES = (0.0, 0.01, 1.0)


def graph(share: float, count: int) -> FlatGraph:
    """Return particles of which a share, drawn one by one, circles close to an attractor; the others are far."""
    near = f"chance < {share!r}"
    sets = {
        "chance": {"rand": [0, 1]},
        "offset": {"in_sphere": {"radius": 1}},
        "position": {"expr": f"vec(0.1, 0, 0) + offset * 0.02 if {near} else vec(20, 0, 0) + offset"},
        "velocity": {"expr": f"vec(0, 0, 10) if {near} else vec(0, 0, 1)"},
    }
    attributes = {
        "chance": {"type": "float", "default": 0, "doc": "Which kind."},
        "offset": {"type": "vec3", "default": [0, 0, 0], "doc": "From the middle of its kind."},
    }
    document = {
        "graphfx": 1,
        "attributes": attributes,
        "time": {"fps": 24, "frames": [0, FRAMES], "precision": 64, "method": "adaptive", "tolerance": 1e-6},
        "nodes": {
            "some": {"type": "emit", "rate": 0, "count": count, "set": sets},
            "act": {"type": "attract", "from": "some", "strength": 10, "softening": 0.01},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view", "shutter": 0},
        },
    }
    return flatten(document_of(document), LIBRARY)


def share_rows() -> list[str]:
    """Return what the shares cost, in rounds, and what blocks would that wait for their slowest particle."""
    trials = [Trials(graph(share, COUNT)) for share in SHARES]
    times, turns = np.full((ROUNDS, len(SHARES)), np.nan), [0.0] * len(SHARES)
    for row in times:
        for number, each in enumerate(trials):
            begun = time.process_time()
            trial = each.run([FRAMES])
            row[number] = min(trial.seconds, time.process_time() - begun)
            turns[number] = trial.evaluations / 6
    far, mixed, near = times.min(axis=0) / COUNT / FRAMES * 1e9
    waits = 1 - (1 - SHARES[1]) ** BLOCK
    locked = far + waits * (near - far)
    return [
        f"{COUNT:,} particles, order 6 at 1e-6 m, ns by particle and frame: all far {far:.0f} ({turns[0]:.1f} steps), "
        f"1 % near {mixed:.0f} ({turns[1]:.1f} steps), all near {near:.0f} ({turns[2]:.1f} steps).",
        f"The 1 % cost {mixed - far:.0f} ns more, of which {0.01 * (near - far):.0f} would be their share of all near; "
        f"all near take {near / mixed:.1f} times as long as the mixture.",
        f"{100 * waits:.0f} % of blocks of {BLOCK} have one of the 1 %: if whole blocks waited, the mixture would take at least "
        f"{locked:.0f} ns, {locked / mixed:.1f} times as long.",
    ]
