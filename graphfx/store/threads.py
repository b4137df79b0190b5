"""Run pieces of work on a shared pool of threads.

    parallel(function, pieces, threads):  function(piece) for each piece in 0 .. pieces - 1

Work in Python holds the interpreter's lock; compiled kernels let go of it, and those run at once.
The caller works too and waits only for helpers that have begun, so a piece may itself call
`parallel`, and several Python threads may call it at once.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextvars import copy_context
from typing import Any

MOST_THREADS = 256
"""No call gets more; threads are started only when they are needed."""

_pool: ThreadPoolExecutor | None = None
_pool_lock = threading.Lock()


def available_threads() -> int:
    """Return how many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def _forget_pool() -> None:
    """Begin anew in a forked child, where the parent's threads do not exist."""
    global _pool, _pool_lock
    _pool, _pool_lock = None, threading.Lock()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_pool)


def _shared_pool() -> ThreadPoolExecutor:
    global _pool
    with _pool_lock:
        if _pool is None:
            _pool = ThreadPoolExecutor(MOST_THREADS, thread_name_prefix="graphfx")
        return _pool


class _Work:
    """The pieces of one call, handed out in ascending order until all are taken or one fails."""

    def __init__(self, function: Callable[[int], Any], pieces: int) -> None:
        self.function = function
        self.pieces = pieces
        self.next_piece = 0
        self.lock = threading.Lock()
        self.failures: dict[int, BaseException] = {}

    def take(self) -> int | None:
        with self.lock:
            if self.next_piece >= self.pieces:
                return None
            self.next_piece += 1
            return self.next_piece - 1

    def stop(self) -> None:
        with self.lock:
            self.next_piece = self.pieces

    def raise_failure(self) -> None:
        """Raise the error of the lowest failing piece, or Ctrl-C before any."""
        failures = [self.failures.pop(piece) for piece in sorted(self.failures)]
        failures.sort(key=lambda failure: isinstance(failure, Exception))
        try:
            if failures:
                raise failures[0]
        finally:
            del failures  # a traceback that holds itself would keep arrays alive

    def run(self) -> None:
        while (piece := self.take()) is not None:
            try:
                self.function(piece)
            except BaseException as failure:
                self.failures[piece] = failure
                self.stop()


def _finish(work: _Work, helpers: list[Future[None]]) -> None:
    """Wait for the helpers that have begun; on Ctrl-C let them end their present piece first."""
    begun = [helper for helper in helpers if not helper.cancel()]
    try:
        wait(begun)
    except BaseException:
        work.stop()
        wait(begun)
        raise


def parallel(function: Callable[[int], Any], pieces: int, threads: int = 1) -> None:
    """Call function(piece) for every piece, each once, on up to `threads` threads.

    Pieces go to whichever thread is free, in ascending order. When pieces fail, no further ones
    begin, and the error of the lowest failing piece is raised: the same for any number of threads.
    Context variables, NumPy's error state among them, hold in the helpers as in the caller.
    """
    workers = min(threads, pieces, MOST_THREADS)
    if workers <= 1:
        for piece in range(pieces):
            function(piece)
        return
    work = _Work(function, pieces)
    pool = _shared_pool()
    helpers: list[Future[None]] = []
    try:
        for _ in range(workers - 1):
            helpers.append(pool.submit(copy_context().run, work.run))
        work.run()
    except BaseException:  # Ctrl-C between two pieces
        work.stop()
        raise
    finally:
        _finish(work, helpers)
    work.raise_failure()


def ranges(count: int, threads: int, grain: int = 1) -> list[tuple[int, int]]:
    """Split 0 .. count into at most `threads` equal ranges of at least `grain` elements, or into one."""
    pieces = max(1, min(threads, MOST_THREADS, count // max(grain, 1)))
    return [(count * piece // pieces, count * (piece + 1) // pieces) for piece in range(pieces)]


def parallel_ranges(
    function: Callable[[int, int, int], Any], bounds: list[tuple[int, int]], threads: int
) -> None:
    """Call function(piece, start, stop) for every range."""
    parallel(lambda piece: function(piece, *bounds[piece]), len(bounds), threads)
