"""The functions and operators of expressions: the one list of them.

`FUNCTIONS` is keyed by the names that a `Call` carries and that kernels are found by. The same name
serves numbers and vectors; the types of the arguments say which is meant.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import groupby


@dataclass(frozen=True)
class Function:
    """One function: `forms` are its (argument types, result type), `spelling` is how an expression writes it."""

    name: str
    forms: tuple[tuple[tuple[str, ...], str], ...]
    spelling: str
    doc: str

    @property
    def argument_count(self) -> int:
        """Return how many arguments it takes."""
        return len(self.forms[0][0])

    def result(self, arguments: tuple[str, ...]) -> str | None:
        """Return the type that it gives for arguments of these types, or None where it takes no such arguments.

        An argument of type '' is not known (a mistake in it was told already) and fits any.
        """
        for wanted, result in self.forms:
            if len(wanted) == len(arguments) and all(given in ("", want) for given, want in zip(arguments, wanted, strict=True)):
                return result
        return None


_F, _V, _B = "float", "vec3", "bool"
_ONE = (((_F,), _F),)
_TWO = (((_F, _F), _F),)
_THREE = (((_F, _F, _F), _F),)
_LINEAR = (((_F, _F), _F), ((_V, _V), _V))
_COMPARE = (((_F, _F), _B),)
_LOGIC = (((_B, _B), _B),)

FUNCTIONS = {
    function.name: function
    for function in (
        Function("add", _LINEAR, "a + b", "Sum."),
        Function("subtract", _LINEAR, "a - b", "Difference."),
        Function("multiply", (*_TWO, ((_V, _F), _V), ((_F, _V), _V)), "a * b", "Product; a vector by a number scales it."),
        Function("divide", (((_F, _F), _F), ((_V, _F), _V)), "a / b", "Quotient; division by zero gives infinity."),
        Function("modulo", _TWO, "a % b", "a - floor(a / b) * b: the remainder, with the sign of b."),
        Function("power", _TWO, "a ** b", "a to the power b, whole for a negative a; pow(a, b) is the same."),
        Function("negate", (((_F,), _F), ((_V,), _V)), "-a", "The opposite."),
        Function("less", _COMPARE, "a < b", "Whether a is less than b."),
        Function("less_equal", _COMPARE, "a <= b", "Whether a is at most b."),
        Function("greater", _COMPARE, "a > b", "Whether a is greater than b."),
        Function("greater_equal", _COMPARE, "a >= b", "Whether a is at least b."),
        Function("equal", _COMPARE, "a == b", "Whether a equals b exactly."),
        Function("not_equal", _COMPARE, "a != b", "Whether a differs from b."),
        Function("and", _LOGIC, "a and b", "Whether both hold."),
        Function("or", _LOGIC, "a or b", "Whether one of the two holds."),
        Function("not", (((_B,), _B),), "not a", "Whether a does not hold."),
        Function("select", tuple(((_B, kind, kind), kind) for kind in (_F, _V, _B)), "a if c else b", "a where c holds, else b."),
        Function("vec", (((_F, _F, _F), _V),), "vec(x, y, z)", "A vector of three numbers."),
        Function("component_x", (((_V,), _F),), "v.x", "First component of a vector."),
        Function("component_y", (((_V,), _F),), "v.y", "Second component of a vector."),
        Function("component_z", (((_V,), _F),), "v.z", "Third component of a vector."),
        Function("sin", _ONE, "sin(x)", "Sine of an angle in radians."),
        Function("cos", _ONE, "cos(x)", "Cosine of an angle in radians."),
        Function("exp", _ONE, "exp(x)", "e to the power x."),
        Function("log", _ONE, "log(x)", "Natural logarithm."),
        Function("sqrt", _ONE, "sqrt(x)", "Square root."),
        Function("abs", _ONE, "abs(x)", "x without its sign."),
        Function("floor", _ONE, "floor(x)", "The largest whole number that is at most x."),
        Function("min", _TWO, "min(a, b, ...)", "The least of its arguments."),
        Function("max", _TWO, "max(a, b, ...)", "The greatest of its arguments."),
        Function("clamp", _THREE, "clamp(x, low, high)", "x, but at least low and at most high."),
        Function("mix", (((_F, _F, _F), _F), ((_V, _V, _F), _V)), "mix(a, b, t)", "a + (b - a) * t."),
        Function("step", _TWO, "step(edge, x)", "0 where x < edge, else 1."),
        Function("smoothstep", _THREE, "smoothstep(low, high, x)", "0 up to low, 1 from high, between them 3 t^2 - 2 t^3."),
        Function("length", (((_V,), _F),), "length(v)", "Length of a vector."),
        Function("dot", (((_V, _V), _F),), "dot(a, b)", "Scalar product."),
        Function("cross", (((_V, _V), _V),), "cross(a, b)", "Vector product, right-handed."),
        Function("normalize", (((_V,), _V),), "normalize(v)", "Unit vector; of the zero vector, zero."),
    )
}

ANY_NUMBER = frozenset({"min", "max"})
"""Functions that an expression may give more than two arguments; they nest pairwise from the left."""

CALLED = {"pow": "power"} | {
    name: name for name, function in FUNCTIONS.items() if function.spelling.startswith(f"{name}(")
}
"""What an expression calls, and the function that it means."""

BINARY = {
    "+": "add", "-": "subtract", "*": "multiply", "/": "divide", "%": "modulo", "**": "power",
    "<": "less", "<=": "less_equal", ">": "greater", ">=": "greater_equal", "==": "equal", "!=": "not_equal",
}
"""Operators of two arguments, and the functions that they mean."""

CONSTANTS = {
    "pi": 3.141592653589793, "tau": 6.283185307179586, "infinity": float("inf"), "true": True, "false": False,
}
"""Names that stand for one value everywhere."""


def in_words(kinds: tuple[str, ...]) -> str:
    """Return types of arguments as a message names them: "a vector and two numbers"."""
    words = {"float": "number", "vec3": "vector", "bool": "condition", "": "unknown"}
    counts = {2: "two", 3: "three"}
    parts = [(words[kind], len(list(run))) for kind, run in groupby(kinds)]
    named = [f"a {word}" if count == 1 else f"{counts.get(count, count)} {word}s" for word, count in parts]
    return named[0] if len(named) == 1 else f"{', '.join(named[:-1])} and {named[-1]}"
