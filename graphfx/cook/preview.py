"""Any graph, small and as one animation: its first picture, drawn as lines or as it is.

A graph without a picture is seen by a camera that holds all of its particles:

    distance = max over the corners of their box of (|x| / tan(half width), |y| / tan(half height)) - z

with x, y, z a corner's place to the right of the box's middle, above and beyond it, as seen from `FROM`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import numpy as np

from graphfx.cook.effect import Effect
from graphfx.cook.frames import spread
from graphfx.errors import NOWHERE, GraphError, Location, Problem
from graphfx.graph.check_values import default_value
from graphfx.graph.flat import FlatGraph, FlatNode
from graphfx.graph.names import OUTPUTS, PICTURES
from graphfx.graph.values import Literal, Value
from graphfx.node import Library
from graphfx.plan.pictures import plain_value
from graphfx.render.camera import FILM_WIDTH, Camera

WIDEST = 640
"""Pixels that a preview is wide, unless its picture is narrower."""
FROM = (0.0, 0.25, 1.0)
"""Where a camera stands that nobody placed, from the middle of what it sees."""
EDGE = 1.15
"""How much more than the particles' box such a camera sees."""
LOOKS_AT = 8
"""Frames at which their box is measured."""
OUTLIERS = 0.005
"""The share of the particles, at either end of each axis, that the box may leave out."""
NARROWEST = 0.25
"""Of its longest side, what the box has at least of the others."""
QUALITY = 60.0
"""Of the movie: enough to judge motion by, and quickly encoded."""


def preview_of(flat: FlatGraph, library: Library, file: str, size: tuple[int, int | None] | None = None,
               draws: str = "preview", widest: int = WIDEST) -> FlatGraph:
    """Return a graph that draws the first picture of another small into `file`, an animation; `draws` is the type of node.

    With # in its name `file` is the stills' name, and there is no animation. `size` is the width, and the height unless that
    follows from the picture's; without it the picture's own is taken, but no more than `widest` pixels of width.
    """
    pictures = [node for node in flat.nodes.values() if node.node_type.role in PICTURES and node.enabled]
    nodes = {path: node for path, node in flat.nodes.items() if node.node_type.role not in OUTPUTS}
    picture = pictures[0] if pictures else _everything(flat, library, nodes)
    arguments = {name: picture.arguments.get(name, value) for name, value in _defaults(library, draws).items()}
    arguments["size"] = _literal("list", list(_reduced([int(part) for part in plain_value(arguments["size"])], size, widest)))
    stills = "#" in file
    if stills:
        arguments["file"] = _literal("string", file, Location("--out"))
    stated = frozenset(["file"] if stills else [])
    nodes[picture.path] = replace(picture, node_type=library[draws], arguments=arguments, given=stated)
    if not stills:
        movie: dict[str, Value] = _defaults(library, "movie")
        movie |= {"file": _literal("string", file, Location("--out")), "quality": _literal("float", QUALITY)}
        nodes["(movie)"] = FlatNode("(movie)", library["movie"], arguments=movie, references={"image": picture.path})
    return replace(flat, nodes=nodes)


def is_placed(flat: FlatGraph) -> bool:
    """Return whether a graph has a picture, and so a camera that somebody placed."""
    return any(node.node_type.role in PICTURES and node.enabled for node in flat.nodes.values())


def camera_placed(effect: Effect, frames: Iterable[int], threads: int) -> Effect:
    """Return a preview of a graph without a picture, with its camera where it sees the particles of these frames.

    Nothing is tried anew: a camera changes no motion.
    """
    flat = effect.flat
    picture = next(node for node in flat.nodes.values() if node.node_type.role == "preview")
    camera = flat.nodes[picture.references["camera"]]
    width, height = plain_value(picture.arguments["size"])
    low, high = _box(effect, list(frames), threads)
    lens = float(plain_value(camera.arguments["lens"]))
    position = _standpoint(low, high, FILM_WIDTH / 2 / lens, height / width)
    target = (low + high) / 2
    placed = {"position": _literal("point", tuple(position.tolist())), "target": _literal("point", tuple(target.tolist()))}
    nodes = flat.nodes | {camera.path: replace(camera, arguments=camera.arguments | placed)}
    return Effect(replace(flat, nodes=nodes), effect.kinds, effect.choices)


def _box(effect: Effect, frames: list[int], threads: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners of a box that holds nearly all particles at some of the frames."""
    wanted = spread(frames, LOOKS_AT)
    ends = []
    simulation = effect.simulation(threads)
    for frame in simulation.frames(frames[-1]):
        for particles in simulation.particles.values() if frame in wanted else ():
            position = particles.value("position")
            rows = particles.living()
            columns = [np.broadcast_to(part, particles.store.count)[rows] for part in position]
            places = np.stack([np.asarray(column, float) for column in columns])
            places = places[:, np.isfinite(places).all(axis=0)]
            if places.size:
                ends.append(np.quantile(places, [OUTLIERS, 1 - OUTLIERS], axis=1))
    low = np.min([each[0] for each in ends], axis=0) if ends else np.full(3, -1.0)
    high = np.max([each[1] for each in ends], axis=0) if ends else np.full(3, 1.0)
    extent = high - low
    more = np.maximum((extent.max() or 1.0) * NARROWEST - extent, 0.0) / 2
    return low - more, high + more


def _standpoint(low: np.ndarray, high: np.ndarray, half_width: float, shape: float) -> np.ndarray:
    """Return where a camera stands that sees a box: `half_width` is the tangent of half its angle, `shape` height over width."""
    middle = (low + high) / 2
    right, up, ahead = Camera(position=tuple(np.add(middle, FROM)), target=tuple(middle)).axes()
    corners = np.array(np.meshgrid(*zip(low, high, strict=True))).reshape(3, -1).T - middle
    x, y, z = np.abs(corners @ right), np.abs(corners @ up), corners @ ahead
    distance = (EDGE * np.maximum(x / half_width, y / (half_width * shape)) - z).max()
    return np.asarray(middle - distance * ahead)


def _everything(flat: FlatGraph, library: Library, nodes: dict[str, FlatNode]) -> FlatNode:
    """Return a picture of all particles of a graph, seen from a camera that is put among its nodes."""
    makers = tuple(path for path, node in nodes.items() if node.node_type.kind == "emitters" and node.enabled)
    if not makers:
        message = "the graph has no picture and no particles; give it an enabled node of type 'emit'"
        raise GraphError(Problem(message, Location(flat.file), "nodes"))
    shapes = tuple(path for path, node in nodes.items() if node.node_type.role == "polygons" and node.enabled)
    nodes["(camera)"] = FlatNode("(camera)", library["camera"], arguments=_defaults(library, "camera"))
    arguments = _defaults(library, "preview")
    return FlatNode("(preview)", library["preview"], makers + shapes, arguments, references={"camera": "(camera)"})


def _defaults(library: Library, name: str) -> dict[str, Value]:
    """Return the parameters of a node type, at their defaults."""
    stated = [parameter for parameter in library[name].parameters.values() if not parameter.required]
    return {parameter.name: default_value(parameter, "") for parameter in stated}


def _literal(type_: str, value: Any, location: Location = NOWHERE) -> Literal:
    return Literal(type_, location, value=value)


def _reduced(size: list[int], wanted: tuple[int, int | None] | None, widest: int) -> tuple[int, int]:
    """Return the size of a preview: even, as movies need it, unless it is asked for to the pixel."""
    width, height = size
    if wanted is not None and wanted[1] is not None:
        return wanted[0], wanted[1]
    wide = wanted[0] if wanted is not None else min(width, widest)
    return (wide if wanted else max(wide // 2, 1) * 2), max(round(height * wide / width / 2), 1) * 2
