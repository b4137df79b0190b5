"""Contact sheets: pictures side by side in rows, each over its label, as one PNG.

With n pictures of w x h pixels in c columns and r = ceil(n / c) rows:

    width  = c w + (c + 1) GAP
    height = r (h + FOOT) + GAP [pixels]
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from graphfx.errors import LimitError
from graphfx.output.animation import Add
from graphfx.output.png import write_png
from graphfx.output.sheet import BACKGROUND, PLAIN, letters

GAP = 8
"""Pixels around pictures."""
FOOT = 24
"""Pixels from a picture's lower edge to the next one's upper, where its label is."""
LABEL = 13
"""Height of letters [pixels]."""
MOST = 1 << 27
"""Pixels of a sheet."""


def columns_for(count: int) -> int:
    """Return the columns that give a sheet about the shape of its pictures: the least c with c c >= count."""
    return math.isqrt(max(count - 1, 0)) + 1


def sheet_size(count: int, columns: int, width: int, height: int) -> tuple[int, int]:
    """Return the width and height of a sheet of so many pictures [pixels]; raise LimitError for one that is too large."""
    columns = min(columns, count)
    wide, high = columns * (width + GAP) + GAP, -(-count // columns) * (height + FOOT) + GAP
    if wide * high > MOST:
        raise LimitError(f"a contact sheet of {count:,} pictures of {width} x {height} has {wide * high:,} pixels, and the "
                         f"limit is {MOST:,}; make them smaller with --size, or take fewer with --frames")
    return wide, high


@contextmanager
def contact_sheet(path: str | os.PathLike[str], labels: Sequence[str], columns: int) -> Iterator[Add]:
    """Give a function that puts the next picture on a sheet; the file is there when the block ends well.

    Pictures are bytes of sRGB (height, width, 3 or 4), of one size; there is one for each label.
    """
    from PIL import Image, ImageDraw

    sheet: Image.Image | None = None
    places = iter(enumerate(labels))

    def add(pixels: np.ndarray) -> None:
        nonlocal sheet
        height, width, channels = pixels.shape
        if sheet is None:
            sheet = Image.new("RGB", sheet_size(len(labels), columns, width, height), BACKGROUND)
        place, label = next(places)
        left, top = GAP + place % columns * (width + GAP), GAP + place // columns * (height + FOOT)
        picture = Image.fromarray(pixels)
        sheet.paste(picture, (left, top), picture if channels == 4 else None)
        ImageDraw.Draw(sheet).text((left, top + height + 4), label, PLAIN, letters(LABEL))

    yield add
    if sheet is not None:
        write_png(path, np.asarray(sheet))
