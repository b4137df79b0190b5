"""An array that grows without being copied.

Its memory is a private anonymous mapping: where the system can (`mremap` on Linux), growing moves
page tables, not bytes, wherever the heap stands. New elements are 0, and pages never written take
no memory. While somebody keeps an old view, or where mappings cannot be resized, growing copies
into a new mapping; the old view then stays readable but is no longer part of the array.
"""

from __future__ import annotations

import mmap
from typing import Any

import numpy as np

PRIVATE: dict[str, int] = {}
if hasattr(mmap, "MAP_PRIVATE"):
    PRIVATE = {"flags": mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS}


class GrowableArray:
    """A 1-D array that can be resized; take `array` anew after each resize."""

    def __init__(self, dtype: Any) -> None:
        """Make an empty array."""
        self.dtype = np.dtype(dtype)
        self.array = np.empty(0, self.dtype)
        self.copies = 0
        """How often resizing had to copy."""
        self._memory: mmap.mmap | None = None

    def resize(self, length: int) -> None:
        """Keep the first elements; new ones are 0."""
        if length == len(self.array):
            return
        if length < len(self.array):
            # The system may leave these mapped, and growing again would show them.
            self.array[length : length + mmap.PAGESIZE // self.dtype.itemsize] = 0
        if length == 0:
            self._memory, self.array = None, np.empty(0, self.dtype)
        elif not self._resize_mapping(length):
            self._copy_to_new_mapping(length)

    def _resize_mapping(self, length: int) -> bool:
        """Return whether the system could; it refuses while there are other views."""
        if self._memory is None:
            return False
        kept = len(self.array)
        self.array = np.empty(0, self.dtype)
        try:
            self._memory.resize(length * self.dtype.itemsize)
            kept = length
        except (BufferError, SystemError, ValueError, OSError):
            return False
        finally:
            self.array = np.frombuffer(self._memory, self.dtype, kept)
        return True

    def _copy_to_new_mapping(self, length: int) -> None:
        memory = mmap.mmap(-1, length * self.dtype.itemsize, **PRIVATE)
        array = np.frombuffer(memory, self.dtype, length)
        kept = min(length, len(self.array))
        array[:kept] = self.array[:kept]
        self.copies += kept > 0
        self._memory, self.array = memory, array
