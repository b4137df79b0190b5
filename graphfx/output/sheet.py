"""A page of pictures with their titles: a contact sheet as one picture, and the same as HTML."""

from __future__ import annotations

import html
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

WIDTH = 1400
"""Pixels of a sheet."""
MARGIN, GAP = 40, 40
"""Pixels around a sheet, and between its cards."""
BETWEEN = 40
"""Pixels between the pictures of a card."""
HEAD = 76
"""Pixels above a card's pictures, for its title and caption."""
FOOT = 30
"""Pixels below them, for their labels."""
TITLE, CAPTION, LABEL = 22, 15, 14
"""Heights of letters [pixels]."""
BACKGROUND, BRIGHT, PLAIN, DIM = (24, 26, 32), (238, 240, 245), (168, 174, 186), (118, 124, 138)


@dataclass(frozen=True)
class Picture:
    """One picture of a card: bytes of sRGB (height, width, 3), its label, its file, and the movie that it is a frame of."""

    pixels: np.ndarray
    label: str
    file: str
    movie: str = ""

    @property
    def width(self) -> int:
        """Return its width in pixels."""
        return int(self.pixels.shape[1])


@dataclass(frozen=True)
class Card:
    """One graph on a page: its pictures side by side, and what was measured of them."""

    title: str
    caption: str
    pictures: tuple[Picture, ...]
    facts: tuple[str, ...] = ()
    graph: str = ""
    """The graph's file, as a link would name it."""

    @property
    def width(self) -> int:
        """Return its width on a sheet."""
        return sum(picture.width for picture in self.pictures) + BETWEEN * (len(self.pictures) - 1)

    @property
    def height(self) -> int:
        """Return its height on a sheet."""
        told = self.facts or any(picture.label for picture in self.pictures)
        return HEAD + max(len(picture.pixels) for picture in self.pictures) + (FOOT if told else 0)


def rows_of(cards: Sequence[Card]) -> Iterator[list[Card]]:
    """Yield cards by rows, as many in each as find room."""
    row: list[Card] = []
    for card in cards:
        if row and sum(each.width + GAP for each in row) + card.width > WIDTH - 2 * MARGIN:
            yield row
            row = []
        row.append(card)
    if row:
        yield row


def sheet(title: str, cards: Sequence[Card]) -> np.ndarray:
    """Return all cards as one picture."""
    from PIL import Image, ImageDraw

    rows = list(rows_of(cards))
    width = max(WIDTH, *(sum(card.width + GAP for card in row) - GAP + 2 * MARGIN for row in rows))
    top = MARGIN + 60
    height = top + sum(max(card.height for card in row) + GAP for row in rows) - GAP + MARGIN
    canvas = Image.new("RGB", (width, height), BACKGROUND)
    pen = ImageDraw.Draw(canvas)
    pen.text((MARGIN, MARGIN), title, BRIGHT, letters(30))
    for row in rows:
        left = MARGIN
        for card in row:
            _draw_card(canvas, pen, card, left, top)
            left += card.width + GAP
        top += max(card.height for card in row) + GAP
    return np.asarray(canvas)


def letters(height: int) -> Any:
    """Return the font of a sheet, so many pixels high."""
    from PIL import ImageFont

    return ImageFont.load_default(height)


def _draw_card(canvas: Any, pen: Any, card: Card, left: int, top: int) -> None:
    from PIL import Image

    pen.text((left, top), card.title, BRIGHT, letters(TITLE))
    for number, line in enumerate(_broken(card.caption, card.width, pen)[:2]):
        pen.text((left, top + 32 + number * 20), line, PLAIN, letters(CAPTION))
    for number, picture in enumerate(card.pictures):
        canvas.paste(Image.fromarray(picture.pixels), (left, top + HEAD))
        facts = card.facts if number == 0 else ()
        said = "   ".join((*([picture.label] if picture.label else []), *facts))
        pen.text((left, top + HEAD + len(picture.pixels) + 8), said, DIM, letters(LABEL))
        left += picture.width + BETWEEN


def _broken(text: str, width: int, pen: Any) -> list[str]:
    """Return a text in lines of so many pixels at most."""
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and pen.textlength(longer, letters(CAPTION)) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


STYLE = """
body { margin: 40px auto; max-width: 1320px; padding: 0 20px; background: #181a20; color: #a8aeba; }
body { font: 15px/1.5 system-ui, sans-serif; }
h1, h2 { color: #eef0f5; font-weight: 500; margin: 0; }
h1 { font-size: 30px; } h2 { font-size: 22px; }
section { margin-top: 44px; } p { margin: 2px 0 12px; max-width: 80ch; }
div { display: flex; flex-wrap: wrap; gap: 40px; }
figure { margin: 0; flex: 0 1 auto; } img { display: block; max-width: 100%; image-rendering: pixelated; }
figcaption { color: #767c8a; font-size: 14px; margin-top: 6px; } a { color: #7fa6e8; }
"""


def page(title: str, cards: Sequence[Card]) -> str:
    """Return the page as HTML, which links to the pictures beside it."""
    name = html.escape(title)
    parts = [f'<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n<title>{name}</title>\n<style>{STYLE}</style>',
             f"<h1>{name}</h1>"]
    for card in cards:
        link = f' <a href="{html.escape(card.graph)}">{html.escape(card.graph)}</a>' if card.graph else ""
        parts.append(f"<section>\n<h2>{html.escape(card.title)}</h2>\n<p>{html.escape(card.caption)}{link}</p>\n<div>")
        parts += [_figure(picture) for picture in card.pictures]
        parts.append("</div>")
        parts += [f"<p>{html.escape(fact)}</p>" for fact in card.facts]
        parts.append("</section>")
    return "\n".join([*parts, "</html>", ""])


def _figure(picture: Picture) -> str:
    height, width = picture.pixels.shape[:2]
    image = (f'<img src="{html.escape(picture.movie or picture.file)}" width="{width}" height="{height}" '
             f'alt="{html.escape(picture.label)}">')
    return f"<figure>{image}<figcaption>{html.escape(picture.label)}</figcaption></figure>"
