"""The effect of tests/snow.json, in Python."""

from __future__ import annotations

import graphfx


def snow() -> graphfx.Graph:
    """Return the graph that tests/snow.json holds."""
    g = graphfx.Graph("Snow, crossed by one gust, as tests need it: it stays as it is, whatever becomes of the effect.",
                      seed=7, fps=24, frames=(1, 120), preroll=10)
    g.use("groups/gust.json")
    g.param("wind", 1.0, min=0, doc="Strength of the gust.")
    sky = g.emit("sky", rate=4000, life=14, set={
        "position": g.in_box(min=(-11, 7, -14), max=(11, 8, 3)),
        "velocity": g.in_cone(direction=(0, -1, 0), angle=14, length=g.rand(1.3, 2.1)),
        "spiral_axis": g.in_cone(direction=(0, -1, 0), angle=25),
        "radius": g.rand(0.008, 0.024),
        "color": g.rand((0.6, 0.74, 0.95), (1, 1, 1)),
        "opacity": g.rand(0.55, 1),
    })
    fall = (
        sky.stack("fall")
        .spiral(speed=g.rand(2, 6))
        .gust(during=(0.5, 4.5), start=(-14, 3, -3), end=(14, 3, -3), strength=g.expr("7 * param.wind"), range=5, spacing=3.2,
              tightness=1.2)
        .bounce_plane(response="stick")
    )
    view = g.camera("view", position=(0, 1.6, 9), target=(0, 2.4, 0), lens=30, near=1)
    g.image("frames", of=fall.look(streak="solid"), camera=view, shutter=0.4, background=(0.004, 0.008, 0.022))
    return g
