"""An effect with much of the language in it, in Python."""

from __future__ import annotations

import graphfx


def fireworks() -> graphfx.Graph:
    """Return the graph that fireworks.json holds."""
    g = graphfx.Graph("Fireworks over a hard ground.", seed=3, frames=(1, 48))
    g.attribute("heat", 1000, unit="K", doc="Temperature.")
    lift = g.param("lift", 9.0, min=0, unit="m/s", doc="Speed of the rockets.")
    g.values(shine=g.keys((0, 1), (2, 0), interpolation="smooth"))
    rocket = g.emit("rocket", rate=3, life=1.2, clusters={"hue": {"count": 5, "by": "turn"}}, set={
        "velocity": g.in_cone(angle=15, length=lift),
        "color": g.rand((1, 0.2, 0), (1, 1, 0.3), per="hue", vary=0.1),
    })
    up = rocket.stack("up").gravity().bounce_plane("ground", resilience=0.5)
    sparks = up.spawn("sparks", when="death", count=200, spread=4, life=g.rand(0.5, 1.5), set={
        "radius": 0.01, "heat": g.expr("parent.heat * shine")})
    splash = up.spawn("splash", when={"hit": ["up/ground"]}, count=5, inherit=["color"], set={
        "velocity": g.expr("hit.normal * hit.speed")})
    fall = sparks.stack("fall").gravity()
    fall.set("white", only=g.inside_sphere() & ~g.expr("age > 1"), set={"color": (1, 1, 1)})
    fall.set("glow", set={"opacity": g.ramp((0, 0), (1000, 1), over="heat")})
    hot = fall.older_than("old", seconds=0.2)
    g.image("frames", of=[hot.look(blend="add"), splash], camera=g.camera("view"), size=(64, 36))
    return g
