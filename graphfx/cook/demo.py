"""Pages of test pictures: a folder of graphs, each drawn, measured, and put on a sheet and an HTML page.

A graph says what it shows in its `doc`, the title before the first full stop; each of its images is one picture, under the
first line of its own `doc`. What a page needs besides, it says in the key `x-page`: its place (`order`), how many
times larger an image is shown (`zoom`, by its id), whether it is shown as a movie (`moves`) and whether the light in its
images is measured from frame to frame (`light`).
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.cook.writing import Writer
from graphfx.errors import GraphError, Location, Problem, suggestion
from graphfx.graph.document import load_document
from graphfx.graph.flat import FlatGraph
from graphfx.graph.flatten import flatten
from graphfx.graph.names import PICTURES
from graphfx.graph.values import Literal
from graphfx.node import Library
from graphfx.output.animation import animated_webp
from graphfx.output.atomic import make_folder, whole_file
from graphfx.output.png import write_png
from graphfx.output.sheet import Card, Picture, page, sheet

QUALITY, LOSSLESS = 90.0, 100.0
"""Of the page's movies, and of those whose pixels are seen."""
ON_PAGE: dict[str, Any] = {"order": 1.5, "zoom": {"frames": 4}, "moves": True, "light": True}
"""What a graph may say of its place on a page, with an example of each."""
LEAST_TOLD = 0.01
"""Percents below which light does not vary enough to say by how much."""


@dataclass(frozen=True)
class Demo:
    """One graph of a page: its file, what it says of itself, and what it says of its place on the page."""

    file: Path
    title: str
    caption: str
    labels: dict[str, str]
    order: float = 0.0
    zoom: dict[str, int] = field(default_factory=dict)
    moves: bool = False
    light: bool = False

    @property
    def name(self) -> str:
        """Return the graph's name."""
        return self.file.stem


def demos_in(folder: Path) -> list[Demo]:
    """Return the graphs of a folder as a page shows them."""
    return sorted((_read(file) for file in folder.glob("*.json")), key=lambda demo: (demo.order, demo.name))


def said(file: Path) -> str:
    """Return what a graph says of itself."""
    return str(_data(file).get("doc", ""))


def _data(file: Path) -> dict[str, Any]:
    document = load_document(file)
    if document.problems:
        raise GraphError(list(document.problems))
    data: dict[str, Any] = document.root.data()
    return data


def _read(file: Path) -> Demo:
    data = _data(file)
    title, _, caption = str(data.get("doc", file.stem)).partition(". ")
    labels = {name: str(node.get("doc", "")) for name, node in data.get("nodes", {}).items()}
    return Demo(file, title.rstrip("."), caption, labels, **_on_page(file, data.get("x-page", {})))


def _on_page(file: Path, given: Any) -> dict[str, Any]:
    """Return what a graph says of its place on a page; raise GraphError where that makes no sense."""
    fault = "" if isinstance(given, dict) else 'it should be an object, such as {"order": 1}; it is ' + json.dumps(given)
    for name, value in given.items() if isinstance(given, dict) else ():
        if name not in ON_PAGE:
            fault = f"a page knows no '{name}'.{suggestion(name, ON_PAGE)}"
        elif type(value) not in {type(ON_PAGE[name]), int if name == "order" else None}:
            fault = f"{name} should be like {json.dumps(ON_PAGE[name])}; it is {json.dumps(value)}"
    if fault:
        raise GraphError(Problem(fault, Location(str(file)), "x-page", (f"it knows {', '.join(ON_PAGE)}",)))
    return dict(given)


def at_size(flat: FlatGraph, share: float) -> FlatGraph:
    """Return a graph whose pictures have a share of their width and height."""
    nodes = dict(flat.nodes)
    for path, node in flat.nodes.items():
        if node.node_type.role in PICTURES and isinstance(size := node.arguments["size"], Literal):
            smaller = replace(size, value=[max(round(float(number) * share), 1) for number in size.value])
            nodes[path] = replace(node, arguments=node.arguments | {"size": smaller})
    return replace(flat, nodes=nodes)


@dataclass
class Drawn:
    """The pictures of one demo: the last frame of each image as bytes of sRGB, and the light in every frame that was drawn."""

    stills: dict[str, np.ndarray]
    light: dict[str, list[float]]

    @property
    def variation(self) -> float:
        """Return by how much the light varies, as a share of its mean, in the image in which it varies most."""
        return max((max(each) - min(each)) / (sum(each) / len(each)) for each in self.light.values())


def draw_demo(demo: Demo, library: Library, folder: Path | None, threads: int, share: float = 1.0) -> Drawn:
    """Draw a demo: the last frame of all its images; where the light is measured, or a movie is made in a folder, every frame."""
    effect = Effect(at_size(flatten(demo.file, library), share))
    writer, simulation, last = Writer(effect.plan, threads), effect.simulation(threads), effect.frames[-1]
    drawn = Drawn({}, {image.node.path: [] for image in effect.plan.images})
    with ExitStack() as files:
        movies = {}
        if folder is not None and demo.moves:
            for image in effect.plan.images:
                file = folder / f"{picture_name(demo, image.node.path)}.webp"
                quality = LOSSLESS if image.node.path in demo.zoom else QUALITY
                movies[image.node.path] = files.enter_context(animated_webp(file, effect.flat.time.fps, quality))
        for frame in simulation.frames(last):
            for image in effect.plan.images if demo.light or movies or frame == last else ():
                film = writer.draw(None, image, simulation, frame)
                drawn.light[image.node.path].append(float(film.pixels[..., :3].sum(dtype=float)))
                drawn.stills[image.node.path] = writer.displayed(image, film, frame)
                if image.node.path in movies:
                    movies[image.node.path](drawn.stills[image.node.path])
    return drawn


def picture_name(demo: Demo, image: str) -> str:
    """Return what the picture of an image is called, without its suffix."""
    return f"{demo.name}.{image}"


def make_page(title: str, demos: list[Demo], library: Library, folder: Path, threads: int,
              report: Callable[[Demo], None] = lambda demo: None) -> list[Path]:
    """Draw a page: a picture for each image, movies, the graphs, `sheet.png` and `index.html`; return the last two."""
    make_folder(folder / "index.html")
    cards = []
    for demo in demos:
        report(demo)
        cards.append(_card(demo, draw_demo(demo, library, folder, threads), folder))
    write_png(folder / "sheet.png", sheet(title, cards), threads=threads)
    with whole_file(folder / "index.html") as stream:
        stream.write(page(title, cards).encode())
    return [folder / "index.html", folder / "sheet.png"]


def _card(demo: Demo, drawn: Drawn, folder: Path) -> Card:
    pictures = []
    for path, still in drawn.stills.items():
        name = picture_name(demo, path)
        write_png(folder / f"{name}.png", still)
        zoom = demo.zoom.get(path, 1)
        large = still.repeat(zoom, axis=0).repeat(zoom, axis=1)
        pictures.append(Picture(large, demo.labels.get(path, ""), f"{name}.png", f"{name}.webp" if demo.moves else ""))
    facts = []
    if demo.light:
        frames = len(next(iter(drawn.light.values())))
        percent = 100 * drawn.variation
        much = f"by {percent:.2g} %" if percent >= LEAST_TOLD else f"by less than {LEAST_TOLD} %"
        facts.append(f"Measured: over {frames} frames the light of all pixels varies {much}.")
    shutil.copyfile(demo.file, folder / demo.file.name)
    return Card(demo.title, demo.caption, tuple(pictures), tuple(facts), demo.file.name)
