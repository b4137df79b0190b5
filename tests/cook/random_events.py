"""Random graphs of events: spawns, sets, fades, kills, recycling, selectors, clusters and own attributes."""

from __future__ import annotations

from typing import Any

from .random_graphs import GraphMaker

STATE = ("heat", "flicker", "region", "hits", "lives", "generation", "birth.mass", "birth.heat", "length(birth.position)",
         "rest_position.y", "length(initial_velocity)", "type")
AT_BIRTH = tuple(name for name in STATE if "birth." not in name and "initial" not in name)


class EventMaker(GraphMaker):
    """Draws graphs in which particles are made of particles, told apart, changed and ended."""

    def __init__(self, seed: int):
        super().__init__(seed)
        self.names: tuple[str, ...] = STATE

    def expression(self, depth: int = 0) -> str:
        if depth and self.random.random() < 0.3:
            return self.random.choice(self.names)
        return super().expression(depth)

    def scalar(self, low: float, high: float) -> Any:
        if self.random.random() < 0.2:
            return {"rand": [low, high], "per": self.random.choice(("flicker", "region", "particle")), "vary": 0.2}
        return super().scalar(low, high)

    def condition(self, depth: int = 0) -> Any:
        choose = self.random.choice
        makers = (
            lambda: choose(("some", "high")), lambda: {"expr": f"{self.expression()} < {self.expression()}"},
            lambda: {"share": {"fraction": self.number(0, 1)}}, lambda: {"inside_sphere": {"radius": self.scalar(0.1, 2)}},
            lambda: {"older_than": {"seconds": self.number(0, 0.2)}}, lambda: {"not": self.condition(depth + 1)},
            lambda: {choose(("all", "any")): [self.condition(depth + 1) for _ in range(choose((1, 2, 3)))]},
        )
        return choose(makers[: 5 if depth > 1 else 7])()

    def sets(self) -> dict[str, Any]:
        makers = {"heat": lambda: self.scalar(0, 5), "mass": lambda: self.scalar(0.1, 3), "radius": lambda: self.scalar(0.01, 1),
                  "color": lambda: self.vector(1), "velocity": self.vector, "way": self.vector, "type": lambda: self.scalar(0, 3),
                  "position": self.vector}
        chosen = self.random.sample(list(makers), self.random.choice((1, 1, 2)))
        return {name: makers[name]() for name in chosen}

    def acting(self, place: int) -> dict[str, Any]:
        """Return an operator that acts at a moment, or fades."""
        choose = self.random.choice
        kind = choose(("set", "set", "fade", "kill", "recycle"))
        made: dict[str, Any] = {"type": kind, "id": f"{kind}_{place}"}
        if kind in ("kill", "recycle") or choose((0, 1)):
            made["only"] = self.condition()
        if kind == "set":
            made["when"] = choose(("frame", "step", "birth", "hit", "death", {"hit": ["motion"]}))
        if kind == "kill":
            made["when"] = choose(("step", "frame", "hit"))
        if kind == "recycle":
            made["when"] = choose(("death", "step"))
        if kind == "fade":
            made["rate"] = self.number(0, 9)
        if kind in ("set", "fade"):
            made["set"] = self.sets()
        return made

    def spawn(self, source: str) -> dict[str, Any]:
        choose = self.random.choice
        made: dict[str, Any] = {"type": "spawn", "from": source, "life": self.number(0.02, 0.2)}
        if choose((0, 1)):
            made["only"] = self.condition()
        if choose((0, 0, 1)):
            made |= {"rate": self.scalar(0, 40)}
        else:
            made |= {"when": choose(("birth", "hit", "death")), "count": choose((1, 2, {"expr": "floor(mass) + 1"}))}
        if choose((0, 1)):
            made["inherit"] = self.random.sample(["velocity", "heat", "mass", "color", "way"], choose((0, 1, 3)))
        if choose((0, 1)):
            made |= {"spread": self.number(0, 2), "probability": self.number(0, 1)}
        if choose((0, 0, 1)):
            made |= {"into": "source", "generations": 2}
        if choose((0, 1)):
            self.names = (*AT_BIRTH, "parent.mass", "parent.heat", "parent.age", "length(parent.velocity)")
            made["set"] = self.sets()
            self.names = STATE
        return made

    def graph(self) -> dict[str, Any]:
        """Return a graph of five frames."""
        choose = self.random.choice
        self.names = AT_BIRTH
        made = super().graph()
        self.names = STATE
        nodes = made["nodes"]
        nodes["source"] |= {"clusters": {"flicker": {"count": 3, "by": choose(("turn", "nearest"))}, "region": {"count": 2}}}
        nodes["source"]["set"].pop("position", None)
        nodes["source"].pop("life", None)
        nodes["source"] |= {"life": self.number(0.05, 0.3)} if choose((0, 1, 1)) else {}
        if choose((0, 1)):
            nodes["source"] |= {"count": choose((3, 20)), "every": choose(("infinity", 0.1))}
        ops = nodes["motion"]["ops"]
        for place in range(choose((1, 2, 3))):
            ops.insert(self.random.randrange(len(ops) + 1), self.acting(place))
        if choose((0, 1)):
            ops.append({"type": "bounce_plane", "id": "floor", "point": [0, -0.2, 0], "resilience": choose((0, 0.5))})
        if not any("bounce" in op["type"] for op in ops):
            for op in ops:
                op["when"] = "hit" if isinstance(op.get("when"), dict) else op.get("when")
                if op["when"] is None:
                    del op["when"]
        nodes["some"] = {"type": "share", "fraction": self.number(0, 1)}
        nodes["high"] = {"type": "above_plane", "from": "motion"}
        seen = [choose(("motion", "high"))]
        for place in range(choose((0, 1, 2))):
            nodes[f"made{place}"] = self.spawn(choose(seen))
            seen.append(f"made{place}")
        nodes["frames"]["from"] = seen
        return made | {"attributes": {"heat": {"type": "float", "default": 1}, "way": {"type": "direction"}}}
