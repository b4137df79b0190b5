"""What a version does not carry out is told before any work, at its place, and never done wrongly in silence."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphfx.errors import GraphError
from graphfx.graph.document import document_of
from graphfx.graph.flatten import flatten
from graphfx.node import Library, library_roots
from graphfx.plan.make import make_plan

from .test_leaving_out import plan

NODE = '''"""A node of a user."""

from graphfx.math import Vec3
from graphfx.node import operator, param


@operator.{role}(writes={writes})
def odd({reads}, share: float = param(0.0, doc="A number.")) -> {result}:
    """Return something."""
    return {value}
'''
ODD = {
    "linear radius": (
        "linear",
        '"radius"',
        "radius: float",
        "float",
        "radius",
        "a linear operator that writes radius is not carried out by this version; it may write position or velocity",
    ),
    "flow radius": (
        "flow",
        '"radius"',
        "radius: float",
        "float",
        "radius",
        "a flow operator that writes radius is not carried out by this version; it may write position or velocity, or both",
    ),
    "turns both": (
        "flow",
        '("position", "velocity")',
        "position: Vec3, velocity: Vec3, dt: float",
        "tuple[Vec3, Vec3]",
        "position, velocity * dt",
        "it writes position and velocity, and so must be the whole motion of a particle on which nothing else acts, "
        "P' = P + V dt + ... with both read; write what moves particles otherwise as two operators",
    ),
    "carries unseen": (
        "flow",
        '("position", "velocity")',
        "position: Vec3, dt: float",
        "tuple[Vec3, Vec3]",
        "position, position",
        "it writes position and velocity, and so must be the whole motion of a particle on which nothing else acts, "
        "P' = P + V dt + ... with both read; write what moves particles otherwise as two operators",
    ),
    "noise of a place": (
        "noise",
        '"velocity"',
        "position: Vec3, draw: tuple",
        "Vec3",
        "position * draw[0]",
        "a noise operator holds what it gives for 1/24 s, and so may not read the position or the velocity; write "
        "what follows a particle as an acceleration, or as an applied velocity, of a field such as curl_noise",
    ),
    "identity": (
        "flow",
        '"position"',
        "position: Vec3, id: int",
        "Vec3",
        "position",
        "functions for particles are not given 'id' in this version",
    ),
}


@pytest.mark.parametrize("case", ODD)
def test_operators_that_would_be_done_wrongly_are_refused(case, tmp_path: Path):
    """A declaration that the engine has no method for is told at the node's own file and line."""
    role, writes, reads, result, value, message = ODD[case]
    file = tmp_path / "nodes" / "operators" / "odd.py"
    file.parent.mkdir(parents=True)
    file.write_text(NODE.format(role=role, writes=writes, reads=reads, result=result, value=value))
    document = {
        "graphfx": 1,
        "nodes": {
            "sky": {"type": "emit"},
            "act": {"type": "odd", "from": "sky"},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "act", "camera": "view"},
        },
    }
    with pytest.raises(GraphError) as caught:
        make_plan(flatten(document_of(document), Library(library_roots([tmp_path]))))
    assert str(caught.value) == f"{file}:7: odd: {message}"


def test_names_that_particles_do_not_have_are_refused():
    """A name that no attribute or cluster of the particles bears is told with whose particles those are."""
    with pytest.raises(GraphError, match="the particles of 'sky' have no 'id'; if it is a cluster, give it to their emitter"):
        plan([{"type": "damp", "damping": {"expr": "id * 0.1"}}])


UNHEARD = {"hit": "meet no surface", "death": "never die"}


@pytest.mark.parametrize("moment", UNHEARD)
def test_what_waits_for_what_cannot_be_is_told(moment):
    """Hits where there is no surface, and deaths of what lives for ever, are told at who waits; not where a switch is off."""
    operator = {"type": "set", "when": moment, "set": {"radius": 1}}
    with pytest.raises(GraphError, match=f"set waits for a {moment}, and the particles of 'sky' {UNHEARD[moment]}"):
        plan([operator])
    plan([operator, {"type": "bounce_plane", "enabled": False}, {"type": "kill", "enabled": False}])
