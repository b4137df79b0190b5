"""Values of a document to trees of `Value`: literals, expressions, keys, ramps, random numbers, value nodes."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from graphfx.errors import suggestion
from graphfx.graph.checking import Checking, declared, listed, nearest, number, takes
from graphfx.graph.expressions import parse
from graphfx.graph.items import Item
from graphfx.graph.literals import Literals, lane, wanted
from graphfx.graph.names import INTERPOLATIONS, REPEATS, SCOPES, VALUE_KEYS
from graphfx.graph.scope import Scope, particle_reader
from graphfx.graph.values import (
    Call,
    Expression,
    Keys,
    Literal,
    Node,
    ParameterValue,
    Ramp,
    Random,
    Value,
    measure,
)
from graphfx.node.types import Parameter

_OVER = Parameter("over", "float", None)


class ValueReader:
    """Reads the values of one graph."""

    def __init__(self, checking: Checking, literals: Literals):
        """Complain to `checking`; find files as `literals` does."""
        self.checking, self.literals, self.complain = checking, literals, checking.complain
        self.meshes: list[Literal] = []
        """Meshes that values name, to be looked up when all nodes are known."""

    def read(self, item: Item, want: Parameter, scope: Scope, key: str) -> Value | None:
        """Return a value of the type that a parameter wants (any, where its type is ''), or None after a complaint.

        `key` is the JSON path inside the owner of `scope`.
        """
        if item.broken:
            return None
        before = len(self.checking.problems)
        value = self._value(item, want, scope, key)
        if value is None or len(self.checking.problems) > before:
            return value
        path = _join(scope.path, key)
        if scope.uniform:
            reader = particle_reader(value)
            if reader:
                place = (reader.value or value).location
                self.complain(place, path, f"{scope.uniform}; this reads {reader.what}")
        return self.within_limits(value, item, path)

    def within_limits(self, value: Value, item: Item, path: str) -> Value | None:
        """Return a value, or None after a complaint that it is too large or too deep."""
        size = measure(value)
        if size.size > self.checking.limits.value_size or size.depth > self.checking.limits.expression_depth:
            self.complain(item.location, path,
                          f"the value has {size.size:,} parts, {size.depth} deep, with all that it refers to; "
                          f"the limits are {self.checking.limits.value_size:,} and {self.checking.limits.expression_depth}")
            return None
        return value

    def _value(self, item: Item, want: Parameter, scope: Scope, key: str) -> Value | None:
        if item.is_object:
            return self._compound(item, want, scope, key)
        path = _join(scope.path, key)
        if want.type == "mesh" and item.is_text:
            self.meshes.append(Literal("mesh", item.location, path, "", item.value))
            return self.meshes[-1]
        if item.is_list and any(part.is_object for part in item.value):
            if lane(want.type) in ("vec3", "") and len(item.value) == 3:
                return self._vector_of_values(item, want, scope, key)
            if want.type == "interval" and len(item.value) == 2:
                ends = [self.read(part, replace(want, type="float"), scope, f"{key}[{i}]") for i, part in enumerate(item.value)]
                return None if None in ends else Expression("interval", item.location, path, "", Call("interval", tuple(ends)))
        value = self.literals.read(item, want, path)
        if value is None:
            return None
        return Literal(want.type or _inferred(item, value), item.location, path, _seed(scope, key), value)

    def _vector_of_values(self, item: Item, want: Parameter, scope: Scope, key: str) -> Value | None:
        want = replace(want, type=want.type or "vec3")
        parts = [self.read(part, replace(want, type="float"), scope, f"{key}[{i}]") for i, part in enumerate(item.value)]
        if None in parts:
            return None
        return Expression(want.type, item.location, _join(scope.path, key), _seed(scope, key), Call("vec", tuple(parts)))

    def _compound(self, item: Item, want: Parameter, scope: Scope, key: str) -> Value | None:
        path = _join(scope.path, key)
        nodes = self.checking.types_of("values", "selectors")
        entries = dict(item.entries())
        found = [name for name in entries if name in VALUE_KEYS or name in nodes]
        if len(found) != 1:
            if found:
                self.complain(item.location, path, f"this value is given twice, by {' and '.join(found)}; keep one")
                return None
            known = [*VALUE_KEYS, *nodes]
            near = next((hint for name in entries if (hint := suggestion(name, known))), "")
            what = f"no value is called '{next(iter(entries))}'." + near if entries else "an empty object is no value."
            self.complain(item.key_location(next(iter(entries))) if entries else item.location, path,
                          f"{what} {want.name or 'This'} should be {wanted(want)}, or an object that makes one",
                          f"values: {', '.join(known)}")
            return None
        name = found[0]
        modifiers = VALUE_KEYS.get(name, ("per",))
        self.checking.unknown_keys(item, path, (name, *modifiers), name)
        drawn = scope.settled and name not in ("param", "expr")
        if name == "param" or not (drawn or want.type in ("string", "path", "interval", "list", "mesh")):
            readers = {"param": self._param, "expr": self._expr, "keys": self._keys, "ramp": self._ramp, "rand": self._rand}
            return readers.get(name, self._node)(item, name, want, scope, key)
        self.complain(item.location, path, f"{want.name} should be {wanted(want)}, written out or given by {{\"param\": ...}}; "
                      f"{name} cannot give it")
        return None

    def _fits(self, item: Item, path: str, kind: str, want: Parameter, what: str) -> bool:
        """Complain unless a value of type `kind` may stand where `want` is declared."""
        if not want.type or not kind or (lane(kind) == lane(want.type) and (want.type != "int" or kind in ("int", ""))):
            return True
        if want.type == "int" and lane(kind) == "float":
            return True
        words = {"float": "a number", "vec3": "a vector", "bool": "a condition, true or false"}
        self.complain(item.location, path,
                      f"{want.name} should be {wanted(want)}; {what} is {words.get(lane(kind), 'of type ' + kind)}")
        return False

    def _param(self, item: Item, name: str, want: Parameter, scope: Scope, key: str) -> Value | None:
        path, inner = _join(scope.path, key), item.value[name]
        text = self.checking.text(inner, f"{path}.param", "the name of a parameter")
        if not text:
            return None
        parameter = scope.params.get(text)
        if parameter is None and f"params.{text}" in scope.broken:
            return None
        if parameter is None:
            near = nearest(text, scope.params)
            self.complain(inner.location, f"{path}.param", f"the graph has no parameter '{text}'." + near,
                          f"its parameters: {listed(scope.params)}")
            return None
        if not self._fits(inner, path, parameter.type, want, f"the parameter '{text}'"):
            return None
        return ParameterValue(want.type or parameter.type, item.location, path, _seed(scope, key), text)

    def _expr(self, item: Item, name: str, want: Parameter, scope: Scope, key: str) -> Value | None:
        path, inner = _join(scope.path, key), item.value[name]
        if not inner.is_text:
            self.checking.mismatch(inner, f"{path}.expr", "an expression should be text in quotes")
            return None
        text = inner.value
        tree, kind, mistakes = parse(text, scope.resolve, self.checking.limits, scope.members)
        for mistake in mistakes:
            notes = (text, " " * mistake.column + "^") if text.isprintable() and len(text) <= 100 else ()
            self.complain(inner.text_location(mistake.column), f"{path}.expr", mistake.message, *notes, *mistake.notes)
        if mistakes or not kind or not self._fits(inner, path, kind, want, "this expression"):
            return None
        return Expression(want.type or kind, item.location, path, _seed(scope, key), tree, text)

    def _pairs(self, item: Item, name: str, want: Parameter, path: str, first: str) -> tuple[list[float], list[Any], str] | None:
        """Return the rising numbers and the values of keys or of a ramp."""
        inner = item.value[name]
        if want.type and lane(want.type) not in ("float", "vec3"):
            self.complain(item.location, path, f"{want.name} should be {wanted(want)}; {name} give numbers, vectors and colours")
            return None
        rows = inner.value if inner.is_list else []
        if not rows or not all(row.is_list and len(row.value) == 2 for row in rows):
            bad = next((row for row in rows if not (row.is_list and len(row.value) == 2)), inner)
            self.checking.mismatch(bad, f"{path}.{name}", f"{name} should be a list of pairs [[{first}, value], ...]")
            return None
        numbers: list[float] = []
        values: list[Any] = []
        kind = want.type
        for index, row in enumerate(rows):
            place, given = row.value
            where = f"{path}.{name}[{index}]"
            at = self.literals.read(place, Parameter(first, "float", None), where)
            if at is not None and numbers and at <= numbers[-1]:
                self.complain(place.location, where, f"the {first} {number(at)} does not come after {number(numbers[-1])}; "
                              "write them in rising order, each once")
            numbers.append(at if at is not None else 0.0)
            values.append(self.literals.read(given, replace(want, type=kind, name=want.name or "the value"), where))
            kind = kind or ("vec3" if isinstance(values[-1], tuple) else "float")
        return None if None in values else (numbers, values, kind)

    def _keys(self, item: Item, name: str, want: Parameter, scope: Scope, key: str) -> Value | None:
        path = _join(scope.path, key)
        interpolation = self._choice(item, path, "interpolation", INTERPOLATIONS)
        repeat = self._choice(item, path, "repeat", REPEATS)
        pairs = self._pairs(item, name, want, path, "time")
        if pairs is None:
            return None
        times, values, kind = pairs
        return Keys(kind, item.location, path, _seed(scope, key), tuple(times), tuple(values), interpolation, repeat)

    def _ramp(self, item: Item, name: str, want: Parameter, scope: Scope, key: str) -> Value | None:
        path = _join(scope.path, key)
        interpolation = self._choice(item, path, "interpolation", INTERPOLATIONS)
        pairs = self._pairs(item, name, want, path, "position")
        over = item.value.get("over")
        if over is not None and not over.is_text:
            reads = self.read(over, _OVER, scope, f"{key}.over")
        else:
            source = item if over is None else over
            text = Item("normalized_age" if over is None else over.value, source.offset, item.source)
            wrapped = Item({"expr": text}, text.offset, item.source, {"expr": text.offset})
            reads = self._expr(wrapped, "expr", _OVER, scope, f"{key}.over")
        if pairs is None or reads is None:
            return None
        positions, values, kind = pairs
        return Ramp(kind, item.location, path, _seed(scope, key), tuple(positions), tuple(values), reads,
                    interpolation)

    def _rand(self, item: Item, name: str, want: Parameter, scope: Scope, key: str) -> Value | None:
        path, inner = _join(scope.path, key), item.value[name]
        per = scope.per(self.checking, item.value["per"], f"{path}.per") if "per" in item.value else SCOPES[0]
        vary = item.value.get("vary")
        share = self.literals.read(vary, Parameter("vary", "float", None, min=0, max=1), f"{path}.vary") if vary else 0.0
        if want.type and lane(want.type) not in ("float", "vec3"):
            self.complain(item.location, path, f"{want.name} should be {wanted(want)}; rand gives numbers and vectors")
            return None
        if not inner.is_list or len(inner.value) != 2:
            self.checking.mismatch(inner, f"{path}.rand", "rand takes two values [a, b] and draws between them")
            return None
        low = self.read(inner.value[0], want, scope, f"{key}.rand[0]")
        second = want if want.type or low is None else replace(want, type=low.type, name="the second value")
        high = self.read(inner.value[1], second, scope, f"{key}.rand[1]")
        if low is None or high is None or share is None or not per:
            return None
        return Random(want.type or low.type, item.location, path, _seed(scope, key), low, high, per, share)

    def _node(self, item: Item, name: str, want: Parameter, scope: Scope, key: str) -> Value | None:
        path, inner = _join(scope.path, key), item.value[name]
        node_type = self.checking.node_type(name)
        if node_type is None:
            return None
        parameters = node_type.parameters
        notes = (takes(name, parameters.values()), declared(node_type))
        per = scope.per(self.checking, item.value["per"], f"{path}.per") if "per" in item.value else SCOPES[0]
        kind = node_type.result[0] if node_type.result else ""
        fits = self._fits(item, path, kind, want, name)
        if not inner.is_object:
            self.checking.mismatch(inner, f"{path}.{name}", f"{name} takes an object of its parameters", *notes)
            return None
        for given, _ in inner.entries():
            if given not in parameters:
                self.complain(inner.key_location(given), f"{path}.{name}.{given}",
                              f"{name} has no parameter '{given}'." + suggestion(given, parameters), *notes)
        arguments: list[tuple[str, Value | None]] = []
        for parameter in parameters.values():
            given = inner.value.get(parameter.name)
            if given is not None:
                arguments.append((parameter.name, self.read(given, parameter, scope, f"{key}.{name}.{parameter.name}")))
            elif parameter.required:
                self.complain(inner.location, f"{path}.{name}", f"{name} needs '{parameter.name}': {parameter.doc}", *notes)
                arguments.append((parameter.name, None))
            else:
                arguments.append((parameter.name, default_value(parameter, f"{path}.{name}.{parameter.name}")))
        if not fits or any(value is None for _, value in arguments):
            return None
        return Node(want.type or kind, item.location, path, _seed(scope, key), node_type, tuple(arguments), per)  # type: ignore[arg-type]

    def _choice(self, item: Item, path: str, key: str, choices: tuple[str, ...]) -> str:
        """Return one of a modifier's choices, the first by default, or '' after a complaint."""
        given = item.value.get(key)
        return choices[0] if given is None else self.checking.choice(given, f"{path}.{key}", key, choices)


def default_value(parameter: Parameter, path: str) -> Literal:
    """Return the default of a parameter as a value."""
    value = parameter.default
    return Literal(parameter.type, path=path, value=tuple(value) if isinstance(value, list) else value)


def _inferred(item: Item, value: Any) -> str:
    if isinstance(value, bool):
        return "bool"
    if isinstance(value, tuple):
        return "color" if item.is_text else "vec3"
    return "float"


def _seed(scope: Scope, key: str) -> str:
    return f"{scope.seed}/{key}" if scope.seed else key


def _join(path: str, key: str) -> str:
    return f"{path}.{key}" if path else key
