"""When particles are born and die: the same instants whatever the frames and steps."""

from __future__ import annotations

import numpy as np
import pytest

from graphfx.errors import LimitError

from .effects import effect, graph, made, streaks_at

STILL = {"velocity": [0, 0, 0]}


def birth_times(emit, time, frame=None) -> np.ndarray:
    """Return all times of birth up to a frame, by default the last, of particles that live on."""
    found = made([], {"life": 1e6, **emit}, time)
    return found.simulate(frame or found.flat.time.last)["sky"]["birth"]


@pytest.mark.parametrize("substeps", [1, 3])
@pytest.mark.parametrize("fps", [24, 30, 60, 23.976, 7.3])
@pytest.mark.parametrize("rate", [10, 24, 29.97, 1000, 0.7])
def test_k_th_particle_is_born_at_k_over_rate(rate, fps, substeps):
    """At a steady rate the k-th birth is at k / rate to the last bit, whatever the frames and steps."""
    last = int(fps * 2) + 1
    times = birth_times({"rate": rate}, {"fps": fps, "frames": [1, last], "substeps": substeps})
    end = (last - 1) / fps
    wanted = np.arange(len(times)) / rate
    assert np.array_equal(times, wanted) and wanted[-1] <= end + 1e-12 < (len(times) + 1e-9) / rate


@pytest.mark.parametrize("preroll", [0.5, 1, 0.13])
def test_births_begin_with_the_preroll(preroll):
    """The first particle is born as the simulation begins, the k-th k / rate later."""
    times = birth_times({"rate": 50}, {"preroll": preroll, "frames": [5, 20]})
    assert np.array_equal(times, -preroll + np.arange(len(times)) / 50)


def test_frames_split_births_only_once():
    """Every birth falls in one interval: none is lost or doubled at the borders of 1e4 frames."""
    for rate in (24, 30, 97, 0.3):
        times = birth_times({"rate": rate}, {"fps": 24, "frames": [1, 1000]})
        assert len(times) == int(np.floor(999 / 24 * rate + 1e-9)) + 1


@pytest.mark.parametrize("rate", [100, {"keys": [[0, 100]]}, {"expr": "100 + 0 * time"}])
@pytest.mark.parametrize(
    "during, first, count", [([0.1, 0.3], 0.1, 21), ([-5, 0.3], 0, 31), ([0.105, 0.2], 0.105, 10), ([0.3, 9], 0.3, 16)]
)
def test_births_are_limited_to_during(rate, during, first, count):
    """`during` begins with a birth and ends the births, inside frames too, for a rate that may change as well."""
    times = birth_times({"rate": rate, "during": during}, {"frames": [1, 12], "fps": 24})
    assert len(times) == count
    np.testing.assert_allclose(times, first + np.arange(count) / 100, rtol=0, atol=1e-12)


def test_keyed_rate_integrates():
    """With a rate of 200 t the k-th particle is born where 100 t^2 passes k, to the square of a frame."""
    times = birth_times({"rate": {"keys": [[0, 0], [10, 2000]]}}, {"frames": [1, 49], "fps": 48})
    assert len(times) == 101
    np.testing.assert_allclose(times, np.sqrt(np.arange(101) / 100), rtol=0, atol=1 / 48)
    np.testing.assert_allclose(times[50:], np.sqrt(np.arange(50, 101) / 100), rtol=0, atol=1 / 48**2)


@pytest.mark.parametrize("rate", [0, {"keys": [[0, 0]]}, {"expr": "-1 - time"}])
def test_no_rate_no_particles(rate):
    """At a rate of 0 or less, nothing is born."""
    found = made([], {"rate": rate, "life": 1, "set": {"velocity": [1, 0, 0]}})
    assert found.simulate(12)["sky"]["position"].shape == (0, 3)


def test_particle_dies_at_its_exact_time():
    """A particle with life L is there in frames before birth + L and not from then on."""
    found = made([], {"rate": 1, "during": [0, 0.5], "life": 0.25, "set": {"velocity": [1, 0, 0]}}, {"fps": 8, "frames": [1, 9]})
    assert [len(found.simulate(frame)["sky"]["position"]) for frame in range(1, 6)] == [1, 1, 0, 0, 0]


def test_particle_stops_where_it_died():
    """In the frame of its death a particle has moved until then, no farther."""
    found = made(
        [],
        {"rate": 1, "during": [0, 0.5], "life": 0.3, "set": {"velocity": [2, 0, 0], "position": [0, 0, 0]}},
        {"fps": 4, "frames": [1, 5]},
    )
    simulation = found.simulation()
    for frame in simulation.frames(3):
        if frame == 3:
            store = simulation.particles["sky"].store
            np.testing.assert_allclose(store.column("position")[0], [0.6], rtol=1e-6)


def test_born_and_dead_within_a_frame():
    """Particles that live and die between two frames are never shown, but are exposed for their time."""
    found = made([], {"rate": 40, "life": 0.02, "set": {"velocity": [1, 0, 0]}}, {"fps": 10, "frames": [1, 3]}, {"shutter": 1.0})
    simulation = found.simulation()
    frame = list(simulation.frames(2))[-1]
    sky = simulation.particles["sky"]
    assert frame == 2 and sky.alive == 1  # the one born at 0.1
    streaks = streaks_at(simulation, 0.1, 0.0)[0]
    np.testing.assert_allclose(sorted(streaks.share), [0.2, 0.2, 0.2, 0.2], atol=1e-6)


def test_shares_of_the_shutter():
    """A particle that lives through the shutter has 1; one born or dying in it the part for which it lived."""
    found = made([], {"rate": 10, "life": 0.25, "set": {"velocity": [1, 0, 0]}}, {"fps": 4, "frames": [1, 5]}, {"shutter": 0.8})
    simulation = found.simulation()
    frame = list(simulation.frames(3))[-1]
    streaks = streaks_at(simulation, 0.5, 0.3)[0]
    births = np.arange(6) / 10
    wanted = (np.minimum(births + 0.25, 0.5) - np.maximum(births, 0.3)) / 0.2
    assert frame == 3
    np.testing.assert_allclose(streaks.share, wanted[wanted > 1e-9], atol=1e-6)


def test_infinite_life_and_longer_cooks():
    """Without a life nothing dies, and `birth` is not even stored."""
    columns = made([], {"rate": 10, "set": {"velocity": [1, 0, 0]}}, {"frames": [1, 49]}).simulate(49)["sky"]
    assert len(columns["position"]) == 21 and "birth" not in columns


def test_positions_do_not_depend_on_frames_or_steps():
    """Free fall from exact births: at one instant, particles are in the same places at 24, 30 and 60 frames a second."""
    places = []
    for fps, steps in ((24, 1), (30, 3), (60, 1), (1, 1)):
        document = graph(
            [{"type": "gravity"}], {"rate": 7}, {"fps": fps, "frames": [1, fps + 1], "substeps": steps, "precision": 64}
        )
        places.append(effect(document).simulate(fps + 1)["sky"]["position"])
    for other in places[1:]:
        np.testing.assert_allclose(other, places[0], rtol=0, atol=1e-12)


def test_constant_rate_beyond_the_limit_is_refused_before_work():
    """A rate that would make more particles than the limit is told with its place, and nothing is simulated."""
    told = r"nodes\.sky: about [\d,]+ particles would be alive at once, and the limit is 100,000,000"
    with pytest.raises(LimitError, match=told):
        made([], {"rate": 1e30}).simulate(2)


def test_births_in_a_short_time_count_only_that_time():
    """A great rate during a short time makes few particles, and is no matter for a limit."""
    columns = made([], {"rate": 1e9, "during": [0, 1e-6]}).simulate(2)
    assert 1000 <= len(columns["sky"]["position"]) <= 1001


def test_changing_rate_beyond_all_memory_is_told():
    """More births in a frame than could ever be held are a limit, told with the place in the graph."""
    with pytest.raises(LimitError) as caught:
        made([], {"rate": {"expr": "1e12 + time"}}).simulate(2)
    assert str(caught.value).endswith("particles would be born in one frame, and the limit is 1,073,741,824; lower the rate")
    assert "nodes.sky.rate: 41," in str(caught.value)
