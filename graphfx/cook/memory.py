"""How much memory there is for a picture in the making."""

from __future__ import annotations

import os
import sys
from pathlib import Path

LEFT = 48 << 20
"""Bytes left for what else goes on while a picture is made: pictures on their way to files, the next kernels."""
SHARE = 0.5
"""Part of the available memory that a picture may take where no limit is given."""


def working_memory(allowed: int | None, pixels: int) -> float:
    """Return the bytes that making a picture of so many pixels may take, beside its film.

    `allowed` is what the whole process may take, or half of what is available if it is not given. No byte of a picture depends
    on it.
    """
    film = 16 * pixels
    if allowed is not None:
        return allowed - resident() - film - LEFT
    return SHARE * available() - film


def available() -> float:
    """Return the bytes of memory that could be had, what the system keeps of files included; infinity if it cannot be told."""
    try:
        lines = Path("/proc/meminfo").read_text().splitlines()
        return 1024.0 * int(next(line for line in lines if line.startswith("MemAvailable:")).split()[1])
    except (OSError, StopIteration, IndexError, ValueError):
        pass
    try:
        return float(os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE"))
    except (AttributeError, OSError, ValueError):
        return float("inf")


def resident() -> int:
    """Return the bytes of memory that this process takes; where no system tells, the most that it ever took."""
    try:
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError, ValueError):
        pass
    try:
        import resource
    except ImportError:
        return 0
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)
