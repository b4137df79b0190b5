"""`graphfx cook`: carry a graph out and write its frames."""

from __future__ import annotations

import json
import shlex
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from graphfx.cli.options import debug, library, limits, parameters, threads
from graphfx.cli.progress import in_words, progress_for
from graphfx.cli.stopping import exit_code, say
from graphfx.errors import OutputError

if TYPE_CHECKING:
    from graphfx.cook.effect import Effect, FrameReport
    from graphfx.cook.limits import CookLimits


@click.command()
@click.argument("graph")
@click.option("--frames", metavar="SET", help="Frames to write: 12, 1-48, 1-48x2 or several with commas; all if not given.")
@click.option("--out", metavar="DIR", help="Folder for the files, made if missing; out/NAME OF THE GRAPH if not given.")
@parameters
@threads
@library
@limits
@click.option("--dry-run", is_flag=True, help="Say what would be written, and write nothing.")
@click.option("--json", "as_json", is_flag=True, help="Print a line of JSON for each frame, and one at the end.")
@debug
@click.pass_context
def command(context: click.Context, graph: str, frames: str | None, out: str | None, parameters: dict[str, str],
            threads: int | None, library: tuple[str, ...], limits: dict[str, int], dry_run: bool, as_json: bool) -> None:
    """Simulate GRAPH and write its frames."""
    from graphfx.lanes.host import use_wide_registers

    use_wide_registers()
    from graphfx.cook.effect import load
    from graphfx.cook.frames import parse_frames
    from graphfx.cook.limits import CookLimits

    effect = load(graph, library, parameters)
    wanted = parse_frames(frames, effect.frames[0], effect.frames[-1]) if frames is not None else effect.frames
    folder = Path("out") / effect.flat.name if out is None else Path(out)
    cook = Cook(effect, wanted, folder, threads, CookLimits(**limits), as_json)
    if dry_run:
        cook.tell()
        return
    with cook.telling(context, ["cook", graph, "--out", str(cook.out)]):
        cook.run()


def typed(context: click.Context) -> list[str]:
    """Return the options of a cook as they would be typed again, without the frames and the folder."""
    again: list[str] = []
    for option in context.command.params:
        value: Any = context.params.get(option.name or "")
        if option.name == "parameters":
            again += [part for name, given in value.items() for part in ("--set", f"{name}={given}")]
        elif option.name == "library":
            again += [part for folder in value for part in ("--library", folder)]
        elif option.name == "size" and value is not None:
            again += ["--size", "x".join(str(part) for part in value if part is not None)]
        elif option.name == "threads" and value is not None:
            again += ["--threads", str(value)]
    for name, limit in context.params.get("limits", {}).items():
        again += ["--memory" if name == "memory" else f"--limit-{name}", str(limit)]
    return again


def ready(out: Path) -> None:
    """Make the folder for the files, and see that one can be written there before any work is done."""
    try:
        out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=out):
            pass
    except OSError as error:
        in_the_way = "it is a file" if out.is_file() else "a file is in its way"
        cause = in_the_way if isinstance(error, (FileExistsError, NotADirectoryError)) else error.strerror
        raise OutputError(f"nothing can be written in {out}: {cause}; choose another folder with --out") from error


@dataclass
class Cook:
    """One cook, and what is told of it."""

    effect: Effect
    frames: list[int]
    out: Path
    threads: int | None
    limits: CookLimits
    as_json: bool
    kind: str = "movie"
    """What a file of many frames is called."""
    done: list[int] = field(default_factory=list)
    faults: dict[tuple[str, str], tuple[int, int]] = field(default_factory=dict)
    """Of each stream and attribute that was not finite the first frame of that, and how often it was seen."""
    restless: int = 0
    failed: int = 0
    warnings: list[str] = field(default_factory=list)
    begun: bool = False

    def check(self) -> None:
        """Refuse what would pass a limit, or could not be written, before even the folder is made."""
        from graphfx.cook.files import check_files
        from graphfx.cook.limits import check_disk, check_limits

        check_limits(self.effect.draft, self.limits)
        check_files(self.effect.draft, self.out, self.frames)
        check_disk(self.effect.draft, self.out, self.frames, self.limits)

    def run(self) -> None:
        """Cook all frames; say what was made."""
        from graphfx.cook.movies import movie_file
        from graphfx.lanes.cache import listeners

        self.check()
        ready(self.out)
        self.begun = True
        started = time.monotonic()
        with progress_for(len(self.frames), terminal=sys.stderr.isatty(), quiet=self.as_json) as progress:

            def report(frame: FrameReport) -> None:
                self.done.append(frame.frame)
                for stream, attribute, count in frame.faults:
                    first, before = self.faults.get((stream, attribute), (frame.frame, 0))
                    self.faults[stream, attribute] = first, before + count
                self.restless, self.failed = frame.restless, frame.failed
                told = [str(warning) for warning in frame.warnings]
                self.warnings += told
                progress.frame(frame)
                if self.as_json:
                    self._print({"frame": frame.frame, "particles": frame.particles, "fragments": frame.fragments,
                                 "dropped": frame.dropped, "restless": frame.restless, "failed": frame.failed, "lost": frame.lost,
                                 "files": list(map(str, frame.files)), **({"warnings": told} if told else {})})

            listeners.append(progress.compiling)
            try:
                files = self.effect.cook(self.out, self.frames, self.threads, report, self.limits)
            finally:
                listeners.remove(progress.compiling)
        seconds = time.monotonic() - started
        self._warn()
        if self.as_json:
            self._print({"frames": len(self.done), "files": len(files), "seconds": round(seconds, 3)})
        else:
            movies = [str(movie_file(movie, self.effect.flat.name, self.out)) for movie in self.effect.draft.movies]
            stills = len(files) - len(movies)
            told = [*([f"{counted(stills, 'file')} in {self.out}"] if stills else []), *movies]
            click.echo(f"wrote {', '.join(told)} ({in_words(seconds)})")

    def _warn(self) -> None:
        """Tell of particles that the pictures do not show as they should."""
        for warning in () if self.as_json else self.warnings:
            click.echo(f"warning: {warning}", err=True)
        for (stream, attribute), (first, count) in self.faults.items():
            whose = f"a particle of {stream}: its {attribute}" if stream else f"a triangle: one of its {attribute}"
            click.echo(f"{count:,} times {whose} is not finite, and it was not drawn, first in frame {first}; "
                       "look in what gives it for a division by 0, a root or a logarithm of what is less than 0, or what grows "
                       "without end", err=True)
        if self.restless:
            click.echo(f"{self.restless:,} times a particle had too many contacts in one step, and was laid to rest", err=True)
        if self.failed:
            told = ("could not go on to the end of a frame: no step was short enough; soften what pulls it or holds it back, or "
                    "see graphfx study")
            click.echo(f"{self.failed:,} times a particle {told}", err=True)

    def tell(self) -> None:
        """Say what would be written."""
        from graphfx.cook.files import file_name
        from graphfx.cook.frames import frames_text
        from graphfx.cook.movies import movie_file

        self.check()
        images = [{"node": image.node.path, "size": [int(number) for number in image.value("size")],
                   "files": [str(self.out / file_name(str(image.value("file")), self.effect.flat.name, frame))
                             for frame in self.frames]} for image in self.effect.draft.stills]
        movies = [{"node": movie.node.path, "size": [int(number) for number in movie.image.value("size")],
                   "files": [str(movie_file(movie, self.effect.flat.name, self.out))]} for movie in self.effect.draft.movies]
        if self.as_json:
            self._print({"frames": self.frames, "images": images, **({"movies": movies} if movies else {})})
            return
        click.echo(f"would write frames {frames_text(self.frames)}: {counted(len(self.frames), 'frame')}")
        for image in (*images, *movies):
            files = image["files"]
            last = f" to {files[-1]}" if len(files) > 1 else ""
            click.echo(f"  {image['node']}: {image['size'][0]} x {image['size'][1]}, {files[0]}{last}")

    @contextmanager
    def telling(self, context: click.Context, again: list[str]) -> Iterator[None]:
        """Where what is done in the block ends before its time, say what is left and how one goes on."""
        again = ["graphfx", *again, *typed(context)]
        try:
            yield
        except KeyboardInterrupt as stop:
            say("\n  ".join(self.how_to_go_on(again)))
            context.exit(exit_code(stop))
        except OutputError as error:
            if not self.begun:
                raise
            *others, last = error.problems
            raise OutputError([*others, replace(last, notes=(*last.notes, *self.how_to_go_on(again)))]) from error

    def how_to_go_on(self, again: list[str]) -> tuple[str, str]:
        """Return what is left when a cook stops early, and the command for it."""
        from graphfx.cook.frames import frames_text

        movies = self.effect.draft.movies
        left = [frame for frame in self.frames if movies or frame not in set(self.done)]
        made = f"after frame {self.done[-1]}; all files in {self.out} are whole" if self.done else "before any file was written"
        if movies:
            made += f"; no {self.kind} is written, as it needs all of its {counted(len(self.frames), 'frame')}"
        command = shlex.join([*again, "--frames", frames_text(left)])
        return f"stopped {made}. To {'begin again' if movies else 'go on'}:", command

    @staticmethod
    def _print(data: dict[str, Any]) -> None:
        click.echo(json.dumps(data))
        sys.stdout.flush()


def counted(number: int, noun: str) -> str:
    """Return a number with its noun: `1 frame`, `2 frames`."""
    return f"{number:,} {noun}{'' if number == 1 else 's'}"
