"""`graphfx preview`: draw a graph's particles quickly, as lines."""

from __future__ import annotations

from pathlib import Path

import click

from graphfx.cli.commands.cook import Cook
from graphfx.cli.options import Size, debug, library, limits, parameters, size, threads


@click.command()
@click.argument("graph")
@click.option("--frames", metavar="SET", help="Frames to draw: 12, 1-48, 1-48x2 or several with commas; all if not given.")
@click.option("--out", metavar="FILE", help="An animation (.webp, .png, .mp4, .mov), out/NAME OF THE GRAPH.webp if not given; "
                                            "with #### in it, a .png for each frame as soon as it is there.")
@size
@parameters
@threads
@library
@limits
@click.option("--json", "as_json", is_flag=True, help="Print a line of JSON for each frame, and one at the end.")
@debug
@click.pass_context
def command(context: click.Context, graph: str, frames: str | None, out: str | None, size: Size | None,
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
    shown = preview_of(flat, known, file.name, size)
    effect = Effect(shown)
    wanted = parse_frames(frames, effect.frames[0], effect.frames[-1]) if frames is not None else effect.frames
    cook = Cook(effect, wanted, file.parent, threads, CookLimits(**limits), as_json)
    cook.check()
    with cook.telling(context, ["preview", graph, "--out", str(file)]):
        if not is_placed(flat):
            cook.effect = camera_placed(effect, wanted, threads or available_threads())
            click.echo("the graph has no image: its particles are seen by a camera that holds them all", err=True)
        cook.run()
