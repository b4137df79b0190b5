"""Which precision a value has: float32 or float64."""

from __future__ import annotations

from typing import Any

import numpy as np


def lane_type(*values: Any) -> type:
    """np.float32 where float32 meets only literals, else np.float64.

    The values are NumPy scalars, arrays of them, or Python numbers; those are literals.
    """
    found: type = np.float64
    for value in values:
        kind = value.dtype.type if isinstance(value, np.ndarray) else type(value)
        if kind is np.float64:
            return np.float64
        if kind is np.float32:
            found = np.float32
    return found
