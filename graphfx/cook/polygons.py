"""From nodes to polygons: meshes where they stand, their looks at a time, textures read once, and the light."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from graphfx.cook.meshes import Meshes, Standing
from graphfx.cook.textures import check_texture, load_texture
from graphfx.errors import GraphError, GraphfxError, LimitError, Problem
from graphfx.geometry.creases import creased
from graphfx.geometry.mesh import Mesh
from graphfx.graph.flat import FlatNode
from graphfx.plan.pictures import ImagePlan, plain_value, value_at
from graphfx.render.polygons import Light, Lighting, Polygons
from graphfx.render.textures import Texture

MAPS = {"color_map": "a color_map", "opacity_map": "an opacity_map"}
"""Parameters that name pictures, and how one is spoken of."""


class PolygonMaker:
    """Makes the polygons of pictures."""

    def __init__(self, meshes: Meshes):
        """Read nothing yet."""
        self.meshes = meshes
        self._kept: dict[tuple[str, bool], tuple[Standing, tuple[Mesh, np.ndarray | None]]] = {}
        self._textures: dict[tuple[str, bool, bool], Texture] = {}

    def prepare(self, images: Iterable[ImagePlan], whole: bool = False) -> None:
        """Make the meshes of pictures and look at their maps; raise GraphError with all that keeps them from being drawn.

        Of the maps only the beginnings are read, unless the `whole` is to be.
        """
        problems = [problem for node in {node.path: node for image in images for node in image.polygons}.values()
                    for problem in self._problems(node, whole)]
        if problems:
            raise GraphError(problems)

    def _problems(self, node: FlatNode, whole: bool) -> Iterator[Problem]:
        for name in MAPS:
            file = str(plain_value(node.arguments[name]))
            try:
                if file:
                    check_texture(file, whole)
            except (GraphError, LimitError) as error:
                yield from _at(node, name, error)
        try:
            self._mesh(node)
        except (GraphError, LimitError) as error:
            yield from error.problems

    def polygons(self, node: FlatNode, time: float, frame: int) -> Polygons:
        """Return a node's polygons as they are at a time [s]."""
        given = {name: value_at(node, name, time, frame) for name in node.arguments}
        mesh, normals = self._moved(node, given["shading"] == "smooth", time, frame)
        return Polygons(
            mesh.vertices, mesh.triangles, normals, mesh.coordinates, given["color"],
            float(given["opacity"]), str(given["shading"]), self._texture(node, "color_map"), self._texture(node, "opacity_map"),
            bool(given["double_sided"]),
        )

    def _moved(self, node: FlatNode, smooth: bool, time: float, frame: int) -> tuple[Mesh, np.ndarray | None]:
        """Return a node's mesh as it stands, and the normals of its vertices if it is smooth; kept while it stands so."""
        path = node.references["geometry"]
        standing, key = self.meshes.standing(path, time, frame), (path, smooth)
        if key not in self._kept or self._kept[key][0] != standing:
            self._mesh(node)
            mesh = self.meshes.mesh(path, standing)
            self._kept[key] = standing, creased(mesh) if smooth else (mesh, None)
        return self._kept[key][1]

    def _mesh(self, node: FlatNode) -> None:
        """Make the mesh of a node; raise GraphError for one that cannot be drawn so."""
        maps = [name for name in MAPS if plain_value(node.arguments[name])]

        def check(mesh: Mesh) -> None:
            if not len(mesh.triangles):
                raise GraphError(Problem(f"'{node.path}' draws its triangles, and it has none"))
            if maps and mesh.coordinates is None:
                raise GraphError(Problem(f"'{node.path}' puts {MAPS[maps[0]]} on it, and it has no coordinates that say "
                                         "where; take a shape, or a file that has them (vt in OBJ)"))

        self.meshes.check(node.references["geometry"], check)

    def _texture(self, node: FlatNode, name: str) -> Texture | None:
        """Return one of a node's maps, or None where it has none; it is read once."""
        file = str(plain_value(node.arguments[name]))
        if not file:
            return None
        key = file, name == "color_map", plain_value(node.arguments["wrap"]) == "clamp"
        if key not in self._textures:
            try:
                self._textures[key] = replace(load_texture(*key[:2]), clamped=key[2])
            except (GraphError, LimitError) as error:
                raise type(error)(_at(node, name, error)) from error.__cause__
        return self._textures[key]


def _at(node: FlatNode, name: str, error: GraphfxError) -> list[Problem]:
    """Return problems at a parameter of a node."""
    value = node.arguments[name]
    return [replace(problem, location=value.location, path=value.path) for problem in error.problems]


def lighting_of(image: ImagePlan, time: float, frame: int) -> Lighting:
    """Return the light of a picture at a time [s]."""
    lights = [
        Light(value_at(node, "direction", time, frame), value_at(node, "color", time, frame))
        for node in image.lights
    ]
    return Lighting(lights, image.value("ambient", time, frame))
