"""Random scenes for the renderer's tests, and how a render is held against the reference."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from graphfx.render import compositing
from graphfx.render.camera import Camera
from graphfx.render.renderer import render
from graphfx.render.streaks import Streaks

WIDTH, HEIGHT = 45, 37
"""Not multiples of a tile."""
CAMERA = Camera(position=(0.3, 0.2, 6.0), target=(0.1, 0.0, 0.0), lens=40.0)
FLAT = Camera(position=(0.0, 0.0, 6.0), projection="orthographic", view_width=5.0, near=-10.0)


def streaks(seed: int, count: int = 60, radius=(0.02, 0.3), length: float = 0.5, spread: float = 2.0, **look) -> Streaks:
    """Return random particles about the origin, streaks of random length."""
    draw = np.random.default_rng(seed)
    head = draw.uniform(-spread, spread, (3, count))
    tail = head + draw.normal(0, length, (3, count))
    given = {
        "head_radius": draw.uniform(*radius, count).astype(np.float32),
        "head_color": draw.random((3, count), np.float32),
        "head_opacity": draw.uniform(0.1, 1.0, count).astype(np.float32),
    }
    return Streaks(head.astype(np.float32), tail.astype(np.float32), **(given | look))


def comets(seed: int, count: int = 60, **look) -> Streaks:
    """Return streaks whose tails differ in radius, colour and opacity, and that live for parts of the shutter."""
    draw = np.random.default_rng(seed + 1000)
    return streaks(
        seed, count, tail_radius=draw.uniform(0, 0.1, count).astype(np.float32),
        tail_color=draw.random((3, count), np.float32), tail_opacity=draw.random(count, np.float32),
        share=draw.random(count, np.float32), **look,
    )


def film(*streams: Streaks, camera: Camera = CAMERA, tail_camera: Camera | None = None, size=(WIDTH, HEIGHT), threads: int = 1):
    """Render."""
    return render(list(streams), camera, tail_camera, *size, threads)


def cut(whole: Streaks, *moments: float, joined: bool = True) -> list[Streaks]:
    """Return streaks in pieces that meet at moments between head (0) and tail (1), everything being even in time."""
    bounds = [0.0, *moments, 1.0]
    tail_radius = whole.head_radius if whole.tail_radius is None else whole.tail_radius

    def at(head, tail, moment):
        return (np.asarray(head, float) + moment * (np.asarray(tail, float) - head)).astype(np.float32)

    made = []
    for k, (first, last) in enumerate(pairwise(bounds)):
        ends = [{
            "": at(whole.head, whole.tail, moment),
            "_radius": at(whole.head_radius, tail_radius, moment),
            "_color": at(whole.head_color, whole.head_color if whole.tail_color is None else whole.tail_color, moment),
            "_opacity": at(whole.head_opacity, whole.head_opacity if whole.tail_opacity is None else whole.tail_opacity, moment),
            "_moment": moment,
        } for moment in (first, last)]
        given = {f"{side}{name}": value for side, end in zip(("head", "tail"), ends, strict=True) for name, value in end.items()}
        joints = ((k > 0) + 2 * (last < 1)) if joined else 0
        made.append(Streaks(
            **given, share=whole.share, part=last - first, joined=float(joints),
            blend=whole.blend, falloff=whole.falloff, streak=whole.streak,
        ))
    return made


def sort_all_whole(monkeypatch) -> None:
    """Let every group be sorted whole, as if its list had overflowed."""
    render_tiles = compositing.render_tiles

    def put_all_aside(*given):
        render_tiles(*given)
        given[7][:] = True
        return 0

    monkeypatch.setattr(compositing, "render_tiles", put_all_aside)
