"""What is told of particles that could not be drawn: whose they are, and what is wrong with them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .effects import made

TEN: dict[str, Any] = {"count": 10, "rate": 0, "clusters": {"turn": {"count": 10}}}
BOX = {"in_box": {"min": [-1, 1, -1], "max": [1, 2, 1]}}
WRONG: dict[str, dict[str, Any]] = {
    "position": {"position": {"expr": "vec(1 / (turn - 3), 0, 0)"}}, "radius": {"radius": {"expr": "sqrt(turn - 2.5)"}},
    "color": {"color": {"expr": "vec(1, log(turn - 3.5), 1)"}}, "opacity": {"opacity": {"expr": "1 / (turn - turn)"}},
}
"""What is wrong with particle 3; with 0 to 2; with 0 to 3; and with all."""
COUNTS = {"position": 1, "radius": 3, "color": 4, "opacity": 10}


@pytest.mark.parametrize("attribute", WRONG)
def test_faults_name_stream_attribute_and_count(attribute, tmp_path):
    """Of ten particles those whose attribute is not finite are told of, by the stream and the attribute, in the frame."""
    found = made([], {**TEN, "set": {"position": BOX, **WRONG[attribute]}}, {"frames": [1, 2]})
    reports = []
    found.cook(tmp_path, report=reports.append)
    assert [report.faults for report in reports] == [(("sky", attribute, COUNTS[attribute]),)] * 2
    assert [report.dropped for report in reports] == [COUNTS[attribute]] * 2


def test_one_with_several_faults_is_told_of_once():
    """The first of its attributes is named, so that numbers add up to those that are not drawn."""
    film = made([], {**TEN, "set": {**WRONG["radius"], **WRONG["position"], **WRONG["color"]}}).film(1)
    assert film.dropped == sum(count for _, _, count in film.faults) == 4
    assert [(attribute, count) for _, attribute, count in film.faults] == [("position", 1), ("radius", 3)]


def test_what_is_whole_has_no_faults():
    """Nothing is told where all is finite."""
    film = made([], {**TEN, "set": {"position": BOX}}).film(1)
    assert film.dropped == 0 and list(film.faults) == [] and np.isfinite(film.pixels).all()


def test_cutoff_is_taken_at_the_time_of_the_frame():
    """Where the cutoff grows with time, a wall of dust hides what is behind from then on."""
    wall = {"count": 400, "rate": 0, "set": {"position": {"in_box": {"min": [-0.1, 0, -9], "max": [0.1, 0.1, 9]}}, "opacity": 0.9,
                                             "radius": 2.0}}
    image = {"cutoff": {"keys": [[0, 0], [1, 0.5]]}}
    cut, whole = made([], wall, {"frames": [1, 25]}, image), made([], wall, {"frames": [1, 25]})
    for frame, same in ((1, True), (25, False)):
        assert np.array_equal(cut.film(frame).pixels, whole.film(frame).pixels) == same
