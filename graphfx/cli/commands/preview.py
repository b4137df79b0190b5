"""`graphfx preview`: draw a graph's particles quickly, as lines."""

from __future__ import annotations

import re
from pathlib import Path

import click

from graphfx.cli.commands.cook import Cook
from graphfx.cli.options import debug, library, limits, parameters, threads

SIZE = re.compile(r"(\d{1,5})(?:x(\d{1,5}))?")


def read_size(context: click.Context, parameter: click.Parameter, text: str | None) -> str | None:
    """Return a size as it was typed, unless it is none."""
    found = SIZE.fullmatch(text) if text is not None else None
    if text is not None and (found is None or not all(0 < int(part) <= 65536 for part in found.groups() if part)):
        raise click.BadParameter(f"'{text}' is no size; write 320 for the width, or 320x180; each from 1 to 65536")
    return text


@click.command()
@click.argument("graph")
@click.option("--frames", metavar="SET", help="Frames to draw: 12, 1-48, 1-48x2 or several with commas; all if not given.")
@click.option("--out", metavar="FILE", help="An animation (.webp, .png, .mp4, .mov), out/NAME OF THE GRAPH.webp if not given; "
                                            "with #### in it, a .png for each frame as soon as it is there.")
@click.option("--size", metavar="WIDTH[xHEIGHT]", callback=read_size,
              help="Pixels; as the picture, but 640 wide at most, if not given.")
@parameters
@threads
@library
@limits
@click.option("--json", "as_json", is_flag=True, help="Print a line of JSON for each frame, and one at the end.")
@debug
@click.pass_context
def command(context: click.Context, graph: str, frames: str | None, out: str | None, size: str | None,
            parameters: dict[str, str], threads: int | None, library: tuple[str, ...], limits: dict[str, int],
            as_json: bool) -> None:
    """Draw GRAPH quickly, its particles as lines.

    Its first image is drawn small, each particle a line from head to tail in its colour, not sorted by depth. A graph
    without an image is seen by a camera that holds all particles.
    """
    from graphfx.lanes.host import use_wide_registers

    use_wide_registers()
    from graphfx.cook.effect import Effect
    from graphfx.cook.frames import parse_frames
    from graphfx.cook.limits import CookLimits
    from graphfx.cook.preview import camera_placed, is_placed, preview_of
    from graphfx.graph.flatten import flatten
    from graphfx.node import Library, library_roots
    from graphfx.store.threads import available_threads

    known = Library(library_roots(library))
    flat = flatten(graph, known, parameters)
    file = Path("out", f"{flat.name}.webp") if out is None else Path(out)
    asked = SIZE.fullmatch(size) if size is not None else None
    shown = preview_of(flat, known, file.name, (int(asked[1]), int(asked[2]) if asked[2] else None) if asked else None)
    effect = Effect(shown)
    wanted = parse_frames(frames, effect.frames[0], effect.frames[-1]) if frames is not None else effect.frames
    cook = Cook(effect, wanted, file.parent, threads, CookLimits(**limits), as_json)
    cook.check()
    with cook.telling(context, ["preview", graph, "--out", str(file)]):
        if not is_placed(flat):
            cook.effect = Effect(camera_placed(shown, wanted, threads or available_threads()))
            click.echo("the graph has no image: its particles are seen by a camera that holds them all", err=True)
        cook.run()
