"""`graphfx study`: what accuracy costs in a graph."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphfx.cli.options import debug, library, parameters
from graphfx.cli.stopping import say
from graphfx.errors import EXIT_INTERRUPTED, UsageError

if TYPE_CHECKING:
    from graphfx.study.study import Study


@click.command()
@click.argument("graph", required=False)
@click.option("--particles", type=click.IntRange(1, 1_000_000), metavar="N", default=1000, show_default=True,
              help="Births of each emitter to follow, with their children.")
@click.option("--frames", metavar="SET", help="Frames to compare: 12, 1-48, 1-48x2 or several; 24 of all if not given.")
@click.option("--seconds", type=click.FloatRange(1), metavar="S", default=60.0, show_default=True,
              help="Processor time after which no more settings are tried, nor runs repeated.")
@click.option("--out", metavar="DIR", help="Folder for study.html and study.json; out/NAME OF THE GRAPH if not given.")
@click.option("--pictures", is_flag=True, help="Compare pictures of the last frame too; all particles are simulated for them.")
@click.option("--png", is_flag=True, help="Write the plots as study.png too; needs the extra `study`.")
@parameters
@library
@click.option("--json", "as_json", is_flag=True, help="Print JSON; files are written only with --out.")
@click.option("--fields", is_flag=True, help="Say what each field of the JSON means.")
@click.option("--stability", is_flag=True, help="Try every operator at the ends of its ranges instead; no GRAPH.")
@debug
@click.pass_context
def command(context: click.Context, graph: str | None, particles: int, frames: str | None, seconds: float, out: str | None,
            pictures: bool, png: bool, parameters: dict[str, str], library: tuple[str, ...], as_json: bool,
            fields: bool, stability: bool) -> None:
    """Measure what each method makes of GRAPH, and what it costs.

    Some of its particles run under every method that can carry them, with many steps and tolerances, in 32 and 64 bits.
    Where they should be is found by two references of different orders; the setting that keeps the graph's tolerance
    with the fewest force evaluations is recommended. A table, a page with plots, and JSON tell the rest.

    With --stability every operator, alone and in pairs, goes steps of 1e-12 to 1e6 s with its parameters at the ends of
    their ranges: what comes out is finite, or told. That takes some minutes.
    """
    if fields:
        _say_fields(stability)
        return
    if stability:
        if graph is not None:
            raise UsageError("study: --stability takes no GRAPH: it tries the operators of the library")
        _try_operators(context, library, out, as_json)
        return
    if graph is None:
        raise UsageError("study: GRAPH is missing\n  'graphfx study --help' says what it takes")
    if png:
        from graphfx.study.picture import need_matplotlib

        need_matplotlib()
    study = _make(graph, parameters, library, particles, frames, seconds, pictures, as_json)
    folder = Path(out) if out is not None else None if as_json else Path("out") / study.flat.name
    files = _write(study, folder, png) if folder is not None else []
    if as_json:
        from graphfx.study.data import study_data

        click.echo(json.dumps(study_data(study)))
    else:
        from graphfx.cli.study_table import show_study

        show_study(study)
        click.echo(f"wrote {', '.join(map(str, files))}")
    if study.stopped:
        say("stopped; what was measured before is kept")
        context.exit(EXIT_INTERRUPTED)


def _make(graph: str, parameters: dict[str, str], library: tuple[str, ...], particles: int, frames: str | None,
          seconds: float, pictures: bool, quiet: bool) -> Study:
    """Study a graph; one without a picture is studied as its preview."""
    from graphfx.lanes.host import use_wide_registers

    use_wide_registers()
    from graphfx.cook.frames import parse_frames
    from graphfx.cook.preview import is_placed, preview_of
    from graphfx.graph.flatten import flatten
    from graphfx.node import Library, library_roots
    from graphfx.study.recommend import compare_pictures
    from graphfx.study.study import Maker

    known = Library(library_roots(library))
    flat = flatten(graph, known, parameters)
    if not is_placed(flat):
        flat = preview_of(flat, known, "study.webp")
    wanted = parse_frames(frames, flat.time.first, flat.time.last) if frames is not None else None
    with Telling(quiet=quiet) as telling:
        study = Maker(flat, particles, wanted, seconds, tell=telling.tell).make()
        if pictures and not study.stopped and study.own is not None:
            telling.tell("pictures", 1.0)
            compare_pictures(study)
    return study


def _try_operators(context: click.Context, library: tuple[str, ...], out: str | None, as_json: bool) -> None:
    """Try every operator, and tell what came out."""
    from graphfx.node import Library, library_roots
    from graphfx.study.stability import stability
    from graphfx.study.stability_page import lines, stability_data, stability_page

    with Telling(quiet=as_json) as telling:
        found = stability(Library(library_roots(library)), telling.tell)
    data = json.dumps(stability_data(found), indent=None if as_json else 2)
    folder = Path(out) if out is not None else None if as_json else Path("out")
    files = _files(folder, {"stability.html": stability_page(found), "stability.json": data + "\n"}) if folder is not None else []
    if as_json:
        click.echo(data)
    else:
        for line in (*lines(found), f"wrote {', '.join(map(str, files))}"):
            click.echo(line)
    if found.stopped:
        say("stopped; what was tried before is kept")
        context.exit(EXIT_INTERRUPTED)


def _say_fields(stability: bool) -> None:
    if stability:
        from graphfx.study.stability_page import FIELDS
    else:
        from graphfx.study.data import FIELDS

    width = max(map(len, FIELDS))
    for name, meaning in FIELDS.items():
        click.echo(f"{name:<{width}}  {meaning}")


def _write(study: Study, folder: Path, png: bool) -> list[Path]:
    """Write the page and the data, and the plots as a picture where that is wanted; return the files."""
    from graphfx.study.data import study_data
    from graphfx.study.page import page

    contents: dict[str, str | bytes] = {"study.html": page(study), "study.json": json.dumps(study_data(study), indent=2) + "\n"}
    if png:
        from graphfx.study.picture import picture

        contents["study.png"] = picture(study)
    return _files(folder, contents)


def _files(folder: Path, contents: Mapping[str, str | bytes]) -> list[Path]:
    """Write files of some contents; return them."""
    from graphfx.output.atomic import make_folder, whole_file

    make_folder(folder / "file")
    for name, content in contents.items():
        with whole_file(folder / name) as stream:
            stream.write(content.encode() if isinstance(content, str) else content)
    return [folder / name for name in contents]


class Telling:
    """Tells what a study does: a line that moves on a terminal, plain lines elsewhere, nothing where it is to be quiet."""

    def __init__(self, quiet: bool = False) -> None:
        """Begin with nothing said."""
        self.quiet, self.said = quiet, ""
        self.terminal = sys.stderr.isatty()

    def __enter__(self) -> Telling:
        """Begin."""
        return self

    def __exit__(self, *_: object) -> None:
        """Take the line that moves away."""
        if self.terminal and not self.quiet:
            click.echo("\r\033[K", nl=False, err=True)

    def tell(self, what: str, share: float) -> None:
        """Tell what is done now; `share` is how much of all is done."""
        if self.quiet:
            return
        if self.terminal:
            click.echo(f"\r\033[K{share:4.0%}  {what}"[:100], nl=False, err=True)
        elif (stage := what.partition(":")[0]) != self.said:
            self.said = stage
            click.echo(stage, err=True)
