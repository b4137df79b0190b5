"""The programs of births: what a maker gives a new particle, and what it becomes in a new life."""

from __future__ import annotations

from dataclasses import dataclass, field

from graphfx.graph.flat import FlatNode
from graphfx.graph.values import Value
from graphfx.math.random import key_of
from graphfx.motion import events
from graphfx.node import DERIVED_ATTRIBUTES
from graphfx.plan.frame_program import FrameProgram, LazyClock
from graphfx.plan.hits import HIT_TYPES
from graphfx.plan.holder import Holder, moment_of
from graphfx.plan.liveness import Attributes
from graphfx.plan.rates import NOUGHT, Scope, lane_type
from graphfx.plan.setting import Setting, as_column
from graphfx.plan.values import ValueWriter
from graphfx.program import Builder, Operand, Uniform


@dataclass
class BirthWriter:
    """Writes births of one source. Times, ids, clusters, `parent.x` and `hit.x` come by place."""

    holder: Holder
    attributes: Attributes
    seed: int
    precision: int
    builder: Builder = field(init=False)
    made: FrameProgram = field(init=False)
    maker: FlatNode = field(init=False)
    found: dict[str, Operand] = field(init=False)

    def write(self, maker: FlatNode, wanted: list[str] | None = None) -> FrameProgram:
        """Return the program that fills the columns of new rows; of `wanted` attributes alone, to arrays by place."""
        self.maker = maker
        self.builder = Builder.begin(f"{maker.path}: birth")
        self.made = FrameProgram(self.builder.program)
        self.found = {name: Uniform("0", "float", 0.0) for name in DERIVED_ATTRIBUTES}
        stored = [name for name in self.attributes.types if name in self.holder.table] if wanted is None else wanted
        values = self._writer()
        others = [*self._originals(), *(name[5:] for name in self._tails())] if wanted is None else []
        for name in self.holder.birth_order([*stored, *others], maker):
            self.builder.note = f"{maker.path}.{name}"
            if name == "lives" and name in self.found:
                continue
            self.found[name] = values.argument(self._value(name))
            if name == "velocity" and "spread" in maker.given:
                self._spread(values)
        if wanted is None:
            self._at_birth()
        for name in stored:
            self.builder.store(name, as_column(self.builder, self.found[name], self._lane(name), name))
        if wanted is None:
            self._store_originals()
        return self.made

    def _value(self, name: str) -> Value:
        return self.holder.value_from(self.maker, name, self.holder.parents_of(self.maker))

    def _originals(self) -> list[str]:
        return [name[6:] for name in self.attributes.types if name.startswith("birth.")]

    def _tails(self) -> list[str]:
        """Return what is stored of tails alone: it is as at the head until it is set."""
        return [name for name in self.attributes.types if name.startswith("tail.")]

    def _store_originals(self) -> None:
        """Store the values at birth of what changes later, those of tails, and the numbers in clusters."""
        for name in self._tails():
            self.builder.store(name, as_column(self.builder, self.found.get(name, self.found[name[5:]]), self._lane(name), name))
        for name in self._originals():
            self.builder.store(f"birth.{name}", as_column(self.builder, self.found[name], self._lane(name), f"birth.{name}"))
        for name in self.holder.clusters:
            if name in self.attributes.columns:
                copy = as_column(self.builder, self._operand(name), "float", name, always=True)
                self.builder.store(name, copy)

    def _lane(self, name: str) -> str:
        return lane_type(self.holder.table[name.removeprefix("tail.")].type)

    def _operand(self, name: str) -> Operand:
        """Return what a name means at birth."""
        if name in self.found:
            return self.found[name]
        scope, _, rest = name.partition(".")
        if scope == "hit":
            return self.builder.load(name, HIT_TYPES[rest])
        if scope == "parent" and rest not in ("age", "normalized_age"):
            return self.builder.load(name, self._lane(rest))
        if scope == "birth":
            return self._operand(rest)
        if name in self.holder.clusters or scope == "parent":
            return self.builder.load(f"number {name}" if scope != "parent" else name, "float")
        if name in self.holder.table:
            self.found[name] = self._writer().argument(self._value(name))
            return self.found[name]
        raise KeyError(name)

    def _number(self, name: str) -> Operand:
        """Return a count as a word."""
        if name == "lives" and "lives" not in self.attributes.columns:
            return NOUGHT
        if name == "hits":
            return NOUGHT
        count = self.builder.load("number lives", "float") if name == "lives" else self._operand(name)
        word: Operand = self.builder.call(events.word_of, count, name=f"{name} word")
        return word

    def _writer(self) -> ValueWriter:
        identity = lambda: self.builder.load("birth_id", "id")  # noqa: E731
        scope = Scope(self.seed, self.maker.path, self._operand, identity, lambda name: True, self._number)
        clock = LazyClock(
            {
                "time": lambda: self.builder.load("birth_time", "float"),
                "frame": lambda: self.made.time(self.builder, "frame"),
                "frame word": lambda: self.made.time(self.builder, "frame word"),
            },
            lambda path: self.made.mesh(self.builder, path),
        )
        if "lives" in self.attributes.columns:
            self.found["lives"] = self.builder.load("number lives", "float")
        return ValueWriter(self.builder, scope, clock, None, self.precision)

    def _spread(self, values: ValueWriter) -> None:
        key = key_of(self.seed, self.maker.path, "spread")
        draw = self.builder.draw(key, self.builder.load("birth_id", "id"), NOUGHT, NOUGHT)
        size = values.argument(self.maker.arguments["spread"])
        self.found["velocity"] = self.builder.call(events.spread, self.found["velocity"], draw, size, name="velocity")

    def _at_birth(self) -> None:
        """Write what operators set at birth, in stack order."""
        live = [*self.attributes.types, *self._originals()]
        for node in self.holder.of_role("set", "assign"):
            if moment_of(node) != "birth":
                continue
            setting = Setting(node, self._writer, self.builder, self.found.__getitem__)
            for name in setting.targets(live):
                now = self.found.get(name) or self.found[name.removeprefix("tail.")]
                self.found[name] = as_column(self.builder, now, self._lane(name), name, always=True)
            setting.write(live)

