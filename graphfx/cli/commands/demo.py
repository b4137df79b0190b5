"""`graphfx demo`: the effects and the pages of test pictures that come with graphfx."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphfx.cli.commands.cook import Cook, ready
from graphfx.cli.failure import from_here
from graphfx.cli.options import Size, debug, library, size, threads
from graphfx.cli.progress import in_words
from graphfx.errors import UsageError, suggestion

if TYPE_CHECKING:
    from graphfx.node import Library


@click.command()
@click.argument("name", required=False)
@click.option("--out", metavar="DIR", help="Folder for the files, made if missing; out/demo if not given.")
@click.option("--frames", metavar="SET", help="Frames of an effect: 12, 1-48, 1-48x2 or several with commas; all if not given.")
@size
@threads
@library
@debug
@click.pass_context
def command(context: click.Context, name: str | None, out: str | None, frames: str | None, size: Size | None,
            threads: int | None, library: tuple[str, ...]) -> None:
    """Show what comes with graphfx.

    An effect is cooked small, as one animation; a page of test pictures is drawn as one sheet and as HTML. Without a
    NAME it lists what there is.
    """
    from graphfx.lanes.host import use_wide_registers

    use_wide_registers()
    from graphfx.node import Library, library_roots

    known = Library(library_roots(library))
    graphs = [root / "graphs" for root in reversed(known.roots)]
    effects = {file.stem: file for folder in graphs for file in sorted((folder / "effects").glob("*.json"))}
    pages = {page.name: page for folder in graphs for page in sorted((folder / "demos").glob("*/"))}
    if name is None:
        _list(effects, pages)
    elif name in effects:
        folder = Path("out", "demo") if out is None else Path(out)
        _cook(context, known, effects[name], folder, frames, size, threads)
    elif name in pages:
        folder = Path("out", "demo", name) if out is None else Path(out)
        _draw(f"graphfx: {name}", pages[name], known, folder, threads)
    else:
        raise UsageError(f"there is no demo '{name}'.{suggestion(name, [*effects, *pages])} 'graphfx demo' lists what there is")


def _list(effects: dict[str, Path], pages: dict[str, Path]) -> None:
    """Print what there is, a line each."""
    from graphfx.cook.demo import demos_in, said

    width = max(map(len, (*effects, *pages)))
    click.echo("effects")
    for name, file in effects.items():
        click.echo(f"  {name:{width}}  {said(file)}")
    click.echo("pages of test pictures")
    for name, folder in pages.items():
        click.echo(f"  {name:{width}}  {', '.join(demo.title.lower() for demo in demos_in(folder))}")
    click.echo("'graphfx demo NAME' cooks one, small")


def _cook(context: click.Context, known: Library, file: Path, out: Path, frames: str | None, size: Size | None,
          threads: int | None) -> None:
    """Cook an effect small, as one animation."""
    from graphfx.cook.effect import Effect
    from graphfx.cook.frames import parse_frames
    from graphfx.cook.limits import CookLimits
    from graphfx.cook.preview import preview_of
    from graphfx.graph.flatten import flatten

    effect = Effect(preview_of(flatten(file, known), known, f"{file.stem}.webp", size, "image"))
    wanted = parse_frames(frames, effect.frames[0], effect.frames[-1]) if frames is not None else effect.frames
    cook = Cook(effect, wanted, out, threads, CookLimits(), False)
    again = ["demo", file.stem, "--out", str(out)]
    with cook.telling(context, again):
        cook.run()
    click.echo(f"'graphfx cook {from_here(str(file))}' cooks it whole, 'graphfx preview' draws it quickly")


def _draw(title: str, graphs: Path, known: Library, out: Path, threads: int | None) -> None:
    """Draw a page of test pictures."""
    from graphfx.cook.demo import Demo, demos_in, make_page
    from graphfx.store.threads import available_threads

    started, demos = time.monotonic(), demos_in(graphs)

    def report(demo: Demo) -> None:
        click.echo(f"drawing {demo.name} ({demos.index(demo) + 1} of {len(demos)})", err=True)

    ready(out)
    files = make_page(title, demos, known, out, threads or available_threads(), report)
    click.echo(f"wrote {', '.join(map(str, files))} ({in_words(time.monotonic() - started)})")
