"""Make plain Python functions callable from compiled code, and leave them plain.

`register(function)` registers it, and every plain function that it names, as Numba overloads, and
returns the source files that the result rests on. `by_precision` pairs are dispatched on the
precision of their first argument.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path
from types import CodeType, FunctionType
from typing import Any

from numba import types
from numba.extending import overload

from graphfx.lanes.types import Real, Vec3Type
from graphfx.math import primitives, tables, vec3
from graphfx.math.primitives import by_precision

_OPTIONS = {"forceinline": True, "error_model": "numpy"}
_BUILT_IN = {
    function for module in (primitives, tables) for function in vars(module).values()
    if isinstance(function, FunctionType) and function is not by_precision
}
_sources: dict[Any, frozenset[Path]] = {}


def _is_pair(candidate: Any) -> bool:
    return hasattr(candidate, "single") and hasattr(candidate, "double") and callable(candidate)


def _names(code: CodeType) -> set[str]:
    inner = [_names(constant) for constant in code.co_consts if isinstance(constant, CodeType)]
    return set(code.co_names).union(*inner)


def _callees(function: FunctionType) -> list[Any]:
    found = [function.__globals__.get(name) for name in sorted(_names(function.__code__))]
    return [g for g in found if (isinstance(g, FunctionType) or _is_pair(g)) and g not in _BUILT_IN]


def _is_double(type_: types.Type) -> bool:
    if isinstance(type_, Vec3Type):
        type_ = type_.element
    return not (type_.single if isinstance(type_, Real) else type_ == types.float32)


def register(function: Any) -> frozenset[Path]:
    """Register a function and all it calls; return the files that hold their sources."""
    if function in _sources:
        return _sources[function]
    _sources[function] = frozenset()
    if _is_pair(function):
        files = register(function.single) | register(function.double)
        _overload(function, function.single, lambda first: function.double if _is_double(first) else function.single)
    else:
        files = frozenset({Path(inspect.getsourcefile(function) or "")})
        files = files.union(*(register(callee) for callee in _callees(function)))
        _overload(function, function, lambda first: function)
    _sources[function] = files
    return files


def _overload(target: Any, model: Callable[..., Any], choose: Callable[[types.Type], Callable[..., Any]]) -> None:
    """Register for Numba: it asks a stub with the same argument names, which returns the function for the types."""
    names = list(inspect.signature(model).parameters)
    scope = {"choose": choose}
    exec(f"def stub({', '.join(names)}):\n    return choose({names[0] if names else 'None'})", scope)
    overload(target, jit_options=_OPTIONS, strict=False)(scope["stub"])


for _helper in (vec3.dot, vec3.cross, vec3.length, vec3.unit, vec3.rotate):
    register(_helper)
