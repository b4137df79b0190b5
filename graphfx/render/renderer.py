"""Render particles and polygons: project, order by nearest depth, bin into tiles, composite every pixel in exact order.

[Sims 1990, section 4; the order of fragments is per pixel, over all streams]
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphfx.render.bins import bin_segments
from graphfx.render.camera import Camera
from graphfx.render.compositing import Slabs, composite, composite_slabs
from graphfx.render.film import Film
from graphfx.render.layers import Layers
from graphfx.render.order import ordered
from graphfx.render.patches import MEMBER_BYTES, Patch, patches_within, whole_picture
from graphfx.render.polygons import Lighting, Polygons
from graphfx.render.samples import Samples, sample_bands
from graphfx.render.scene import Scene, make_scene
from graphfx.render.segments import Segments
from graphfx.render.slabs import slabs_of
from graphfx.render.streaks import Streaks
from graphfx.render.surfaces import Surfaces
from graphfx.render.tiles import Tiles

LEAST_MEMORY = 1 << 22
"""Bytes; with less a patch would be made of too few streaks to be worth its beginning."""

LEAST_SHARE = 0.25
"""Part of the memory that segments have, whatever polygons need beside them."""
NO_LIGHTS = Lighting()
Listener = Callable[[str], Any]
Sampler = Callable[[Samples], Any]


def render(
    streams: Sequence[Streaks], head_camera: Camera, tail_camera: Camera | None, width: int, height: int,
    threads: int = 1, listener: Listener = lambda step: None, sampler: Sampler | None = None, memory: float = np.inf,
    polygons: Sequence[Polygons] = (), lighting: Lighting = NO_LIGHTS, cutoff: float = 0.0,
) -> Film:
    """Return the film of all streams and polygons together.

    The cameras are those at the end and at the opening of the shutter (None: the same); near and far
    planes are the head's, which sees the polygons too. `memory` is the number of bytes that may be used beside streams,
    polygons and film; what is too much for it is made patch by patch. Any number of threads and any memory give the same
    bytes. `listener` is called with the name of each step as it begins, `sampler` with the samples of each band of rows, from
    the top. Where particles let less than `cutoff` of the light through, what is behind may be left out: at 0, nothing is.
    """
    tail_camera = tail_camera or head_camera
    if tail_camera.projection != head_camera.projection:
        raise ValueError("a camera's projection cannot change while the shutter is open")
    if width < 1 or height < 1:
        raise ValueError(f"a picture of {width} x {height} pixels has no pixels")
    scene = make_scene(streams, head_camera, tail_camera, width, height, threads, sampler is not None)
    film, surfaces = Film(np.zeros((height, width, 4), np.float32)), None
    if polygons:
        listener("polygons")
        surfaces = Surfaces(polygons, lighting, head_camera, width, height, threads)
    _Rendering(scene, surfaces, film, listener, sampler, max(memory, LEAST_MEMORY), cutoff).run()
    film.dropped += surfaces.dropped if surfaces is not None else 0
    return film


@dataclass
class _Rendering:
    """One picture in the making."""

    scene: Scene
    surfaces: Surfaces | None
    film: Film
    listener: Listener
    sampler: Sampler | None
    memory: float
    cutoff: float

    def run(self) -> None:
        """Render all at once if the memory allows it, or patch by patch."""
        whole = whole_picture(self.scene.width, self.scene.height)
        beside = None if self.surfaces is None or self.memory == np.inf else self.surfaces.layer_bytes(self.scene.threads)
        left = self.memory if beside is None else self.memory - beside.sum()
        if self.scene.count * self.scene.segment_bytes <= left and self._patch(whole, left):
            return
        self.listener("survey")
        counts, self.film.dropped = self.scene.survey(beside)
        memory = max(self.memory - self.scene.surveyed_bytes, LEAST_MEMORY)
        for patch in patches_within(counts, whole, memory, uncut=self.sampler is not None):
            left = max(memory - counts.memory_beside(patch), LEAST_SHARE * memory)
            if counts.memory_of_segments(patch) > left and self.sampler is None:
                self._tile_in_slabs(patch, left)
            else:
                self._patch(patch)

    def _patch(self, patch: Patch, memory: float = np.inf) -> bool:
        """Render a patch; return whether it could be done within a memory."""
        layers = self._layers(patch)
        segments, dropped = self._segments(patch, layers)
        tiles = self._tiles(segments, patch, layers, memory - self.scene.segment_bytes // 2 * len(segments.kind))
        if tiles is None:
            return False
        self.film.dropped += dropped
        self._composite(segments, tiles, layers)
        return True

    def _layers(self, patch: Patch) -> Layers | None:
        """Return the fragments of polygons in a patch, or None where the picture has no polygons."""
        if self.surfaces is None:
            return None
        self.listener("polygons")
        return self.surfaces.layers(patch, self.scene.threads)

    def _segments(self, patch: Patch, layers: Layers | None) -> tuple[Segments, int]:
        """Return the segments that may touch a patch, nearest first, and how many particles were dropped."""
        self.listener("project")
        segments, rows, dropped = self.scene.segments(patch)
        if layers is not None:
            rows = rows[segments.nearest[rows] <= layers.limits.max()]
        self.listener("order")
        return ordered(segments, rows, self.scene.threads), dropped

    def _tiles(self, segments: Segments, patch: Patch, layers: Layers | None, memory: float = np.inf) -> Tiles | None:
        """Return the segments of each tile of a patch, or None if that would take more memory."""
        self.listener("bin")
        scene = self.scene
        perspective, most = scene.view.perspective, memory / MEMBER_BYTES
        limits = None if layers is None else layers.limits.max(axis=1)
        tiles = bin_segments(segments, patch, scene.width, scene.height, perspective, scene.threads, most, limits)
        return tiles and tiles._replace(cutoff=self.cutoff)

    def _composite(self, segments: Segments, tiles: Tiles, layers: Layers | None) -> None:
        self.listener("tiles")
        self.film.fragments += composite(segments, tiles, layers, self.scene.threads, self.film.pixels)
        if self.sampler is not None:
            self.listener("samples")
            for samples in sample_bands(segments, tiles, layers, self.scene.threads):
                self.sampler(samples)

    def _tile_in_slabs(self, patch: Patch, memory: float) -> None:
        """Render a patch of one tile, a slice of depth after the other, each within a memory."""
        most = max(int(memory) // (self.scene.segment_bytes + MEMBER_BYTES), 1)
        slabs = list(slabs_of(self.scene, patch, most))
        if not slabs:
            self._patch(patch)
            return
        layers = self._layers(patch)

        def made() -> Iterator[tuple[Segments, Tiles, bool]]:
            for slab in slabs:
                self.listener("project")
                segments, rows = self.scene.slab_segments(patch, slab, most)
                self.listener("order")
                segments = ordered(segments, rows, self.scene.threads)
                tiles = self._tiles(segments, patch, layers)
                assert tiles is not None
                self.listener("tiles")
                yield segments, tiles, slab == slabs[-1]
                del segments, tiles

        state = Slabs(layers)
        self.film.fragments += composite_slabs(made(), state, False, self.film.pixels)
        if state.overflowed.any():
            self.film.fragments += composite_slabs(made(), state, True, self.film.pixels)
