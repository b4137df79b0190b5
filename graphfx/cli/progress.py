"""Tell how a cook goes: a moving bar on a terminal, plain lines elsewhere, always on stderr."""

from __future__ import annotations

import time
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Protocol

import click

if TYPE_CHECKING:
    from graphfx.cook.effect import FrameReport


class Progress(AbstractContextManager["Progress"], Protocol):
    """What a cook reports to."""

    def compiling(self, name: str) -> None:
        """Tell that something is compiled, which happens once on a machine."""

    def frame(self, report: FrameReport) -> None:
        """Tell that a frame is written."""


def progress_for(frames: int, *, terminal: bool, quiet: bool = False) -> Progress:
    """Return how to report a cook of so many frames."""
    if quiet:
        return Silence()
    return Bar(frames) if terminal else Lines(frames)


def short_name(name: str) -> str:
    """Return what compiled code is called for: `vortex` for `kernel.vortex`."""
    return name.rpartition(".")[2].lstrip("_")


def in_words(seconds: float) -> str:
    """Return a time to wait: `3 s`, `2 min 5 s`, `1 h 4 min`."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


class Silence(Progress):
    """Report nothing."""

    def compiling(self, name: str) -> None:
        """Say nothing."""

    def frame(self, report: FrameReport) -> None:
        """Say nothing."""

    def __exit__(self, *_: object) -> None:
        """End."""


class Lines(Progress):
    """A line for each frame, for logs."""

    def __init__(self, frames: int) -> None:
        """Begin."""
        self.frames = frames
        self.done = 0
        self.first = 0.0

    def __exit__(self, *_: object) -> None:
        """End."""

    def compiling(self, name: str) -> None:
        """Print what is compiled."""
        click.echo(f"compiling {short_name(name)} (first time only)", err=True)

    def frame(self, report: FrameReport) -> None:
        """Print a frame, and how long the others may take."""
        self.done += 1
        click.echo(f"frame {report.frame} ({self.done} of {self.frames}): {report.particles:,} particles, "
                   f"{report.fragments:,} fragments{self._left()}", err=True)

    def _left(self) -> str:
        """Return how long the other frames may take, as the ones after the first did: that one waits for compilations."""
        now = time.monotonic()
        if self.done == 1:
            self.first = now
        if self.done == 1 or self.done == self.frames:
            return ""
        return f", {in_words((now - self.first) / (self.done - 1) * (self.frames - self.done))} left"


class Bar(Progress):
    """One line that moves."""

    def __init__(self, frames: int) -> None:
        """Make the line."""
        from rich.console import Console
        from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
        from rich.progress import Progress as RichProgress

        self.bar = RichProgress(TextColumn("frame {task.fields[frame]}"), BarColumn(bar_width=None), MofNCompleteColumn(),
                                TextColumn("{task.description}"), TimeRemainingColumn(), console=Console(stderr=True))
        self.task = self.bar.add_task("simulating", total=frames, frame="")

    def __enter__(self) -> Bar:
        """Show the line."""
        self.bar.start()
        return self

    def __exit__(self, *_: object) -> None:
        """Leave the line as it is."""
        self.bar.stop()

    def compiling(self, name: str) -> None:
        """Show what is compiled."""
        self.bar.update(self.task, description=f"compiling {short_name(name)} (first time only)")

    def frame(self, report: FrameReport) -> None:
        """Move on by a frame."""
        said = f"{report.particles:,} particles, {report.fragments:,} fragments"
        self.bar.update(self.task, advance=1, frame=report.frame, description=said)
