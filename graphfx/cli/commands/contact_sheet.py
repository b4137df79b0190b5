"""`graphfx contact-sheet`: frames of a graph, or pictures that are there, side by side in one PNG."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from graphfx.cli.commands.cook import Cook, ready
from graphfx.cli.options import Size, debug, library, parameters, sized, threads
from graphfx.cli.progress import in_words
from graphfx.errors import UsageError

if TYPE_CHECKING:
    from graphfx.cook.effect import Effect
    from graphfx.graph.flat import FlatGraph

FRAMES = 16
"""Frames that are shown, unless others are asked for."""
WIDEST = 320
"""Pixels that each is wide at most, unless another size is asked for."""


@click.command()
@click.argument("source", metavar="GRAPH")
@click.option("--frames", metavar="SET", help="Frames to show: 12, 1-48x4 or several with commas; if not given, "
                                              f"{FRAMES} evenly spread from the first to the last.")
@click.option("--columns", type=click.IntRange(1, 1000), metavar="N",
              help="Pictures in a row; about as many as rows, if not given.")
@click.option("--out", metavar="FILE", help="A .png; out/NAME OF THE GRAPH.contact-sheet.png if not given.")
@sized(WIDEST)
@parameters
@threads
@library
@debug
@click.pass_context
def command(context: click.Context, source: str, frames: str | None, columns: int | None, out: str | None, size: Size | None,
            parameters: dict[str, str], threads: int | None, library: tuple[str, ...]) -> None:
    """Put frames of GRAPH on one sheet, with their numbers.

    Its first image is cooked small; a graph without an image is drawn as by preview. GRAPH may also be a folder of
    pictures, or an animation (.webp, .png), that was cooked already.
    """
    from graphfx.cook.cooked import is_cooked

    if is_cooked(source):
        for option, given in (("--set", parameters), ("--threads", threads), ("--library", library)):
            if given:
                raise UsageError(f"{option} is for graphs, and {source} was cooked already; leave it out")
        _gather(source, frames, columns, out, size)
        return
    from graphfx.lanes.host import use_wide_registers

    use_wide_registers()
    from graphfx.cook.frames import parse_frames, spread
    from graphfx.cook.limits import CookLimits
    from graphfx.cook.preview import camera_placed, is_placed, preview_of
    from graphfx.graph.flatten import flatten
    from graphfx.node import Library, library_roots
    from graphfx.output.contact_sheet import columns_for, sheet_size
    from graphfx.store.threads import available_threads

    known = Library(library_roots(library))
    flat = flatten(source, known, parameters)
    file = _file(out, flat.name)
    placed = is_placed(flat)
    shown = preview_of(flat, known, file.name, size, "image" if placed else "preview", WIDEST)
    every = range(shown.time.first, shown.time.last + 1)
    wanted = spread(every, FRAMES) if frames is None else parse_frames(frames, every[0], every[-1])
    columns = columns or columns_for(len(wanted))
    effect = _effect(shown, wanted, columns)
    sheet_size(len(wanted), columns, *effect.draft.images[0].size)
    cook = Cook(effect, wanted, file.parent, threads, CookLimits(), False, "contact sheet")
    cook.check()
    with cook.telling(context, ["contact-sheet", source, "--out", str(file), "--columns", str(columns)]):
        if not placed:
            cook.effect = camera_placed(effect, wanted, threads or available_threads())
        cook.run()


def _file(out: str | None, name: str) -> Path:
    """Return the sheet's file; raise UsageError for one that cannot be."""
    file = Path("out", f"{name}.contact-sheet.png") if out is None else Path(out)
    if file.suffix.lower() != ".png":
        raise UsageError(f"--out: a contact sheet is a PNG, and '{out}' ends otherwise; let the name end in .png")
    if "#" in file.name:
        raise UsageError(f"--out: a contact sheet is one file for all frames; leave # out of '{out}'")
    return file


def _effect(shown: FlatGraph, frames: Sequence[int], columns: int) -> Effect:
    """Return what is cooked: its movie is the sheet."""
    from graphfx.cook.effect import Effect
    from graphfx.output.contact_sheet import contact_sheet

    labels = [str(frame) for frame in frames]
    return Effect(shown, {".png": lambda file, fps, quality, alpha: contact_sheet(file, labels, columns)})


def _gather(source: str, frames: str | None, columns: int | None, out: str | None, size: Size | None) -> None:
    """Put pictures that were cooked already on a sheet."""
    from graphfx.cook.cooked import find_cooked
    from graphfx.cook.frames import spread
    from graphfx.output.contact_sheet import columns_for, contact_sheet, sheet_size

    started = time.monotonic()
    cooked = find_cooked(source)
    file = _file(out, Path(source).resolve().stem)
    wanted = spread(cooked.frames, FRAMES) if frames is None else cooked.chosen(frames)
    columns = columns or columns_for(len(wanted))
    each = cooked.size(size, WIDEST)
    sheet_size(len(wanted), columns, *each)
    ready(file.parent)
    with contact_sheet(file, [cooked.labels[frame] for frame in wanted], columns) as add:
        for picture in cooked.small(wanted, each):
            add(picture)
    click.echo(f"wrote {file} ({in_words(time.monotonic() - started)})")
