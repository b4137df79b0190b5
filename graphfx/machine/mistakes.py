"""Say what Numba found wrong in a node at the author's own file and line, in the author's words."""

from __future__ import annotations

import dis
import inspect
import re

import graphfx.math
from graphfx.errors import Location, NodeError, Problem, suggestion
from graphfx.lanes.arithmetic import BRANCH, LaneBranchError
from graphfx.node.mistakes import unknown_name
from graphfx.program import Function

_PLAIN_TYPES = (
    (r"Vec3\(Real\(float\d\d, \d+\)\)", "Vec3"), (r"Real\(float\d\d, \d+\)", "float"), (r"Mask\(\d+\)", "bool"),
    (r"Literal\[\w+\]\(([^()]*)\)", r"\1"), (r"\bfloat64\b|\bint64\b", "float"),
)
_SYMBOLS = {"add": "+", "sub": "-", "mul": "*", "truediv": "/", "floordiv": "//", "mod": "%", "pow": "**", "neg": "-",
            "lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "ne": "!=", "and_": "&", "or_": "|", "invert": "~"}
_ADVICE = {"mul Vec3": "; write dot(a, b) or cross(a, b)", "pow": "; write power(x, y), of graphfx.math",
           "mod": "; write x - floor(x / y) * y", "floordiv": "; write floor(x / y)"}
_BOILERPLATE = ("Failed in nopython mode", "During:", "File ")


def located(function: Function, error: Exception) -> NodeError:
    """Return the error that names the file and line of the mistake in a function, or in what it calls."""
    text = str(error)
    source = function.body.__code__.co_filename
    lines = [int(line) for file, line in re.findall(r"at (\S+) \((\d+)\)", text) if file == source]
    lines += [int(line) for file, line in re.findall(r'File "([^"]+)", line (\d+)', text) if file == source]
    unknown = re.search(r"name '(\w+)' is not defined", text)
    if unknown:
        lines = _lines_that_read(function, unknown[1])
    line = lines[0] if lines else _first_line(function)
    return NodeError(Problem(_message(function, text, error), Location(source, line), function.name))


def _message(function: Function, text: str, error: Exception) -> str:
    if BRANCH in text or isinstance(error, LaneBranchError):
        return BRANCH
    unknown = re.search(r"name '(\w+)' is not defined", text)
    if unknown:
        return unknown_name(unknown[1], function.body.__code__.co_varnames)
    attribute = re.search(r"Unknown attribute '(\w+)' of type (.+)", text)
    if attribute:
        kind = _plain(attribute[2])
        return f"a {kind} has no '{attribute[1]}'" + ("; it has x, y and z" if kind == "Vec3" else "")
    cast = re.search(r"Cannot cast (.+?) to (\S+\(.*?\)|\w+): %", text)
    if cast:
        return f"it returns {_plain(cast[1])} where {_plain(cast[2])} is declared"
    found = re.findall(r"No implementation of function Function\((.*)\) found for signature:\s+>>> (\w+)\((.*)\)", text)
    if found:
        return _no_code(*found[-1])
    told = [line.strip() for line in text.splitlines() if line.strip() and not line.strip().startswith(_BOILERPLATE)]
    return _plain(told[0]) if told else f"{function.name} cannot be compiled"


def _no_code(what: str, name: str, arguments: str) -> str:
    """Return what to do about an operation that lanes do not have for some types."""
    types = _parted(_plain(arguments))
    symbol = _SYMBOLS.get(name.removeprefix("i") if name.removeprefix("i") in _SYMBOLS else name)
    if symbol and "built-in" in what:
        said = f" {symbol} ".join(types) if len(types) == 2 else f"{symbol}{types[0]}"
        return f"there is no {said}{_ADVICE.get(name, _ADVICE.get(f'{name} {types[-1]}', ''))}"
    own = getattr(graphfx.math, name, None)
    if callable(own) and what.startswith(f"<function {name} "):
        return f"{name} takes {_arguments(own)}, and is given ({', '.join(types)})"
    if own is not None:
        return f"particles have no {name} of Python or NumPy; write: from graphfx.math import {name}"
    return f"particles have no {name}({', '.join(types)})." + suggestion(name, [n for n in vars(graphfx.math) if n[0] != "_"])


def _arguments(function: object) -> str:
    return "(" + ", ".join(inspect.signature(function).parameters) + ")"  # type: ignore[arg-type]


def _parted(text: str) -> list[str]:
    """Return the parts of a list with commas, those in brackets left whole."""
    return [part.strip() for part in re.split(r",(?![^(]*\))", text) if part.strip()]


def _plain(text: str) -> str:
    """Return a message with Numba's types as an author writes them."""
    for pattern, plain in _PLAIN_TYPES:
        text = re.sub(pattern, plain, text)
    return text


def _lines_that_read(function: Function, name: str) -> list[int]:
    """Return the lines of a function on which a global name is read."""
    instructions = dis.get_instructions(function.body)
    return [found.positions.lineno for found in instructions
            if found.argval == name and found.positions is not None and found.positions.lineno]


def _first_line(function: Function) -> int:
    """Return the line of a function's first statement: that of a body put into its kernel is its only one."""
    code = function.body.__code__
    return min((line for _, _, line in code.co_lines() if line and line > code.co_firstlineno), default=code.co_firstlineno)
