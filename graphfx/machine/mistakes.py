"""Say what Numba found wrong in a node at the author's own file and line, in the author's words."""

from __future__ import annotations

import dis
import re

from graphfx.errors import Location, NodeError, Problem
from graphfx.lanes.arithmetic import BRANCH, LaneBranchError
from graphfx.program import Function

_PLAIN_TYPES = (
    (r"Vec3\(Real\(float\d\d, \d+\)\)", "Vec3"), (r"Real\(float\d\d, \d+\)", "float"), (r"Mask\(\d+\)", "bool"),
    (r"Literal\[\w+\]\(([^()]*)\)", r"\1"), (r"\bfloat64\b|\bint64\b", "float"),
)
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
        return f"there is no '{unknown[1]}' here; import it, for instance from graphfx.math"
    cast = re.search(r"Cannot cast (.+?) to (\S+\(.*?\)|\w+): %", text)
    if cast:
        return f"it returns {_plain(cast[1])} where {_plain(cast[2])} is declared"
    found = re.findall(r"No implementation of function (.*?) found for signature:\s+>>> (.*)", text)
    if found:
        return f"no lane code for {_plain(found[-1][1].strip())}"
    told = [line.strip() for line in text.splitlines() if line.strip() and not line.strip().startswith(_BOILERPLATE)]
    return _plain(told[0]) if told else f"{function.name} cannot be compiled"


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
