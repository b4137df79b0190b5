"""Time what events cost: `python tests/benchmarks/events.py`.

A million particles fall for a number of frames, the cases in turn and in changing order, so that a busy moment of the
machine falls on each alike; medians count. Each case befalls a known share of them in every frame, so its
extra time over the same motion without the event gives the nanoseconds for each particle that it touches. What it
costs the others is the time of the case in which it befalls nobody.

    --count N    particles (1 000 000)
    --rounds N   times that each case is run (5)
"""

from __future__ import annotations

import argparse
import statistics
import time
from typing import Any

from graphfx.cook.effect import Effect
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.lanes.host import use_wide_registers
from graphfx.node import Library, library_roots

FRAMES = 6
HIGH = {"in_box": {"min": [-1, 50, -1], "max": [1, 100, 1]}}
FALL: dict[str, Any] = {"position": HIGH, "velocity": {"in_sphere": {"radius": 1}}}
MOVE = [{"type": "gravity"}, {"type": "damp", "damping": 0.1}]
SHARES = (0.001, 0.01, 0.1)


def ages(share: float) -> dict[str, Any]:
    """Return lives of which a share ends in each frame: even over 1 / share frames."""
    return {"rand": [0, 1 / (24 * share)]} if share else {"rand": [1000, 2000]}


def floor(share: float) -> dict[str, Any]:
    """Return a plane that a share of the particles meets in each frame: bouncing spheres of particles from a box above it."""
    return {"in_box": {"min": [-1, 0, -1], "max": [1, 0.0417 / share if share else 1e6, 1]}}


def cases() -> dict[str, tuple[dict[str, Any], list[dict[str, Any]], dict[str, Any], float]]:
    """Return (emitter, operators, other nodes, share) by name."""
    made: dict[str, Any] = {"motion alone": ({"set": FALL}, MOVE, {}, 0.0)}
    for share in (0.0, *SHARES):
        name = f"{share:.1%}" if share else "nobody"
        emitter = {"life": ages(share), "set": FALL}
        made[f"die of age, {name}"] = (emitter, MOVE, {}, share)
        made[f"recycle at death, {name}"] = (emitter, [*MOVE, {"type": "recycle"}], {}, share)
        spawn = {"children": {"type": "spawn", "from": "fall", "when": "death", "life": 1}}
        made[f"spawn at death, {name}"] = (emitter, MOVE, spawn, share)
        if share < 0.1:
            falling = {"set": {"position": floor(share), "velocity": [0, -1, 0]}}
            made[f"bounce, {name}"] = (falling, [{"type": "bounce_plane", "resilience": 1}], {}, share)
            counted = [{"type": "bounce_plane", "resilience": 1}, {"type": "set", "when": "hit", "set": {"color": [1, 0, 0]}}]
            made[f"bounce and set, {name}"] = (falling, counted, {}, share)
    paint = {"set": {"color": {"expr": "velocity"}}}
    others: dict[str, tuple[dict[str, Any], float]] = {
        "kill on a condition, nobody": ({"type": "kill", "only": {"expr": "position.y < -1000"}}, 0.0),
        "set each step": ({"type": "set", "when": "step", **paint}, 1.0),
        "set each frame": ({"type": "set", **paint}, 1.0),
        "fade": ({"type": "fade", "set": {"color": [1, 0, 0]}}, 1.0),
    }
    made |= {name: ({"set": FALL}, [*MOVE, operator], {}, share) for name, (operator, share) in others.items()}
    return made


def effect(case: Any, count: int) -> Effect:
    """Return the effect of a case."""
    emitter, operators, others, _ = case
    document = {
        "graphfx": 1,
        "time": {"fps": 24, "frames": [1, FRAMES + 2]},
        "nodes": {
            "sky": {"type": "emit", "count": count, **emitter},
            "fall": {"type": "stack", "from": "sky", "ops": operators},
            **others,
            "view": {"type": "camera"},
            "out": {"type": "image", "from": ["fall", *others], "camera": "view", "shutter": 0},
        },
    }
    return Effect(flatten(document_of(document), Library(library_roots())))


def timed(made: Effect) -> float:
    """Return the median seconds of a frame, on one thread, in CPU time."""
    simulation = made.simulation(1)
    seconds = []
    began = time.process_time()
    for frame in simulation.frames(FRAMES + 2):
        now = time.process_time()
        if frame > 2:
            seconds.append(now - began)
        began = now
    return statistics.median(seconds)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args()
    use_wide_registers()
    made = {name: effect(case, options.count) for name, case in cases().items()}
    shares = {name: case[3] for name, case in cases().items()}
    found: dict[str, list[float]] = {name: [] for name in made}
    for name in made:
        timed(made[name])
    for turn in range(options.rounds):
        names = list(made)[turn % len(made) :] + list(made)[: turn % len(made)]
        for name in names:
            found[name].append(timed(made[name]))
    middle = {name: statistics.median(times) / options.count * 1e9 for name, times in found.items()}
    print(f"{'case':34} ns a particle and frame   more for each touched")
    for name, nanoseconds in middle.items():
        kind = name.partition(", ")[0]
        base = middle.get(f"{kind}, nobody", middle["motion alone"])
        more = f"{(nanoseconds - base) / shares[name]:8.0f} ns" if shares[name] else ""
        print(f"{name:34} {nanoseconds:8.1f}                  {more}")


if __name__ == "__main__":
    main()
