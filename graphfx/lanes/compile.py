"""Compile engine functions with Numba: `compiled` for what Python calls, `inlined` for what those call."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba

from graphfx.lanes import arithmetic, memory, tables, vectors  # noqa: F401  (they teach Numba the lane types)
from graphfx.lanes.bodies import register
from graphfx.lanes.cache import CheckedCache, code_digest, engine_digest

BASE_FOLDERS = ("math", "lanes", "store")


def compiled(function: Callable[..., Any]) -> Any:
    """Compile on first call for the types at hand: no GIL, IEEE division, cached on disk."""
    dispatcher = numba.njit(nogil=True, error_model="numpy")(function)
    folder = Path(inspect.getsourcefile(function) or "").parent.name
    stamp = engine_digest(*dict.fromkeys((*BASE_FOLDERS, folder)))
    name = f"{function.__module__}.{function.__qualname__}"
    dispatcher._cache = CheckedCache(name, code_digest(function.__code__).encode(), stamp)
    return dispatcher


def inlined(function: Callable[..., Any]) -> Any:
    """Compile into its callers, LLVM inlining it always."""
    return numba.njit(nogil=True, error_model="numpy", forceinline=True)(function)


__all__ = ["compiled", "inlined", "register"]
