"""The gallery: `python tests/effects/gallery.py [NAME ...]` makes the pictures in graphs/gallery, and the README's part.

Of each effect a poster, the frame that its graph names in `x-poster`, as large as its image; and an animation of every second
frame around it, small: each picture is drawn at twice its size and reduced. Both come from one simulation. `--text` writes the
README's part alone.
"""

from __future__ import annotations

import argparse
import io
import sys
import time
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np
from PIL import Image

from graphfx.cook.demo import at_size
from graphfx.cook.effect import Effect
from graphfx.cook.writing import Writer
from graphfx.graph.flatten import flatten
from graphfx.lanes.host import use_wide_registers
from graphfx.output.atomic import whole_file
from graphfx.store.threads import available_threads
from tests.effects.goldens import EFFECTS, LIBRARY, data_of
from tests.marked import with_part

ROOT = Path(__file__).parents[2]
GALLERY = ROOT / "graphs" / "gallery"
README = ROOT / "README.md"
SUFFIXES = (".jpg", ".webp")
WIDE = 320
"""Pixels that an animation is wide."""
STEP = 2
"""Of the frames every second one is in an animation."""
LENGTHS = (60, 48, 36)
"""How many pictures an animation may have, the best first."""
HEAVIEST = 700_000
"""Bytes that an animation may take."""
QUALITIES, LEAST_QUALITIES = (80, 65, 50), (40, 30, 20, 10)
"""Of an animation; the first that makes it light enough is taken, the least only where it is as short as may be."""
POSTER_QUALITY = 90
COLUMNS = 2
"""Effects side by side in the README."""


def window(first: int, last: int, poster: int, pictures: int) -> list[int]:
    """Return the frames of an animation, so many or as many as there are, the poster's about in their middle."""
    length = STEP * (pictures - 1) + 1
    begin = max(min(poster - length // 2, last - length + 1), first)
    return list(range(begin, min(begin + length, last + 1), STEP))


def draw(name: str) -> tuple[np.ndarray, dict[int, Image.Image], float]:
    """Return an effect's poster, pictures for its animation by frame, and how many of these are shown in a second."""
    whole = flatten(EFFECTS[name], LIBRARY)
    poster = data_of(name)["x-poster"]
    image = Effect(whole).draft.images[0]
    small = at_size(whole, 2 * WIDE / image.size[0]).nodes[image.node.path]
    effect = Effect(replace(whole, nodes=whole.nodes | {"(small)": replace(small, path="(small)")}))
    threads = available_threads()
    simulation, writer = effect.simulation(threads), Writer(effect.plan, threads)
    images = {each.node.path: each for each in effect.plan.images}
    large, reduced = images[image.node.path], images["(small)"]
    frames = {frame for most in LENGTHS for frame in window(effect.frames[0], effect.frames[-1], poster, most)}
    still, pictures = None, {}
    for frame in simulation.frames(max(*frames, poster)):
        if frame in frames:
            drawn = Image.fromarray(writer.displayed(reduced, writer.draw(None, reduced, simulation, frame), frame))
            pictures[frame] = drawn.reduce(2)
        if frame == poster:
            still = writer.displayed(large, writer.draw(None, large, simulation, frame), frame)
    assert still is not None
    return still, pictures, whole.time.fps / STEP


def animation(name: str, pictures: dict[int, Image.Image], rate: float) -> tuple[bytes, str]:
    """Return an animated WebP, as long and as good as it can be without being too large, and what it is."""
    data = data_of(name)
    tries = [(most, quality) for most in LENGTHS for quality in QUALITIES] + [(LENGTHS[-1], low) for low in LEAST_QUALITIES]
    for most, quality in tries:
        shown = [pictures[frame] for frame in window(*data["time"]["frames"], data["x-poster"], most)]
        made = io.BytesIO()
        shown[0].save(made, "WEBP", save_all=True, append_images=shown[1:], duration=round(1000 / rate), loop=0,
                      quality=quality, method=4)
        if made.tell() <= HEAVIEST:
            break
    return made.getvalue(), f"{len(shown)} pictures, {len(shown) / rate:.1f} s, quality {quality}"


def make(name: str) -> None:
    """Make the files of an effect, and say what they are."""
    begun = time.monotonic()
    still, pictures, rate = draw(name)
    poster = io.BytesIO()
    Image.fromarray(still).save(poster, "JPEG", quality=POSTER_QUALITY, optimize=True)
    moving, told = animation(name, pictures, rate)
    GALLERY.mkdir(exist_ok=True)
    for suffix, content in zip(SUFFIXES, (poster.getvalue(), moving), strict=True):
        with whole_file(GALLERY / f"{name}{suffix}") as stream:
            stream.write(content)
    print(f"{name}: poster {len(poster.getvalue()) / 1000:.0f} kB; animation {len(moving) / 1000:.0f} kB, {told}; made in "
          f"{time.monotonic() - begun:.0f} s", flush=True)


def sentence(name: str) -> str:
    """Return the first sentence of what an effect says of itself."""
    doc = str(data_of(name)["doc"])
    return doc.partition(". ")[0].rstrip(".") + "."


def text(names: Iterable[str]) -> str:
    """Return the README's part: a table of the effects, each with its animation, its name and a sentence."""
    cells = list(names)
    lines = ["|" + " |" * COLUMNS, "|" + "---|" * COLUMNS]
    for begin in range(0, len(cells), COLUMNS):
        row = [*cells[begin : begin + COLUMNS], *[""] * COLUMNS][:COLUMNS]
        shown = [f"[![{name}](graphs/gallery/{name}.webp)](graphs/gallery/{name}.jpg)" if name else "" for name in row]
        said = [f"**[{name}](graphs/effects/{name}.json)** {sentence(name)}" if name else "" for name in row]
        lines += [f"| {' | '.join(shown)} |", f"| {' | '.join(said)} |"]
    return "\n".join(lines) + "\n"


def write_text() -> None:
    """Write the README's part, of all effects that have pictures."""
    there = [name for name in EFFECTS if all((GALLERY / f"{name}{suffix}").exists() for suffix in SUFFIXES)]
    README.write_text(with_part(README.read_text(encoding="utf-8"), "gallery", text(there)), encoding="utf-8")


if __name__ == "__main__":
    use_wide_registers()
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help="effects; all if not given")
    parser.add_argument("--text", action="store_true", help="write the README's part alone")
    options = parser.parse_args()
    if unknown := [name for name in options.names if name not in EFFECTS]:
        parser.error(f"there is no effect '{unknown[0]}'; there are {', '.join(EFFECTS)}")
    for each in () if options.text else options.names or EFFECTS:
        make(each)
    write_text()
