"""Bounces off meshes, sheets, boxes: nothing leaks, energy is kept, and what rests, rests."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import graphfx
from graphfx.geometry import Mesh, box, sphere, torus
from graphfx.geometry.mesh import transform
from graphfx.geometry.tables import MeshTables
from graphfx.node import Library
from tests.geometry.lanes import PRECISIONS, function_of, on_lanes

INSIDE = function_of(Library()["inside_mesh"])
BALL = {"type": "mesh_sphere", "subdivisions": 3, "sphere_radius": 2}
RING = {"type": "mesh_torus", "ring_radius": 1.5, "tube_radius": 0.6}
ROOM = {"type": "mesh_box", "size": [3, 2, 3]}
FLOOR = {"type": "mesh_grid", "width": 4, "depth": 4, "columns": 20, "rows": 20}
MESHES = {"ball": (BALL, sphere(2.0, 3)), "ring": (RING, torus(1.5, 0.6, 48, 24)), "room": (ROOM, box((3, 2, 3)))}
STARTS = {"ball": {"in_sphere": {"radius": 1.5}}, "ring": [1.5, 0, 0],
          "room": {"in_box": {"min": [-1, -0.9, -1], "max": [1, 0.9, 1]}}}
WALLS = {"elastic": {"resilience": 1}, "dull": {"resilience": 0, "friction": 0}, "rough": {"resilience": 0.5, "friction": 0.3},
         "sticky": {"resilience": 0, "friction": 1}, "smooth": {"resilience": 0.9, "friction": 0}}


@pytest.fixture
def state(tmp_path: Path) -> Any:
    """Return a function that gives position, velocity and who rests at a frame of particles under operators."""

    def find(mesh: dict, ops: list, emit: dict, frame: int, count: int, precision: int = 32, reference: bool = False) -> Any:
        nodes = {
            "shape": mesh, "dust": {"type": "emit", "count": count, "set": emit},
            "way": {"type": "stack", "from": "dust", "ops": ops},
            "view": {"type": "camera", "position": [0, 0, 9]},
            "picture": {"type": "image", "from": "way", "camera": "view", "size": [16, 16]},
        }
        path = tmp_path / "bounce.json"
        time = {"frames": [1, frame], "precision": precision}
        path.write_text(json.dumps({"graphfx": 1, "seed": 5, "time": time, "nodes": nodes}))
        found = graphfx.load(path).simulate(frame, reference=reference)["dust"]
        return found["position"], found["velocity"], found["resting"]

    return find


def bounce(**wall: float) -> dict:
    """Return the operator that bounces off the mesh."""
    return {"type": "bounce_mesh", "mesh": "shape", **wall}


def outside(mesh: Mesh, position: np.ndarray) -> int:
    """Return how many points are not inside a closed mesh."""
    return int((on_lanes(INSIDE, [position.astype(float), MeshTables(mesh, True)], 64)[0] == 0).sum())


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("name", MESHES)
def test_nothing_leaks_out_of_a_closed_mesh(name: str, wall: str, precision: int, state: Any) -> None:
    """Particles that spiral and fall inside a closed mesh stay inside, whatever its walls are like."""
    node, mesh = MESHES[name]
    ops = [{"type": "gravity"}, {"type": "spiral", "speed": 3}, bounce(**WALLS[wall])]
    emit = {"position": STARTS[name], "velocity": {"in_sphere": {"radius": 12}}}
    position, velocity, _ = state(node, ops, emit, 40, 1500, precision)
    assert outside(mesh, position) == 0
    assert np.isfinite(velocity).all()


@pytest.mark.slow
@pytest.mark.parametrize(("name", "wall"), [("ring", "smooth"), ("ball", "rough"), ("room", "elastic")])
def test_nothing_leaks_in_the_long_run(name: str, wall: str, state: Any) -> None:
    """Of a hundred thousand particles none has left a closed mesh after 240 frames."""
    node, mesh = MESHES[name]
    ops = [{"type": "gravity"}, {"type": "spiral", "speed": 3}, bounce(**WALLS[wall])]
    emit = {"position": STARTS[name], "velocity": {"in_sphere": {"radius": 12}}}
    assert outside(mesh, state(node, ops, emit, 240, 100_000)[0]) == 0


@pytest.mark.parametrize("precision", PRECISIONS)
def test_elastic_walls_keep_the_speed(precision: int, state: Any) -> None:
    """Without forces the speed of each particle is what it was at first, after tens of bounces."""
    emit = {"position": [0.3, 0.1, 0], "velocity": {"on_sphere": {"radius": 50}}}
    _, velocity, _ = state(BALL, [bounce(resilience=1)], emit, 30, 500, precision)
    assert np.abs(np.sqrt((velocity.astype(float) ** 2).sum(axis=1)) / 50 - 1).max() < (1e-4 if precision == 32 else 1e-12)


@pytest.mark.parametrize("speed", [1, 100, 1e4, 1e6])
@pytest.mark.parametrize("precision", PRECISIONS)
def test_no_speed_gets_through_a_sheet(precision: int, speed: float, state: Any) -> None:
    """Particles thrown at a thin sheet, straight or aslant, all stay on their side and stick."""
    emit = {"position": {"in_box": {"min": [-0.5, 0.1, -0.5], "max": [0.5, 0.4, 0.5]}},
            "velocity": {"in_cone": {"direction": [0, -speed, 0], "angle": 60, "length": speed}}}
    position, velocity, resting = state(FLOOR, [bounce(resilience=0, friction=1)], emit, 32, 2000, precision)
    assert (position[:, 1] > 0).all() and (position[:, 1] < 1e-4).all()
    assert resting.all() and not velocity.any()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_edges_and_corners_hold(precision: int, state: Any) -> None:
    """Particles that hit a sheet just where its faces meet bounce like all others."""
    emit = {"position": {"at_vertices": {"mesh": "shape"}}, "velocity": [0, -30, 0]}
    raised = {**FLOOR, "translate": {"keys": [[0, [0, 1, 0]], [0.04, [0, 0, 0]]], "interpolation": "step"}}
    position, velocity, _ = state(raised, [bounce(resilience=0.5)], emit, 4, 441, precision)
    assert (position[:, 1] > 0).all()
    assert np.allclose(velocity, [0, 15, 0], rtol=1e-6)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_what_rests_on_a_mesh_floor_stays(precision: int, state: Any) -> None:
    """Falling on a floor with friction all particles come to rest, and do not sink."""
    emit = {"position": {"in_box": {"min": [-1, 0.1, -1], "max": [1, 1, 1]}}}
    fall = [{"type": "gravity"}, bounce(resilience=0.3, friction=0.5)]
    position, velocity, resting = state(FLOOR, fall, emit, 80, 1000, precision)
    later = state(FLOOR, fall, emit, 120, 1000, precision)[0]
    assert resting.all() and not velocity.any()
    assert (position == later).all() and (position[:, 1] > 0).all() and (position[:, 1] < 1e-4).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_mesh_is_a_plane_where_it_is_flat(precision: int, state: Any) -> None:
    """Bounces off a tilted grid are those off the plane in which it lies, but for the skin."""
    wide = {"type": "mesh_grid", "width": 60, "depth": 60, "columns": 30, "rows": 30, "rotate": [0, 0, -30]}
    emit = {"position": {"in_box": {"min": [-1, 2, -1], "max": [1, 4, 1]}}}
    wall = {"resilience": 0.8, "friction": 0.2}
    plane = {"type": "bounce_plane", "normal": [0.5, 0.8660254037844386, 0], **wall}
    ours, theirs = (state(wide, [{"type": "gravity"}, op], emit, 30, 300, precision)[0] for op in (bounce(**wall), plane))
    assert np.abs(ours - theirs).max() < (5e-3 if precision == 32 else 1e-9)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_born_on_a_mesh_they_are_in_front_of_it(precision: int, state: Any) -> None:
    """Particles born on a floor and pulled into it stay on top."""
    emit = {"position": {"on_surface": {"mesh": "shape"}}}
    position, _, _ = state(FLOOR, [{"type": "gravity"}, bounce(resilience=0, friction=1)], emit, 12, 1000, precision)
    assert (position[:, 1] > -1e-5).all() and (position[:, 1] < 1e-4).all()


@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_disc_is_a_round_sheet(precision: int, state: Any) -> None:
    """Over a disc particles bounce from either side; beyond its rim they go by."""
    emit = {"position": {"in_box": {"min": [-2, 1, -2], "max": [2, 1, 2]}}, "velocity": [0, -40, 0]}
    position, velocity, _ = state(FLOOR, [{"type": "bounce_disc", "disc_radius": 1.5, "resilience": 1}], emit, 4, 2000, precision)
    over = np.hypot(position[:, 0], position[:, 2]) < 1.5
    assert (velocity[over, 1] > 0).all() and (velocity[~over, 1] < 0).all() and 0 < over.sum() < 2000


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize(("ops", "emit"), [
    ([{"type": "gravity"}, bounce(resilience=0.4, friction=0)],
     {"position": STARTS["ball"], "velocity": {"in_sphere": {"radius": 9}}}),
    ([bounce(resilience=1), {"type": "bounce_disc", "disc_radius": 1, "resilience": 0.5}],
     {"position": {"in_sphere": {"radius": 1}}, "velocity": {"in_sphere": {"radius": 60}}}),
], ids=["slides", "with a disc"])
def test_machine_agrees_with_plain_python(ops: list, emit: dict, precision: int, state: Any) -> None:
    """What many particles do together on the machine is what each does alone in plain Python, to the last bit."""
    coarse = {**BALL, "subdivisions": 1}
    machine, reference = (state(coarse, ops, emit, 9, 40, precision, reference=plain) for plain in (False, True))
    assert all(ours.tobytes() == theirs.tobytes() for ours, theirs in zip(machine, reference, strict=True))


@pytest.mark.parametrize("precision", PRECISIONS)
def test_a_particle_moves_alone_as_among_many(precision: int, state: Any) -> None:
    """What others in its block meet, and how long the search for their contacts takes, changes no bit of a particle."""
    ops = [{"type": "gravity"}, {"type": "spiral", "speed": 3}, bounce(resilience=0.8)]
    emit = {"position": STARTS["ring"], "velocity": {"in_sphere": {"radius": 10}}}
    many, few = (state(RING, ops, emit, 60, count, precision) for count in (900, 30))
    assert all(every[:30].tobytes() == alone.tobytes() for every, alone in zip(many, few, strict=True))


def test_a_moved_mesh_is_met_where_it_stands(state: Any) -> None:
    """A floor that was moved, turned and stretched is met there."""
    placed = {**FLOOR, "translate": [0, -3, 0], "rotate": [180, 0, 0], "scale": [2, 1, 2]}
    emit = {"position": {"in_box": {"min": [-3.5, 0, -3.5], "max": [3.5, 0, 3.5]}}, "velocity": [0, -100, 0]}
    position, _, _ = state(placed, [bounce(resilience=0, friction=1)], emit, 4, 300)
    assert np.allclose(position[:, 1], -3, atol=1e-3)
    assert np.allclose(transform((0, -3, 0), (180, 0, 0), (2, 1, 2))[0] @ [1, 0, 0], [2, 0, 0])


@pytest.mark.parametrize("precision", PRECISIONS)
@pytest.mark.parametrize(("op", "inside"), [
    ({"type": "bounce_box", "size": [3, 2, 3], "inside": True}, lambda p: (np.abs(p) <= [1.5001, 1.0001, 1.5001]).all(axis=1)),
    ({"type": "bounce_sphere", "sphere_radius": 1.8, "inside": True}, lambda p: (p**2).sum(axis=1) < 1.8001**2),
], ids=["box", "sphere"])
def test_containers_hold(op: dict, inside: Any, precision: int, state: Any) -> None:
    """Hollow boxes and spheres keep their particles, elastically."""
    emit = {"position": {"in_sphere": {"radius": 0.9}}, "velocity": {"on_sphere": {"radius": 20}}}
    position, velocity, _ = state(FLOOR, [{**op, "resilience": 1}], emit, 40, 1000, precision)
    assert inside(position.astype(float)).all()
    assert np.allclose(np.sqrt((velocity.astype(float) ** 2).sum(axis=1)), 20, rtol=1e-4)


def test_a_solid_box_keeps_out(state: Any) -> None:
    """Particles that fall on a box lie on its lid or fall past it."""
    emit = {"position": {"in_box": {"min": [-1, 0.6, -1], "max": [1, 0.9, 1]}}}
    ops = [{"type": "gravity"}, {"type": "bounce_box", "resilience": 0, "friction": 1}]
    position, _, resting = state(FLOOR, ops, emit, 20, 1000)
    over = (np.abs(position[:, [0, 2]]) < 0.5).all(axis=1)
    assert (resting == over).all()
    assert np.allclose(position[over, 1], 0.5, atol=1e-5)
