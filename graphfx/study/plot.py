"""Plots on logarithmic axes as SVG that stands in a page and takes its colours from the page's style."""

from __future__ import annotations

import html
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

WIDTH, HEIGHT = 620, 440
LEFT, RIGHT, TOP, BOTTOM = 72, 16, 30, 50
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
LENGTHS = {3: "1 km", 2: "100 m", 1: "10 m", 0: "1 m", -1: "10 cm", -2: "1 cm", -3: "1 mm", -4: "0.1 mm", -5: "10 µm",
           -6: "1 µm", -7: "0.1 µm", -8: "10 nm", -9: "1 nm"}
TIMES = {2: "100 s", 1: "10 s", 0: "1 s", -1: "0.1 s", -2: "10 ms", -3: "1 ms", -4: "0.1 ms"}
MARKERS = {
    "circle": "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0z",
    "square": "M-3.6,-3.6h7.2v7.2h-7.2z",
    "up": "M0,-4.8L4.6,3.4H-4.6z",
    "diamond": "M0,-5.2L5.2,0L0,5.2L-5.2,0z",
    "down": "M0,4.8L4.6,-3.4H-4.6z",
    "pentagon": "M0,-4.8L4.6,-1.5L2.8,3.9H-2.8L-4.6,-1.5z",
    "star": "M0,-5.4L1.5,-1.8L5.2,-1.6L2.3,0.7L3.3,4.4L0,2.3L-3.3,4.4L-2.3,0.7L-5.2,-1.6L-1.5,-1.8z",
}


@dataclass(frozen=True)
class Point:
    """A point, with the quartiles of its x, and what is said of it. `marked` points are ringed."""

    x: float
    y: float
    said: str
    low: float = math.nan
    high: float = math.nan
    marked: bool = False


@dataclass(frozen=True)
class Line:
    """Points of one family in order; `style` is its class in the page's style."""

    style: str
    marker: str
    points: Sequence[Point]
    dashed: bool = False


@dataclass
class Plot:
    """Lines over two axes.

    What is infinite stands at the top; what is not above `floor` is drawn there, hollow: it is not measured.
    """

    name: str
    title: str
    description: str
    x_label: str
    lines: Sequence[Line]
    tolerance: float
    floor: float = 0.0
    x_words: dict[int, str] = field(default_factory=dict)
    linear_x: bool = False

    def __post_init__(self) -> None:
        """Find the ends of the axes."""
        every = [point for line in self.lines for point in line.points]
        xs = [x for point in every for x in (point.x, point.low, point.high) if math.isfinite(x) and (x > 0 or self.linear_x)]
        ys = [max(point.y, self.floor) for point in every if math.isfinite(point.y)] + [self.tolerance]
        positive = [y for y in ys if y > 0]
        self.bottom, self.top = math.floor(math.log10(min(positive)) - 0.15), math.ceil(math.log10(max(positive)) + 0.15)
        if self.linear_x:
            self.first, self.last = min(xs, default=0.0), max(xs, default=1.0)
        else:
            low, high = math.log10(min(xs, default=1.0)), math.log10(max(xs, default=10.0))
            self.first, self.last = low - 0.08 * max(high - low, 0.5), high + 0.08 * max(high - low, 0.5)
        if self.last <= self.first:
            self.last = self.first + 1.0

    def x(self, value: float) -> float:
        """Return where a value stands from the left."""
        place = value if self.linear_x else math.log10(value)
        return LEFT + (WIDTH - LEFT - RIGHT) * (place - self.first) / (self.last - self.first)

    def y(self, value: float) -> float:
        """Return where a value stands from the top: what is infinite in the strip above, what is not measured at the floor."""
        if not math.isfinite(value):
            return TOP - 11.0
        place = math.log10(max(value, self.floor, 10.0**self.bottom))
        return TOP + (HEIGHT - TOP - BOTTOM) * (self.top - place) / (self.top - self.bottom)


def power_of_ten(exponent: int, words: dict[int, str], unit: str = "") -> str:
    """Return a power of ten in words, or as 10 to a power."""
    return words.get(exponent) or f"10{str(exponent).translate(SUPERSCRIPTS)}{unit}"


def svg(plot: Plot) -> str:
    """Return a plot as SVG."""
    name, right, low = html.escape(plot.name, quote=True), WIDTH - RIGHT, HEIGHT - BOTTOM
    parts = [f'<svg class="plot" viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-labelledby="{name}-title {name}-desc">',
             f'<title id="{name}-title">{html.escape(plot.title)}</title>',
             f'<desc id="{name}-desc">{html.escape(plot.description)}</desc>']
    if plot.floor > 10.0**plot.bottom:
        parts.append(f'<rect class="floor" x="{LEFT}" y="{plot.y(plot.floor):.1f}" width="{right - LEFT}" '
                     f'height="{low - plot.y(plot.floor):.1f}"/>')
    parts += [*_grid(plot), *_tolerance(plot)]
    for line in plot.lines:
        parts += _line(plot, line)
    parts.append("</svg>")
    return "\n".join(parts)


def _grid(plot: Plot) -> Iterator[str]:
    right, low = WIDTH - RIGHT, HEIGHT - BOTTOM
    stride = max(math.ceil((plot.top - plot.bottom) / 9), 1)
    for exponent in range(plot.bottom, plot.top + 1):
        y = plot.y(10.0**exponent) if exponent > plot.bottom else low
        yield f'<path class="grid" d="M{LEFT},{y:.1f}H{right}"/>'
        if (exponent - plot.top) % stride == 0:
            yield f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{power_of_ten(exponent, LENGTHS, " m")}</text>'
    for value, label in _ticks(plot):
        x = plot.x(value)
        yield f'<path class="grid{"" if label else " minor"}" d="M{x:.1f},{TOP}V{low}"/>'
        if label:
            yield f'<text x="{x:.1f}" y="{low + 18}" text-anchor="middle">{label}</text>'
    yield f'<path class="axis" d="M{LEFT},{TOP}V{low}H{right}"/>'
    yield f'<text class="name" x="{(LEFT + right) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{html.escape(plot.x_label)}</text>'
    if any(not math.isfinite(point.y) for line in plot.lines for point in line.points):
        yield f'<text class="failed" x="{LEFT - 8}" y="{TOP - 7}" text-anchor="end">failed</text>'
        yield f'<path class="failed" d="M{LEFT},{TOP - 1}H{right}"/>'


def _ticks(plot: Plot) -> Iterator[tuple[float, str]]:
    """Yield the places of the lines across, with labels."""
    if plot.linear_x:
        span = plot.last - plot.first
        step = 10.0 ** math.floor(math.log10(span))
        step = next(each for each in (step / 5, step / 2, step, 2 * step) if span / each <= 8)
        for k in range(math.ceil(plot.first / step - 1e-9), math.floor(plot.last / step + 1e-9) + 1):
            yield k * step, f"{k * step:g}"
        return
    narrow = plot.last - plot.first < 1.6
    for exponent in range(math.floor(plot.first), math.ceil(plot.last) + 1):
        for digit in range(1, 10):
            value = digit * 10.0**exponent
            if plot.first <= math.log10(value) <= plot.last:
                told = digit == 1 or (narrow and digit in (2, 5))
                yield value, _told(plot, digit, exponent) if told else ""


def _told(plot: Plot, digit: int, exponent: int) -> str:
    """Return the label of digit x 10^exponent."""
    if not plot.x_words:
        return f"{digit * 10.0**exponent:g}"
    word = power_of_ten(exponent, plot.x_words, " s")
    number, _, unit = word.partition(" ")
    return word if digit == 1 else f"{float(number) * digit:g} {unit}"


def _tolerance(plot: Plot) -> Iterator[str]:
    y = plot.y(plot.tolerance)
    yield f'<path class="tolerance" d="M{LEFT},{y:.1f}H{WIDTH - RIGHT}"/>'
    yield f'<text class="tolerance" x="{WIDTH - RIGHT - 4}" y="{y - 5:.1f}" text-anchor="end">tolerance</text>'
    if plot.floor > 10.0**plot.bottom:
        yield (f'<text class="floor" x="{LEFT + 6}" y="{plot.y(plot.floor) + 14:.1f}">'
               "below this, the references differ</text>")


def _line(plot: Plot, line: Line) -> Iterator[str]:
    places = [(plot.x(point.x), plot.y(point.y), point) for point in line.points if point.x > 0 or plot.linear_x]
    yield f'<g class="line {line.style}{" dashed" if line.dashed else ""}">'
    finite = [(x, y) for x, y, point in places if math.isfinite(point.y)]
    if len(finite) > 1:
        yield f'<path class="way" d="M{"L".join(f"{x:.1f},{y:.1f}" for x, y in finite)}"/>'
    for x, y, point in places:
        if point.low < point.high and plot.x(point.high) - plot.x(point.low) > 1:
            yield f'<path class="spread" d="M{plot.x(point.low):.1f},{y:.1f}H{plot.x(point.high):.1f}"/>'
        hollow = " hollow" if line.dashed or point.y <= plot.floor else ""
        ring = '<circle class="ring" r="9"/>' if point.marked else ""
        yield (f'<g transform="translate({x:.1f},{y:.1f})">{ring}<path class="mark{hollow}" d="{MARKERS[line.marker]}">'
               f"<title>{html.escape(point.said)}</title></path></g>")
    yield "</g>"
