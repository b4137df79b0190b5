"""Random scenes for the renderer's tests, and how a render is held against the reference."""

from __future__ import annotations

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


def cut(whole: Streaks, *moments: float, joined: bool = True) -> Streaks:
    """Return streaks in pieces that meet at moments between head (0) and tail (1), everything being even in time."""
    bounds = np.float64([0.0, *moments, 1.0])
    size, count = len(bounds) - 1, whole.count

    given = {}
    for side, at in (("head", bounds[:-1]), ("tail", bounds[1:])):
        for name, columns in (("", 3), ("_radius", 0), ("_color", 3), ("_opacity", 0)):
            shape = (columns, count) if columns else (count,)
            ends = getattr(whole, f"head{name}"), getattr(whole, f"tail{name}")
            both = (np.asarray(ends[0] if end is None else end, float) for end in ends)
            head, tail = (np.broadcast_to(end.reshape(columns, -1) if columns else end, shape)[..., None] for end in both)
            values = head + at * (tail - head)
            given[f"{side}{name}"] = values.reshape(*shape[:-1], count * size).astype(np.float32)
        given[f"{side}_moment"] = np.tile(at, count).astype(np.float32)
    bits = (np.arange(size) > 0) + 2 * (np.arange(size) < size - 1)
    share = np.repeat(np.broadcast_to(np.asarray(whole.share, np.float32), count), size)
    return Streaks(
        **given, share=share, part=np.tile(np.diff(bounds), count).astype(np.float32),
        joined=np.tile(bits * joined, count).astype(np.float32), blend=whole.blend, falloff=whole.falloff, streak=whole.streak,
    )


def path(points, radius, parts=None, **look) -> Streaks:
    """Return one path through points, head first; `parts` of the time of its pieces, as their lengths if not given."""
    places = np.array(points, float).T
    if parts is None:
        parts = np.hypot(*np.diff(places[:2], axis=1))
    bits = (np.arange(len(parts)) > 0) + 2 * (np.arange(len(parts)) < len(parts) - 1)
    head, tail = (ends.astype(np.float32) for ends in (places[:, :-1], places[:, 1:]))
    return Streaks(head, tail, radius, part=np.float32(parts / np.sum(parts)), joined=bits.astype(np.float32), **look)


def sort_all_whole(monkeypatch) -> None:
    """Let every group be sorted whole, as if its list had overflowed."""
    render_tiles = compositing.render_tiles

    def put_all_aside(*given):
        render_tiles(*given)
        given[7][:] = True
        return 0

    monkeypatch.setattr(compositing, "render_tiles", put_all_aside)
