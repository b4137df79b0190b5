"""The problems of `motion.py`: a graph for graphfx, and the same rates of change, compiled, for the others.

States are rows of position [m] and velocity [m/s], (n, 6) float64. A rate takes a state's six numbers and returns theirs.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numba import njit

from graphfx.graph.document import document_of
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots

LIBRARY = Library(library_roots())
FPS = 24
ORBIT = 4 * math.pi**2
"""g m of orbits that take a second at a semi-major axis of 1 m [m^3/s^2]."""
RESILIENCE = 0.8
Rate = Callable[..., tuple[float, ...]]


@dataclass(frozen=True)
class Problem:
    """Particles that are born together at time 0, operators, and a time to simulate; `truth` gives states in closed form.

    A `ball` bounces on the plane y = 0; those of `orbits` are test particles of REBOUND, about a mass with g m = ORBIT.
    """

    name: str
    ops: list[dict[str, Any]]
    sets: dict[str, Any]
    seconds: float
    rate: Rate
    truth: Callable[[np.ndarray, float], np.ndarray] | None = None
    attributes: dict[str, Any] = field(default_factory=dict)
    ball: bool = False
    orbits: bool = False

    def graph(self, particles: int, steps: int = 1, **time: Any) -> FlatGraph:
        """Return the graph, with `steps` frames for each of those at 24 fps."""
        fps = FPS * steps
        document = {
            "graphfx": 1,
            "attributes": self.attributes,
            "time": {"fps": fps, "frames": [0, round(self.seconds * fps)], "precision": 64, **time},
            "nodes": {
                "some": {"type": "emit", "rate": 0, "count": particles, "set": self.sets},
                "act": {"type": "stack", "from": "some", "ops": self.ops},
                "view": {"type": "camera"},
                "frames": {"type": "image", "from": "act", "camera": "view", "shutter": 0},
            },
        }
        return flatten(document_of(document), LIBRARY)


@njit
def pull(x: float, y: float, z: float, strength: float, softening: float) -> tuple[float, float, float]:
    """Return the acceleration towards a point that lies at (-x, -y, -z) from the particle."""
    distance2 = x * x + y * y + z * z + softening * softening
    a = -strength / (distance2 * math.sqrt(distance2))
    return a * x, a * y, a * z


@njit
def orbit_rate(x, y, z, u, v, w):
    a, b, c = pull(x, y, z, ORBIT, 0.0)
    return u, v, w, a, b, c


@njit
def two_rate(x, y, z, u, v, w):
    a, b, c = pull(x, y, z, 10.0, 0.3)
    d, e, f = pull(x - 1.0, y - 1.0, z, 5.0, 0.3)
    return u, v, w, a + d, b + e - 9.81, c + f


@njit
def stiff_rate(x, y, z, u, v, w):
    a, b, c = pull(x - 1.0, y - 1.0, z, 10.0, 0.3)
    k = 200.0 * 200.0
    return u, v, w, a - k * x, b - k * y, c - k * z


@njit
def spiral_rate(x, y, z, u, v, w):
    a, b, c = pull(x, y, z, 10.0, 0.3)
    p, q, s = 0.0, 0.6 * 61.0, 0.8 * 61.0
    return u, v, w, a - u + q * w - s * v, b - v + s * u - p * w, c - w + p * v - q * u


@njit
def fall_rate(x, y, z, u, v, w):
    return u, v, w, -2.0 * u, -9.81 - 2.0 * v, -2.0 * w


@njit
def ball_rate(x, y, z, u, v, w):
    return u, v, w, 0.0, -9.81, 0.0


@njit
def vortex_rate(x, y, z, u, v, w):
    a = 3.0 * (x * x + z * z) ** -0.75
    ox = x - 1.0
    height = 0.6 * y + 0.8 * z
    ry, rz = y - 0.6 * height, z - 0.8 * height
    b = 3.0 * (ox * ox + ry * ry + rz * rz) ** -0.75
    return a * z + b * (0.6 * rz - 0.8 * ry), b * 0.8 * ox, -a * x - b * 0.6 * ox, 0.0, 0.0, 0.0


def orbit_after(start: np.ndarray, seconds: float) -> np.ndarray:
    """Return states on orbits with a semi-major axis of 1 m, by Kepler's equation E - e sin E = M."""
    position, velocity = start[:, :3], start[:, 3:]
    radius = np.linalg.norm(position, axis=1)
    momentum = np.cross(position, velocity)
    nearest = np.cross(velocity, momentum) / ORBIT - position / radius[:, None]
    e = np.linalg.norm(nearest, axis=1)
    along = nearest / e[:, None]
    across = np.cross(momentum / np.linalg.norm(momentum, axis=1)[:, None], along)
    side = np.sqrt(1 - e * e)
    anomaly = np.arctan2(np.sum(position * across, axis=1) / side, np.sum(position * along, axis=1) + e)
    mean = anomaly - e * np.sin(anomaly) + 2 * math.pi * (seconds % 1.0)
    low, high = mean - 1, mean + 1
    for _ in range(60):
        middle = (low + high) / 2
        below = middle - e * np.sin(middle) < mean
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    anomaly = (low + high) / 2
    sine, cosine = np.sin(anomaly), np.cos(anomaly)
    speed = (2 * math.pi / (1 - e * cosine))[:, None]
    place = (cosine - e)[:, None] * along + (side * sine)[:, None] * across
    return np.hstack([place, speed * (-sine[:, None] * along + (side * cosine)[:, None] * across)])


def fall_after(start: np.ndarray, seconds: float) -> np.ndarray:
    """Return states under gravity and a damping of 2 a second: V = g/d + (V0 - g/d) exp(-d t)."""
    final = np.array([0.0, -9.81 / 2, 0.0])
    away = start[:, 3:] - final
    left = math.exp(-2 * seconds)
    return np.hstack([start[:, :3] + final * seconds + away * (1 - left) / 2, final + away * left])


def ball_after(start: np.ndarray, seconds: float) -> np.ndarray:
    """Return states of balls, flight by flight."""
    found = start.copy()
    found[:, [0, 2]] += start[:, [3, 5]] * seconds
    for row in found:
        height, speed, left = row[1], row[4], seconds
        while (flight := (speed + math.sqrt(speed * speed + 2 * 9.81 * height)) / 9.81) < left:
            left, height, speed = left - flight, 0.0, (9.81 * flight - speed) * RESILIENCE
        row[1], row[4] = height + speed * left - 9.81 / 2 * left * left, speed - 9.81 * left
    return found


def elliptic(most: float) -> dict[str, Any]:
    """Return what sets particles on ellipses of eccentricities up to `most`, anywhere on them."""
    side = "sqrt(1 - eccentricity * eccentricity)"
    speed = f"{2 * math.pi!r} / (1 - eccentricity * cos(anomaly))"
    return {
        "eccentricity": {"rand": [0, most]},
        "anomaly": {"rand": [0, 2 * math.pi]},
        "position": {"expr": f"vec(cos(anomaly) - eccentricity, {side} * sin(anomaly), 0)"},
        "velocity": {"expr": f"vec(0 - sin(anomaly), {side} * cos(anomaly), 0) * ({speed})"},
    }


ELEMENTS = {name: {"type": "float", "default": 0, "doc": "Of an orbit."} for name in ("eccentricity", "anomaly")}
STILL = {"in_sphere": {"center": [3, 0, 0], "radius": 1}}
MOVING = {"position": STILL, "velocity": {"in_sphere": {"radius": 1}}}
GRAVITY = {"type": "gravity"}
NEAR = {"type": "attract", "strength": 10, "softening": 0.3}
OTHER = {"type": "attract", "id": "other", "center": [1, 1, 0], "softening": 0.3}
ORBITS: dict[str, Any] = {
    "seconds": 10.25, "rate": orbit_rate, "truth": orbit_after, "attributes": ELEMENTS, "orbits": True,
}  # fmt: skip
TILTED = {"type": "vortex", "id": "tilted", "magnitude": 3, "center": [1, 0, 0], "axis": [0, 0.6, 0.8]}
POINT = [{"type": "attract", "strength": ORBIT, "softening": 0}]

PROBLEMS = [
    Problem("Kepler, e in [0, 0.99], 10 1/4 periods", POINT, elliptic(0.99), **ORBITS),
    Problem("test particles about a star, e in [0, 0.3], 10 1/4 periods", POINT, elliptic(0.3), **ORBITS),
    Problem("two softened attractors, gravity", [GRAVITY, NEAR, {**OTHER, "strength": 5}], MOVING, 2, two_rate),
    Problem(
        "stiff spring 200 rad/s, attractor",
        [{"type": "spring", "frequency": 200, "damping_ratio": 0}, {**OTHER, "strength": 10}],
        {"position": {"in_sphere": {"radius": 1}}, "velocity": {"in_sphere": {"radius": 1}}, "rest_position": [0, 0, 0]},
        2, stiff_rate,
    ),
    Problem(
        "spiral 61 rad/s, damping, attractor",
        [{"type": "spiral", "speed": 61}, {"type": "damp", "damping": 1}, NEAR],
        {"position": {"in_sphere": {"radius": 1}}, "velocity": {"in_sphere": {"radius": 5}}, "spiral_axis": [0, 0.6, 0.8]},
        2, spiral_rate,
    ),
    Problem("damped fall", [GRAVITY, {"type": "damp", "damping": 2}], MOVING, 4, fall_rate, fall_after),
    Problem(
        "two vortices",
        [{"type": "vortex", "magnitude": 3}, TILTED],
        {"position": STILL, "velocity": [0, 0, 0]}, 4, vortex_rate,
    ),
    Problem(
        "ball on a plane",
        [GRAVITY, {"type": "bounce_plane", "resilience": RESILIENCE, "friction": 0}],
        {"position": {"in_box": {"min": [0, 1, 0], "max": [0, 2, 0]}}, "velocity": [1, 0, 0]},
        3, ball_rate, ball_after, ball=True,
    ),
]  # fmt: skip
