"""How much memory there is for a picture in the making."""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
from pathlib import Path

LEFT = 16 << 20
"""Bytes left for what else goes on while a picture is made: room for the threads, the next kernels."""
SPARE = 0.02
"""Part of what is allowed that is left as well, for what grows with the particles and is not counted one by one."""
PIXEL = 16
"""Bytes of a pixel in a film."""
MMAP_THRESHOLD = -3
"""The number of that setting of mallopt, see mallopt(3)."""
FEW = 8
"""Films; where no more than these have room, a film is written before the next is made, and not beside it."""
SHARE = 0.5
"""Part of the available memory that a picture may take where no limit is given."""


def working_memory(allowed: int | None, pixels: int) -> float:
    """Return the bytes that making a picture of so many pixels may take, beside its film.

    `allowed` is what the whole process may take, or half of what is available if it is not given. No byte of a picture depends
    on it.
    """
    film = PIXEL * pixels
    if allowed is not None:
        return_unused()
        return allowed * (1 - SPARE) - resident() - film - LEFT
    return SHARE * available() - film


def is_scarce(allowed: int | None, pixels: int) -> bool:
    """Return whether only a few films of so many pixels would have room in what the process may take."""
    return allowed is not None and working_memory(allowed, pixels) < FEW * PIXEL * pixels


def return_what_is_freed() -> None:
    """From now on have what is larger than a megabyte returned to the system when it is freed, where the C library can (glibc).

    Otherwise it keeps what was freed, in pieces that the next array may not fit into.
    """
    with contextlib.suppress(AttributeError, OSError, TypeError):
        ctypes.CDLL(None).mallopt(MMAP_THRESHOLD, 1 << 20)


def return_unused() -> None:
    """Give memory that was freed back to the system, where the C library keeps it (glibc)."""
    with contextlib.suppress(AttributeError, OSError, TypeError):
        ctypes.CDLL(None).malloc_trim(0)


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
