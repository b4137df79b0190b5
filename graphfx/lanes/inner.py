"""`inner`: for functions that only work on arrays that they are given.

Numba counts references to arrays wherever they are passed on, atomically: in a renderer's inner
loop that costs four times the work itself. These functions count none, so they can make no arrays and return none.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba


def inner(function: Callable[..., Any]) -> Any:
    """Compile into the compiled functions that call it; Python itself cannot call it, which saves the time for an entry."""
    return numba.njit(
        nogil=True, error_model="numpy", forceinline=True, no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False
    )(function)
