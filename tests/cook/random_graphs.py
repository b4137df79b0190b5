"""Random graphs: any operators, any kind of value in any place, drawn from a seed."""

from __future__ import annotations

import random
from typing import Any

NUMBERS = ("age", "normalized_age", "time", "frame", "position.x", "length(velocity)", "mass", "radius", "1", "2.5", "0.1", "pi")
FUNCTIONS = {1: ("sin", "cos", "exp", "sqrt", "abs", "floor"), 2: ("min", "max", "step"), 3: ("clamp", "mix", "smoothstep")}


class GraphMaker:
    """Draws the parts of graphs."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)

    def number(self, low: float, high: float) -> float:
        return round(self.random.uniform(low, high), 3)

    def expression(self, depth: int = 0) -> str:
        if depth > 2 or self.random.random() < 0.3:
            return self.random.choice(NUMBERS)
        a, b, c = (self.expression(depth + 1) for _ in range(3))
        kind = self.random.randrange(4)
        if kind == 0:
            return f"({a} {self.random.choice('+-*/%')} {b})"
        if kind == 1:
            return f"({a} if {b} < {c} else {c})"
        count = self.random.choice((1, 2, 3))
        return f"{self.random.choice(FUNCTIONS[count])}({', '.join((a, b, c)[:count])})"

    def points(self, low: float, high: float, span: float) -> list[list[float]]:
        places = sorted({self.number(0, span) for _ in range(self.random.randint(1, 4))})
        return [[place, self.number(low, high)] for place in places]

    def scalar(self, low: float, high: float) -> Any:
        choose = self.random.choice
        kind = self.random.randrange(6)
        if kind == 0:
            return self.number(low, high)
        if kind == 1:
            return {"rand": [self.number(low, high), self.number(low, high)], "per": choose(("life", "graph", "frame"))}
        if kind == 2:
            return {"expr": self.expression()}
        if kind == 3:
            return {
                "keys": self.points(low, high, 0.3),
                "interpolation": choose(("linear", "step", "smooth")),
                "repeat": choose(("hold", "loop", "mirror")),
            }
        if kind == 4:
            return {"ramp": self.points(low, high, 1), "over": {"expr": choose(("age", "normalized_age"))}}
        return {"gauss": {"mean": self.number(low, high), "deviation": 0.1}}

    def triple(self, size: float) -> list[float]:
        return [self.number(-size, size) for _ in range(3)]

    def vector(self, size: float = 2) -> Any:
        makers = (
            lambda: self.triple(size),
            lambda: {"in_box": {"min": self.triple(size), "max": self.triple(size)}},
            lambda: {"in_sphere": {"radius": self.number(0, size)}},
            lambda: {"on_sphere": {"radius": self.number(0, size)}},
            lambda: {"in_disc": {"axis": [*self.triple(size)[:2], 1]}},
            lambda: {"in_cone": {"angle": self.number(0, 180), "length": self.scalar(0, 2)}},
            lambda: {"expr": f"vec({self.expression()}, {self.expression()}, {self.expression()})"},
            lambda: [self.scalar(-size, size), self.number(-size, size), self.scalar(-size, size)],
        )
        return self.random.choice(makers)()

    def operator(self, place: int) -> dict[str, Any]:
        bounce = {"resilience": self.random.choice((0, 0.5, 1)), "friction": self.random.choice((0, 0.5, 1))}
        makers = {
            "spiral": lambda: {"speed": self.scalar(-5, 5)},
            "gravity": lambda: {"acceleration": self.vector(9)},
            "damp": lambda: {"damping": self.scalar(-2, 9), "threshold": self.random.choice((0, 0.5))},
            "vortex": lambda: {
                "magnitude": self.scalar(-5, 5),
                "center": self.vector(),
                "axis": self.vector(),
                "lift": self.scalar(-1, 1),
            },
            "translate": lambda: {"rate": self.vector()},
            "rotate": lambda: {"speed": self.scalar(-5, 5), "axis": self.vector()},
            "scale": lambda: {"rate": self.scalar(-3, 3), "center": self.vector()},
            "spring": lambda: {"frequency": self.scalar(0, 30), "damping_ratio": self.scalar(0, 2)},
            "wind": lambda: {"drag": self.scalar(0, 9), "wind": self.vector()},
            "undamp": lambda: {"rate": self.scalar(0, 9), "threshold": self.scalar(0, 3)},
            "drag": lambda: {"strength": self.scalar(0, 9), "wind": self.vector()},
            "attract": lambda: {"strength": self.scalar(-9, 9), "center": self.vector(), "as_force": bool(place % 2)},
            "attract_line": lambda: {"strength": self.scalar(-9, 9), "axis": self.vector()},
            "curl_noise": lambda: {"speed": self.scalar(-2, 2), "size": self.scalar(0.1, 2)},
            "turbulence": lambda: {"strength": self.scalar(-2, 2), "rate": self.scalar(0, 2)},
            "random_acceleration": lambda: {
                "strength": self.scalar(-2, 2),
                "along": self.vector(),
                "process": self.random.choice(("hold", "brownian")),
            },
            "random_translate": lambda: {
                "speed": self.scalar(-2, 2),
                "process": self.random.choice(("hold", "brownian")),
            },
            "bounce_plane": lambda: {"normal": self.vector(), **bounce},
            "bounce_sphere": lambda: {"center": self.vector(), "sphere_radius": self.number(0.1, 1), **bounce},
        }
        kind = self.random.choice(list(makers))
        made = {"type": kind, "id": f"{kind}_{place}", **makers[kind]()}
        if self.random.random() < 0.25:
            made["only"] = {"expr": f"{self.expression()} < {self.expression()}"}
        if self.random.random() < 0.25:
            made["during"] = sorted((self.number(-0.2, 0.4), self.number(0, 0.4)))
        return made

    def graph(self) -> dict[str, Any]:
        """Return a graph of five frames."""
        choose = self.random.choice
        attributes: dict[str, Any] = {
            name: self.vector() for name in ("position", "velocity", "spiral_axis") if choose((0, 1, 1))
        }
        attributes |= {name: self.number(0.01, 1) for name in ("radius", "mass") if choose((0, 1))}
        emitter = {"type": "emit", "rate": choose((40, 100, {"keys": [[0, 10], [0.2, 80]]})), "set": attributes}
        if choose((0, 1)):
            emitter["life"] = self.scalar(0.05, 0.5)
        return {
            "graphfx": 1,
            "seed": self.random.randrange(100),
            "time": {
                "fps": choose((24, 30, 23.976)),
                "frames": [1, 5],
                "substeps": choose((1, 1, 2)),
                "preroll": choose((0, 0.1)),
                "method": choose(("strang", "strang", "adaptive", "sims")),
                "precision": choose((32, 64)),
            },
            "nodes": {
                "source": emitter,
                "motion": {"type": "stack", "from": "source", "ops": [self.operator(k) for k in range(choose((1, 2, 3, 5)))]},
                "view": {"type": "camera"},
                "frames": {
                    "type": "image", "from": "motion", "camera": "view", "size": [64, 36],
                    "shutter": choose((0, 0.5, 1, 1.7)), "phase": choose((0, 0, 0.4)),
                },
            },
        }
