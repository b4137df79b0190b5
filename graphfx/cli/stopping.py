"""Signals that ask the command to stop: as Ctrl-C, so that whatever is being written is cleaned away."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import Any

import click

from graphfx.errors import EXIT_INTERRUPTED

SIGNALS = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]
"""Besides SIGINT, which Python makes a KeyboardInterrupt of."""
ONCE = 1.0
"""Seconds for which more of them are taken for the same: `timeout` and shells tell a process and then its group."""


class Stopped(KeyboardInterrupt):
    """A signal asked the command to stop; its exit code is that of a shell, 128 + the signal's number."""

    def __init__(self, number: int):
        """Keep the signal's number."""
        super().__init__(number)
        self.exit_code = 128 + number


@contextmanager
def stoppable() -> Iterator[None]:
    """Raise `Stopped` in the block for every signal of `SIGNALS` that is not ignored; only the main thread can."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    last = -ONCE

    def stop(number: int, _: FrameType | None) -> None:
        nonlocal last
        now = time.monotonic()
        if now - last >= ONCE:
            last = now
            raise Stopped(number)

    former: dict[int, Any] = {number: signal.getsignal(number) for number in SIGNALS}
    taken = [number for number, handler in former.items() if handler is signal.SIG_DFL]
    for number in taken:
        signal.signal(number, stop)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, former[number])


def exit_code(stop: BaseException) -> int:
    """Return the exit code of a command that was stopped."""
    return stop.exit_code if isinstance(stop, Stopped) else EXIT_INTERRUPTED


def say(text: str) -> None:
    """Print why the command stops, if the terminal is still there."""
    with suppress(OSError):
        click.echo(text, err=True)
