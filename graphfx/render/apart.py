"""`apart`: as `inner`, for functions so long that their callers are better compiled without a copy of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba


def apart(function: Callable[..., Any]) -> Any:
    """Compile once for all compiled functions that call it; as `inner`, it can make no arrays and return none."""
    return numba.njit(nogil=True, error_model="numpy", no_cpython_wrapper=True, no_cfunc_wrapper=True, _nrt=False)(function)
