"""What a plan keeps of the past, for shutters."""

from __future__ import annotations

import pytest

from graphfx.plan.listing import plan_data
from graphfx.plan.shutter import exposure_of

from .test_leaving_out import plan


def plan_of(shutter: float):
    """Return the plan of falling particles under a shutter."""
    return plan([{"type": "gravity"}], {"set": {"velocity": [0, 1, 0]}}, {"shutter": shutter})


@pytest.mark.parametrize(
    "windows, columns",
    [
        ([(0, 0)], []),
        ([(0, 0.5)], ["tail"]),
        ([(0, 1.0), (0, 0.3)], ["tail"]),
        ([(0, 1.5)], ["tail", "path 1", "path 1.5"]),
        ([(0, 2.0)], ["tail", "path 2"]),
        ([(0, 2.25)], ["tail", "path 1", "path 1.25", "path 2", "path 2.25"]),
        ([(0.25, 0.5)], ["path 0.25", "tail"]),
        ([(0.5, 0.5)], ["path 0.5", "tail"]),
        ([(0.5, 1.0)], ["tail", "path 1", "path 1.5"]),
    ],
)
def test_only_what_a_shutter_needs_is_kept(windows, columns):
    """A shutter within the frame keeps one place; each frame more keeps what lies between as well."""
    assert [instant.column for instant in exposure_of(windows).instants] == columns


def test_plan_tells_what_is_kept():
    """The listing has the columns of the frames before, with their reason."""
    data = plan_data(plan_of(1.25))["emitters"][0]["attributes"]
    told = {column["name"]: column["reason"] for column in data}
    assert [told[name] for name in ("tail", "path 1", "path 1.25", "birth")] == [
        "where it was 0.25 frames before, for motion blur",
        "where it was 1 frame before, for motion blur",
        "where the shutter opened, for motion blur",
        "since when it is seen, for motion blur",
    ]
    data = plan_data(plan_of(1.0))["emitters"][0]["attributes"]
    assert not {column["name"] for column in data} & {"path 1", "birth"}
