"""Far from the origin: exact in 64 bits, and told of in 32."""

from __future__ import annotations

import json
import re
from fractions import Fraction

import numpy as np
import pytest

from graphfx.cli.main import main

from ..cook.effects import made
from ..motion.one_particle import path
from .exactly import off

FAR = 1e8


@pytest.mark.parametrize("fps", [24, 25, 240, 23.976])
def test_a_place_far_away_keeps_its_displacement(fps):
    """At 1e8 m and 1 m/s the displacement after 10 s holds to 1e-7, whatever the steps: rounding does not add up."""
    frames = int(fps * 10)
    time = float(frames / Fraction(fps).limit_denominator(10**6))
    for direction in ((1, 0, 0), (0.6, 0, -0.8)):
        velocity = np.array(direction, float)
        for ops in ([], [{"type": "translate", "rate": velocity.tolist()}], [{"type": "wind", "wind": velocity.tolist()}]):
            own = velocity * 0 if ops and ops[0]["type"] == "translate" else velocity
            position, _ = path(ops, (FAR, -FAR, FAR), own, fps, frames)
            assert np.abs(position[-1] - [FAR, -FAR, FAR] - velocity * time).max() / 10 <= 1e-7


def test_rounding_does_not_add_up_beside_fields():
    """Composed with a field that is too weak to matter, a far particle's displacement holds to 1e-7 too."""
    position, _ = path([{"type": "attract", "strength": 1e-6, "falloff": 0}], (FAR, 0, 0), (1, 0, 0), 60, 600, "strang")
    assert off(position[-1, 0] - FAR, 10.0) <= 1e-5 / 2 + 1e-7


def reports(place: float, time: dict, out) -> list:
    """Return the reports of a cook of particles that stand at a place, and of others near the origin."""
    near = {"near": {"type": "emit", "rate": 48}}
    emit = {"rate": 48, "set": {"position": [0, place, 0], "velocity": [1, 0, 0]}}
    told: list = []
    effect = made((), emit, {"frames": [0, 3], **time}, {"from": ["sky", "near"], "size": [8, 8]}, near)
    effect.cook(out, report=told.append)
    return told


@pytest.mark.parametrize("place", [1e6, -3e7])
def test_particles_far_away_are_told_of_once(place, tmp_path):
    """In 32 bits a cook warns once of each source that has particles at 1e6 m and more, at its place in the document."""
    warnings = [warning for report in reports(place, {}, tmp_path) for warning in report.warnings]
    size, apart = (f"{abs(place):,.0f}", {1e6: "0.0625", -3e7: "2"}[place])
    place_in_document, _, said = str(warnings[0]).partition(": nodes.sky: ")
    assert len(warnings) == 1 and re.fullmatch(r"test\.json:\d+:\d+", place_in_document)
    assert said == (
        f"from frame 0 on there are particles at coordinates of {size} m, where 32 bits tell places "
        f'{apart} m apart at best; add "precision": 64 to `time`, or bring the scene nearer to the origin'
    )


@pytest.mark.parametrize("place, time", [(9.9e5, {}), (1e8, {"precision": 64})])
def test_no_others_are_told_of(place, time, tmp_path):
    """Nearer ones, and those of 64 bits, are not told of."""
    assert not any(report.warnings for report in reports(place, time, tmp_path))


def test_surfaces_as_large_are_told_of_once(tmp_path):
    """A floor made of a sphere of 1e9 m stands 64 m apart at best in 32 bits: that is told at its first length, once."""
    floor = {"type": "bounce_sphere", "center": [0, -1e9, 0], "sphere_radius": 1e9}
    told: list = []
    for precision in (32, 64):
        made([floor], {}, {"frames": [0, 2], "precision": precision}, {"size": [8, 8]}).cook(tmp_path, report=told.append)
    (warning,), *others = (report.warnings for report in told)
    assert not any(others) and warning.path == "nodes.act/bounce_sphere.center" and warning.location.line > 0
    assert warning.message.startswith("its center is 1,000,000,000 m, where 32 bits tell places 64 m apart at best; add")


def test_the_command_tells_of_them(tmp_path, monkeypatch, capsys):
    """`graphfx cook` warns on stderr, and with --json in the line of the frame."""
    monkeypatch.chdir(tmp_path)
    document = made((), {"set": {"position": [0, 2e6, 0]}}, {"frames": [1, 2]}, {"size": [8, 8]}).flat
    assert document.time.last == 2
    graph = {
        "graphfx": 1,
        "time": {"frames": [1, 2]},
        "nodes": {
            "sky": {"type": "emit", "set": {"position": [0, 2e6, 0]}},
            "view": {"type": "camera"},
            "frames": {"type": "image", "from": "sky", "camera": "view", "size": [8, 8]},
        },
    }
    (tmp_path / "far.json").write_text(json.dumps(graph))
    for options in ([], ["--json"]):
        with pytest.raises(SystemExit) as end:
            main.main(["cook", "far.json", *options])
        out, err = capsys.readouterr()
        assert not end.value.code
        told = [line for line in (out if options else err).splitlines() if "nodes.sky: from frame 1 on" in line]
        assert len(told) == 1 and (options or told[0].startswith("warning: far.json:1:"))
