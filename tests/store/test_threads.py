"""Pieces of work on threads."""

import os
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from graphfx.store.threads import parallel, ranges

THREADS = [1, 2, 7]


@pytest.mark.parametrize("threads", THREADS)
@pytest.mark.parametrize("pieces", [0, 1, 2, 1000])
def test_every_piece_runs_once(pieces, threads):
    """Each piece runs exactly once, for any number of threads."""
    seen = []
    parallel(seen.append, pieces, threads)
    assert sorted(seen) == list(range(pieces))


def test_one_thread_is_the_callers():
    """One thread runs all pieces inline, in order."""
    seen = []
    parallel(lambda piece: seen.append((piece, threading.get_ident())), 5, 1)
    assert seen == [(piece, threading.get_ident()) for piece in range(5)]


def test_threads_really_run_at_once():
    """Three pieces that wait for each other finish on three threads."""
    barrier = threading.Barrier(3, timeout=10)
    parallel(lambda piece: barrier.wait(), 3, 3)


def test_no_more_threads_than_asked_for():
    """Never do more than `threads` pieces run at once, whatever the pool has."""
    parallel(lambda piece: time.sleep(0.002), 20, 7)
    lock, running, most = threading.Lock(), 0, 0

    def piece(_):
        nonlocal running, most
        with lock:
            running += 1
            most = max(most, running)
        time.sleep(0.002)
        with lock:
            running -= 1

    parallel(piece, 30, 2)
    assert most == 2


def test_free_thread_takes_next_piece():
    """One slow piece does not hold up the others: they go to whoever is free."""
    others = threading.Event()
    done = []

    def piece(number):
        if number == 0:
            assert others.wait(10)
        done.append(number)
        if len(done) == 9:
            others.set()

    parallel(piece, 10, 2)
    assert done[-1] == 0


@pytest.mark.parametrize("threads", THREADS)
def test_lowest_failure_is_raised(threads):
    """Of several failing pieces the lowest one's error comes out, whichever failed first."""

    def piece(number):
        if number >= 5:
            time.sleep(0.02 if number == 5 else 0)
            raise ValueError(number)

    for _ in range(10):
        with pytest.raises(ValueError, match=r"^5$"):
            parallel(piece, 50, threads)


def test_no_piece_begins_after_a_failure():
    """A failure stops the handing out of pieces, and nothing still runs when it is raised."""
    began, ended = [], []

    def piece(number):
        began.append(number)
        try:
            if number == 3:
                raise ValueError
            time.sleep(0.01)
        finally:
            ended.append(number)

    with pytest.raises(ValueError):
        parallel(piece, 10_000, 2)
    assert sorted(began) == sorted(ended)
    assert len(began) < 10


def test_interrupt_comes_before_errors():
    """Ctrl-C inside a piece is not hidden by a lower piece's error."""
    barrier = threading.Barrier(2, timeout=10)

    def piece(number):
        barrier.wait()
        raise KeyboardInterrupt if number == 1 else ValueError

    with pytest.raises(KeyboardInterrupt):
        parallel(piece, 2, 2)


def test_pieces_may_call_parallel():
    """Nested calls, more of them than threads, neither deadlock nor lose pieces."""
    seen = []
    parallel(lambda outer: parallel(lambda inner: seen.append((outer, inner)), 5, 3), 40, 7)
    assert sorted(seen) == [(outer, inner) for outer in range(40) for inner in range(5)]


def test_nested_calls_need_no_free_thread(monkeypatch):
    """Calls within calls finish even when every thread of the pool is taken: nobody waits for what has not begun."""
    pool = ThreadPoolExecutor(2)
    monkeypatch.setattr("graphfx.store.threads._pool", pool)
    seen = []

    def outer(piece):
        barrier.wait()
        parallel(lambda inner: seen.append((piece, inner)), 4, 3)

    barrier = threading.Barrier(3, timeout=10)
    caller = threading.Thread(target=parallel, args=(outer, 3, 3))
    caller.start()
    caller.join(5)
    stuck = caller.is_alive()
    pool.shutdown(wait=False, cancel_futures=True)
    assert not stuck
    assert len(seen) == 12


def test_many_callers_at_once():
    """Python threads that call at the same time each get all their own pieces."""
    seen = [[] for _ in range(8)]
    callers = [threading.Thread(target=parallel, args=(own.append, 500, 3)) for own in seen]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join(20)
    assert [sorted(own) for own in seen] == [list(range(500))] * 8


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_works_after_fork():
    """A child forked after the pool has started gets threads of its own."""
    parallel(lambda piece: time.sleep(0.002), 8, 4)
    child = os.fork()
    if child == 0:
        try:
            barrier = threading.Barrier(3, timeout=10)
            parallel(lambda piece: barrier.wait(), 3, 3)
            os._exit(0)
        finally:
            os._exit(1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_error_state_holds_in_helpers():
    """NumPy's floating-point error state is the caller's in every thread."""
    barrier = threading.Barrier(2, timeout=10)
    states = []

    def piece(_):
        barrier.wait()
        states.append(np.geterr()["divide"])

    with np.errstate(divide="raise"):
        parallel(piece, 2, 2)
    assert states == ["raise", "raise"]


@pytest.mark.parametrize("count", [0, 1, 6, 7, 8, 1000])
@pytest.mark.parametrize("threads", THREADS)
@pytest.mark.parametrize("grain", [1, 5, 2000])
def test_ranges_cover_exactly(count, threads, grain):
    """Ranges follow each other from 0 to the count, at most one a thread, none shorter than the grain unless alone."""
    bounds = ranges(count, threads, grain)
    assert [number for bound in bounds for number in range(*bound)] == list(range(count))
    assert len(bounds) <= threads
    assert len(bounds) == 1 or min(stop - start for start, stop in bounds) >= grain
