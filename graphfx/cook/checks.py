"""What can be told before a cook: all that would keep it from beginning."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from graphfx.cook.cameras import check_views
from graphfx.cook.files import check_files
from graphfx.cook.limits import CookLimits, check_limits
from graphfx.cook.meshes import Meshes
from graphfx.cook.polygons import PolygonMaker
from graphfx.cook.writing import backdrops_of
from graphfx.errors import GraphfxError, Problem
from graphfx.plan.make import Plan


def problems_before(plan: Plan) -> list[Problem]:
    """Return what is wrong with a plan: file names, size, cameras, meshes, polygons, textures and background pictures."""
    time = plan.flat.time
    checks: list[Callable[[], object]] = [
        lambda: check_files(plan, Path(), range(time.first, min(time.first + 1, time.last) + 1)),
        lambda: check_limits(plan, CookLimits()),
        lambda: check_views(plan),
        lambda: _check_meshes(plan),
        lambda: PolygonMaker(Meshes(plan.flat)).prepare(plan.images, whole=True),
        lambda: backdrops_of(plan),
    ]
    problems: list[Problem] = []
    for check in checks:
        try:
            check()
        except GraphfxError as error:
            problems += [problem for problem in error.problems if problem not in problems]
    return problems


def _check_meshes(plan: Plan) -> None:
    meshes = Meshes(plan.flat)
    for emitter in plan.emitters.values():
        for made in emitter.made_programs:
            meshes.prepare(made)
        if "vertices" in emitter.node.references:
            meshes.vertices(emitter.node.references["vertices"])
