"""How lives end and begin again: kill, die, stick, slide, recycle; none is lost, none doubled."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

from graphfx.cli.main import main
from graphfx.cook import lives
from graphfx.errors import CookError, GraphError

from .effects import effect, graph, particles, streaks_at

RATES = [(24, 1), (10, 2), (7, 1), (60, 1)]
FALL = {"count": 1, "rate": 0, "set": {"position": [0, 1, 0], "velocity": [1, -2, 0]}}
MANY = {
    "rate": 200,
    "life": {"rand": [0.05, 0.6]},
    "set": {"position": {"in_box": {"min": [-1, 0.1, -1]}}, "radius": {"rand": [0, 1]}},
}


def document(ops, emit=FALL, fps=24, substeps=1, seconds=1.0, nodes=None, image=None, **time):
    """Return a graph of some seconds in float64."""
    last = round(fps * seconds) + 1
    return graph(ops, emit, {"fps": fps, "substeps": substeps, "frames": [1, last], "precision": 64} | time, image, nodes)


def ends(found) -> list[float]:
    """Return the times of all deaths, in order."""
    simulation = found.simulation()
    return sorted(float(time) for _ in simulation.frames(found.flat.time.last) for time in simulation.particles["sky"].ended_at)


def last(found, source="sky"):
    """Return the particles of the last frame."""
    return found.simulate(found.flat.time.last)[source]


@pytest.mark.parametrize("fps, substeps", RATES)
@pytest.mark.parametrize(
    "ops", [[{"type": "bounce_plane", "response": "die"}], [{"type": "bounce_plane"}, {"type": "kill", "when": "hit"}]]
)
def test_death_at_a_hit_is_at_the_time_of_contact(fps, substeps, ops):
    """A fall of 1 m at 2 m/s ends at 0.5 s."""
    np.testing.assert_allclose(ends(effect(document(ops, fps=fps, substeps=substeps))), [0.5], rtol=0, atol=1e-14)


def test_what_is_killed_is_not_recycled():
    """Only who dies of age begins again: killed by the floor, at a step or at a frame, it is gone."""
    for op in (
        {"type": "bounce_plane", "response": "die"},
        {"type": "kill", "only": {"expr": "time > 0.49"}},
        {"type": "kill", "when": "frame", "only": {"expr": "time > 0.49"}},
    ):
        found = ends(effect(document([op, {"type": "recycle"}], FALL | {"life": 0.8})))
        np.testing.assert_allclose(found, [0.5], rtol=0, atol=1e-14)


@pytest.mark.parametrize("fps, substeps", RATES)
def test_kill_acts_as_a_step_starts(fps, substeps):
    """The first step that starts below half a metre ends the fall, at the very start of it."""
    found = ends(effect(document([{"type": "kill", "only": {"expr": "position.y < 0.4999999"}}], fps=fps, substeps=substeps)))
    step = fps * substeps
    np.testing.assert_allclose(found, [(np.floor(0.25 * step) + 1) / step], rtol=0, atol=1e-13)


def test_kill_at_a_frame_ends_with_it():
    """Who is killed as a frame ends is not there in that frame, and what it leaves is."""
    op = {"type": "kill", "when": "frame", "only": {"expr": "time > 0.3"}}
    spark = {
        "born": {"type": "spawn", "from": "act", "when": "death"},
        "spark": {"type": "set", "from": "born", "set": {"radius": {"expr": "time"}}},
    }
    found = effect(document([op], nodes=spark, image={"from": ["act", "spark"]}))
    for frame, (whole, left) in {8: (1, 0), 9: (0, 1), 10: (0, 1)}.items():
        at = found.simulate(frame)
        assert (len(at["sky"]["position"]), at["born"]["radius"].tolist()) == (whole, [(frame - 1) / 24] * left)
    assert ends(found) == [8 / 24]


def test_frames_end_for_those_whom_a_frame_has_killed_to_life():
    """What is set each frame is set for what is born as the frame ends, in every frame."""
    nodes = {
        "born": {"type": "spawn", "from": "act", "when": "death", "life": 9},
        "spark": {"type": "set", "from": "born", "set": {"radius": {"expr": "time"}}},
    }
    kill = {"type": "kill", "when": "frame", "only": {"expr": "age > 0.1"}}
    found = effect(document([kill], MANY | {"life": 9}, nodes=nodes, image={"from": ["act", "spark"]})).simulate(9)["born"]
    assert len(found["radius"]) > 30 and set(found["radius"].tolist()) == {8 / 24}


def test_what_dies_is_drawn_for_its_share_of_the_shutter():
    """Dying 1/4 of the way through the shutter, or born 1/4 before its end, it is drawn with a quarter of its opacity."""
    for emit, ops, share in (
        (FALL, [{"type": "bounce_plane", "response": "die"}], 0.25),
        (FALL | {"during": [0.875, 9]}, [{"type": "gravity"}], 0.25),
        (FALL | {"during": [0.75, 9], "life": 0.125}, [{"type": "gravity"}], 0.25),
    ):
        time = 1.0 if share == 0.25 and "during" in emit else 0.875
        found = effect(graph(ops, emit, {"fps": 1 / time, "frames": [1, 2], "precision": 64}, {"shutter": 1}))
        simulation = found.simulation()
        list(simulation.frames(2))
        opening = {0.875: 0.375, 1.0: 0.5}[time]
        made = streaks_at(simulation, time, opening)[0]
        np.testing.assert_allclose(made.share, [share], atol=1e-6)
        assert len(made.share) == 1


def test_what_sticks_stays_and_what_slides_goes_on():
    """From the contact at x = 0.5 what sticks stays there, and what slides keeps its 1 m/s along the floor."""
    for response, x in (("stick", 0.5), ("slide", 1.0)):
        found = last(
            effect(document([{"type": "gravity", "acceleration": [0, 0, 0]}, {"type": "bounce_plane", "response": response}]))
        )
        np.testing.assert_allclose(found["position"], [[x, 0, 0]], rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    "ops",
    [
        [],
        [{"type": "recycle", "only": {"expr": "radius > 0.5"}}],
        [{"type": "kill", "when": "frame", "only": {"share": {"fraction": {"expr": "time / 4"}}}}],
        [{"type": "bounce_plane", "response": "die"}, {"type": "kill", "only": {"expr": "position.y < 0.3"}}],
    ],
)
@pytest.mark.parametrize("preroll", [0, 0.13])
def test_no_particle_is_lost_or_doubled(ops, preroll):
    """Each is there from its birth until it is noted as dead, once; nobody comes back."""
    gravity = {"type": "gravity"}
    simulation = effect(
        document([gravity, *ops, {"type": "random_acceleration"}], MANY | {"count": 30, "every": 0.25}, preroll=preroll)
    ).simulation()
    before, gone = set(), set()
    for _ in simulation.frames(25):
        sky = simulation.particles["sky"]
        ids = sky.store.column("id")[0]
        dead, there = set(ids[sky.dying].tolist()), set(ids.tolist())
        assert len(there) == len(ids) and len(set(sky.dying.tolist())) == len(sky.dying)
        assert before <= there and not there & gone
        before, gone = there - dead, gone | dead
        assert len(before) == sky.alive
    assert len(gone) > 40 and (preroll > 0 or sky.store.next_ordinal == len(before | gone))


@pytest.mark.parametrize("fps, substeps", RATES)
@pytest.mark.parametrize("life", [0.3, 0.011])
def test_period_of_recycling_is_the_life(fps, substeps, life):
    """Lives of 0.3 s follow one another at multiples of it, and so do lives far shorter than a frame."""
    found = last(
        effect(
            document(
                [{"type": "gravity"}, {"type": "recycle"}, {"type": "set", "set": {"radius": {"expr": "lives"}}}],
                FALL | {"life": life},
                fps,
                substeps,
            )
        )
    )
    number = np.floor(1 / life)
    np.testing.assert_allclose(found["birth"], [number * life], rtol=0, atol=1e-12)
    assert found["radius"].tolist() == [number]
    age = 1 - number * life
    np.testing.assert_allclose(found["position"], [[age, 1 - 2 * age - 9.81 / 2 * age**2, 0]], rtol=0, atol=1e-12)


def test_life_begun_again_has_new_draws_and_the_same_id():
    """Each life draws anew, except what is drawn per particle; ids stay."""
    drawn = {"radius": {"rand": [0, 1]}, "mass": {"rand": [0, 1], "per": "particle"}}
    ops = [{"type": "recycle"}, {"type": "set", "set": {"color": {"expr": "vec(radius, mass, lives)"}}}]
    found = effect(document(ops, {"count": 9, "rate": 0, "life": 0.25, "set": drawn}))
    seen = [found.simulate(frame)["sky"] for frame in (1, 7, 13, 25)]
    assert [set(each["color"][:, 2].tolist()) for each in seen] == [{0.0}, {1.0}, {2.0}, {4.0}]
    assert all((each["id"] == seen[0]["id"]).all() and (each["color"][:, 1] == seen[0]["color"][:, 1]).all() for each in seen)
    assert len({float(radius) for each in seen for radius in each["color"][:, 0]}) == 36


def test_recycling_leaves_the_first_life_alone():
    """Until it dies a particle is to the last bit what it is without `recycle`."""
    emit = MANY | {"life": 0.4}
    once, again = (
        effect(document([{"type": "gravity"}, {"type": "turbulence"}, *more], emit)) for more in ([], [{"type": "recycle"}])
    )
    for frame in (3, 9):
        first, second = once.simulate(frame)["sky"], again.simulate(frame)["sky"]
        assert all(np.array_equal(first[name], second[name]) for name in first)


def test_recycle_on_a_condition_begins_as_the_step_starts():
    """A drop that is past the edge as a step starts begins again then, at the top."""
    found = effect(document([{"type": "recycle", "when": "step", "only": {"expr": "position.y < -0.01"}}], fps=10, seconds=2))
    np.testing.assert_allclose(found.simulate(6)["sky"]["position"], [[0.5, 0, 0]], atol=1e-13)
    np.testing.assert_allclose(last(found)["position"], [[0.2, 0.6, 0]], atol=1e-13)
    assert ends(found) == []


def test_recycle_at_a_hit_begins_at_the_contact():
    """What is recycled at hits at 0.5 s, 1 s, ... is there at 0.7 s as it was at 0.2 s."""
    ops = [{"type": "bounce_plane"}, {"type": "recycle", "when": "hit"}]
    np.testing.assert_allclose(
        last(effect(document(ops, fps=7, seconds=5 / 7)))["position"], [[5 / 7 - 0.5, 1 - 2 * (5 / 7 - 0.5), 0]], atol=1e-13
    )


def test_endless_recycling_is_told(monkeypatch, tmp_path):
    """Lives of no length are stopped with a message and exit code 5, without a traceback."""
    monkeypatch.setattr(lives, "MOST_TURNS", 50)
    endless = document([{"type": "recycle"}], {"count": 1, "rate": 0, "life": 0, "set": {"velocity": [1, 0, 0]}})
    with pytest.raises(CookError, match="in frame 2 particles begin new lives more than 50 times"):
        effect(endless).simulate(3)
    file = tmp_path / "endless.json"
    file.write_text(json.dumps(endless))
    result = CliRunner().invoke(main, ["cook", str(file), "--out", str(tmp_path)])
    assert result.exit_code == 5 and "Traceback" not in result.output


def test_endless_spawning_is_told():
    """A chain of deaths that goes on at one time is stopped with a message."""
    chain = {"chain": {"type": "spawn", "from": "sky", "when": "death", "into": "sky", "generations": 100000}}
    with pytest.raises(CookError, match="in frame 2 spawns follow one another without end; it was stopped after 1,000 rounds"):
        effect(document([], {"count": 1, "rate": 0, "life": 0, "set": {"position": {"in_box": {}}}}, nodes=chain)).simulate(3)


def test_spawned_particles_have_no_emitter_to_recycle_them():
    """`recycle` on a spawn's own stream is refused with a message."""
    nodes = {
        "spark": {"type": "spawn", "from": "sky", "when": "birth", "life": 0.1},
        "again": {"type": "recycle", "from": "spark"},
    }
    with pytest.raises(GraphError, match="those of the spawn 'spark' have no emitter"):
        effect(document([], nodes=nodes, image={"from": "again"})).plan  # noqa: B018, it tells what is wrong


@pytest.mark.parametrize("fps", [8, 24])
def test_death_at_a_frame_is_in_it_and_birth_at_a_frame_too(fps):
    """Who dies at the time of a frame is not in it; who is reborn at that time is, at age 0."""
    dead = particles(document([], FALL | {"life": 0.5}, fps), fps // 2 + 1)
    born = particles(
        document([{"type": "recycle"}, {"type": "set", "set": {"radius": {"expr": "age"}}}], FALL | {"life": 0.5}, fps),
        fps // 2 + 1,
    )
    assert len(dead["position"]) == 0 and born["radius"].tolist() == [0.0]
    np.testing.assert_array_equal(born["position"], [[0, 1, 0]])


@pytest.mark.parametrize("preroll", [0.25, 0.13])
def test_frames_before_the_first_are_counted_from_it(preroll):
    """What is born as a preroll begins is born in the frame before all that are simulated."""
    found = particles(
        graph([], {"count": 1, "rate": 0, "set": {"radius": {"expr": "frame"}}}, {"preroll": preroll, "precision": 64}), 1
    )
    assert found["radius"].tolist() == [1 - np.ceil(preroll * 24)]


def test_who_died_within_the_frame_is_drawn_as_at_its_death():
    """No share of life is more than 1, also of those who ended while the shutter was open."""
    left = {"type": "set", "set": {"radius": {"expr": "0.1 + (1 - normalized_age) ** 0.5"}}}
    emit = {"count": 50, "life": {"rand": [0.021, 0.041]}, "set": {"position": [0, 2, 0]}}
    film = effect(document([left], emit, image={"shutter": 1})).film(2)
    assert film.dropped == 0 and film.pixels[..., 3].max() > 0.5


def test_a_parent_that_dies_has_lived_the_whole_of_its_life():
    """At a death the parent's share of life is 1, and never more."""
    child = {"type": "spawn", "from": "sky", "when": "death", "set": {"mass": {"expr": "parent.normalized_age"}}}
    nodes = {"child": child, "seen": {"type": "set", "from": "child", "set": {"radius": {"expr": "mass"}}}}
    found = particles(document([], MANY, nodes=nodes, image={"from": "seen"}), 20, "child")["mass"]
    assert len(found) > 50 and found.max() <= 1 and found.min() > 1 - 1e-9
