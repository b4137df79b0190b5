"""What is set at birth, at steps, frames, hits and deaths, and what fades: exact values at exact times."""

from __future__ import annotations

import numpy as np
import pytest

from .effects import effect, graph, particles, streaks_at

RATES = [(24, 1), (24, 3), (25, 2), (7, 1), (60, 1)]
FALL = {"count": 1, "rate": 0, "set": {"position": [0, 1, 0], "velocity": [1, -2, 0], "radius": 0.25}}
FLOOR = {"type": "bounce_plane"}


def after(ops, frame=None, fps=24, substeps=1, emit=FALL, seconds=1.0, **keys):
    """Return the particles after some seconds, in float64."""
    last = round(fps * seconds) + 1
    time = {"fps": fps, "substeps": substeps, "frames": [1, last], "precision": 64, **keys.pop("time", {})}
    return particles(graph(ops, emit, time, **keys), frame or last)


def setting(when, value, name="radius", **more):
    """Return a `set` of one attribute."""
    return {"type": "set", "when": when, "set": {name: value}, **more}


@pytest.mark.parametrize("fps, substeps", RATES)
def test_set_at_a_hit_reads_the_time_of_contact(fps, substeps):
    """A fall of 1 m at 2 m/s meets the floor at 0.5 s, whatever the frames and steps."""
    radius = after([FLOOR, setting("hit", {"expr": "time"})], None, fps, substeps)["radius"]
    np.testing.assert_allclose(radius, 0.5, rtol=0, atol=1e-14)


@pytest.mark.parametrize("fps, substeps", RATES)
def test_set_at_a_hit_reads_the_time_at_which_gravity_brings_it_down(fps, substeps):
    """Under gravity y = 1 - 2 t - g t^2 / 2 is 0 at (sqrt(4 + 2 g) - 2) / g; hit.speed is sqrt(4 + 2 g)."""
    value = {"expr": "vec(time, hit.speed, hit.point.x)"}
    ops = [{"type": "gravity", "acceleration": [0, -10, 0]}, FLOOR, setting("hit", value, "color", only={"expr": "hits == 1"})]
    color = after(ops, None, fps, substeps, seconds=0.5)["color"]
    time = (np.sqrt(24) - 2) / 10
    np.testing.assert_allclose(color, [[time, np.sqrt(24), time]], rtol=0, atol=1e-13)


@pytest.mark.parametrize("fps, substeps", RATES)
def test_set_at_a_step_reads_the_time_of_its_start(fps, substeps):
    """The last step of a frame starts one step before it."""
    radius = after([setting("step", {"expr": "time"})], None, fps, substeps)["radius"]
    np.testing.assert_allclose(radius, 1 - 1 / (fps * substeps), rtol=0, atol=1e-14)


@pytest.mark.parametrize("fps, substeps", RATES)
def test_set_each_frame_reads_the_time_and_number_of_the_frame(fps, substeps):
    """By default a `set` acts as the frame ends."""
    color = after([{"type": "set", "set": {"color": {"expr": "vec(time, frame, age)"}}}], None, fps, substeps)["color"]
    assert color.tolist() == [[1.0, fps + 1, 1.0]]


def test_set_at_birth_reads_the_time_of_birth():
    """Particles born within frames are set at their own times."""
    found = after([setting("birth", {"expr": "time"})], emit={"rate": 37, "set": {"velocity": [1, 0, 0]}})
    np.testing.assert_allclose(found["radius"], np.arange(38) / 37, rtol=0, atol=1e-14)


@pytest.mark.parametrize("precision", [32, 64])
def test_set_may_read_what_it_sets(precision):
    """Half the radius each frame: after n frames it is 2^-n of what it was."""
    ops = [{"type": "set", "set": {"radius": {"expr": "radius / 2"}}}]
    for frame in (1, 2, 7):
        assert after(ops, frame, time={"precision": precision})["radius"].tolist() == [0.25 * 0.5**frame]


def test_values_of_one_set_read_each_other():
    """A value reads what the same `set` gives another attribute, in whatever order they stand."""
    values = {"opacity": {"expr": "mass * 2"}, "mass": {"expr": "radius + 1"}, "radius": 0.5}
    for when in ("birth", "step", "frame", "hit"):
        found = after([FLOOR, {"type": "set", "when": when, "set": values}])
        assert found["opacity"].tolist() == [3.0]


def test_sets_act_in_stack_order():
    """Of two `set` operators the later one has the last word, and reads what the earlier gave."""
    first, second = (
        {"type": "set", "id": "a", "set": {"radius": 3}},
        {"type": "set", "id": "b", "set": {"radius": {"expr": "radius + mass"}}},
    )
    assert after([first, second])["radius"].tolist() == [4.0]
    assert after([second, first])["radius"].tolist() == [3.0]


def test_during_and_only_hold_a_set_back():
    """Outside its interval, or where its condition fails, nothing is set."""
    for when in ("birth", "step", "frame", "hit"):
        kept = [
            after([FLOOR, setting(when, 9, **more)])["radius"]
            for more in (
                {"during": [0.6, 0.7], "only": {"expr": "time < 0.55"}},
                {"only": {"expr": "position.x > 5"}},
                {"only": {"not": {"inside_sphere": {"radius": 9}}}},
            )
        ]
        assert np.concatenate(kept).tolist() == [0.25] * 3
        assert after([FLOOR, setting(when, 9, during=[-1, 3], only={"expr": "mass == 1"})])["radius"].tolist() == [9.0]


def test_set_hears_the_surfaces_that_it_names():
    """A `set` at the hits of the wall is not called by those of the floor."""
    wall = {"type": "bounce_plane", "id": "wall", "point": [0.75, 0, 0], "normal": [-1, 0, 0]}
    for name, time in (("act/wall", 0.75), ("act/bounce_plane", 0.5)):
        found = after([FLOOR, wall, setting({"hit": [name]}, {"expr": "time"})])
        np.testing.assert_allclose(found["radius"], time, rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    "when, substeps, wakes", [("step", 1, 0.65), ("step", 2, 0.625), ("step", 2, 0.65), ("frame", 2, 0.65), ("hit", 1, 0.5)]
)
def test_new_velocity_wakes_what_rests(when, substeps, wakes):
    """A particle that sticks to the floor flies off as its velocity is set, from that moment on."""
    ops = [FLOOR | {"response": "stick"}, setting(when, [0, 2, 0], "velocity", during=[wakes - 0.01, wakes + 0.01])]
    found = after(ops, fps=20, substeps=substeps)
    np.testing.assert_allclose(found["position"][0, 1], 2 * (1 - wakes), rtol=0, atol=1e-13)


def test_velocity_set_to_what_it_was_lets_rest():
    """Halving the velocity each step leaves what rests at rest: it is hit once."""
    ops = [
        {"type": "gravity"},
        FLOOR | {"response": "stick"},
        setting("step", {"expr": "velocity / 2"}, "velocity"),
        setting("frame", {"expr": "hits"}),
    ]
    found = after(ops, seconds=2)
    assert found["radius"].tolist() == [1.0] and found["position"][0, 1] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("fps", [10, 24])
def test_life_set_at_a_hit_ends_at_its_own_time(fps):
    """A life that a hit at 0.5 s sets to the age and 0.01 s ends at 0.51 s, within the frame."""
    ops = [FLOOR, setting("hit", {"expr": "age + 0.01"}, "life")]
    simulation = effect(graph(ops, FALL, {"fps": fps, "frames": [1, fps + 1], "precision": 64})).simulation()
    ended = [time for _ in simulation.frames(fps + 1) for time in simulation.particles["sky"].ended_at]
    np.testing.assert_allclose(ended, [0.51], rtol=0, atol=1e-13)


@pytest.mark.parametrize("fps", [10, 24])
def test_life_set_at_a_step_counts_in_that_step(fps):
    """A life set to 0.03 s as a step starts ends then, or at once where that is past."""
    ops = [setting("step", 0.03, "life", only={"expr": "time > 0.45"})]
    simulation = effect(graph(ops, FALL, {"fps": fps, "frames": [1, fps + 1], "precision": 64})).simulation()
    ended = [time for _ in simulation.frames(fps + 1) for time in simulation.particles["sky"].ended_at]
    np.testing.assert_allclose(ended, [(np.floor(0.45 * fps) + 1) / fps], rtol=0, atol=1e-13)


def streaks(ops, frame, emit=FALL, shutter=0.5):
    """Return the streaks of a frame."""
    simulation = effect(graph(ops, emit, {"precision": 64}, {"shutter": shutter})).simulation()
    for _ in simulation.frames(frame):
        pass
    time = simulation.clock.time_of(frame)
    return streaks_at(simulation, time, time - shutter / 24)[0]


def test_tail_has_what_is_set_for_it():
    """`tail.radius` reaches the streaks' tails alone; until it is set the tail is as the head was at birth."""
    for when in ("birth", "step", "frame"):
        made = streaks([{"type": "set", "when": when, "set": {"tail.radius": 0.5, "tail.opacity": {"expr": "radius"}}}], 5)
        assert (made.tail_radius, made.tail_opacity, made.head_radius) == (0.5, 0.25, 0.25)
    late = streaks([FLOOR, {"type": "set", "when": "hit", "set": {"tail.radius": 0.5}}], 5)
    assert late.tail_radius == 0.25


def test_path_set_each_frame_has_tails_on_it():
    """Where a path is followed, the tail is where the path was as the shutter opened."""
    ops = [{"type": "set", "set": {"position": {"expr": "birth.position + vec(time * time, 0, 0)"}}}]
    made = streaks(ops, 7, {"count": 1, "rate": 0, "set": {"position": [0, 1, 0]}})
    np.testing.assert_allclose(np.asarray(made.head)[:, 0], [(6 / 24) ** 2, 1, 0], rtol=0, atol=1e-7)
    np.testing.assert_allclose(np.asarray(made.tail)[:, 0], [(5.5 / 24) ** 2, 1, 0], rtol=0, atol=1e-7)


@pytest.mark.parametrize("fps, substeps", RATES)
@pytest.mark.parametrize("surface", [{}, {"response": "stick"}, {"response": "slide"}, {"resilience": 1}])
def test_fade_is_exponential(fps, substeps, surface):
    """x(t) = 3 + (x(0) - 3) exp(-2 t), to rounding, for those who bounce, stick and slide as well."""
    ops = [{"type": "gravity"}, FLOOR | surface, {"type": "fade", "rate": 2, "set": {"radius": 3, "color": [3, 0, 0]}}]
    found = after(ops, None, fps, substeps)
    np.testing.assert_allclose(found["radius"], 3 - 2.75 * np.exp(-2), rtol=1e-13)
    np.testing.assert_allclose(found["color"], [[3 - 2 * np.exp(-2), np.exp(-2), np.exp(-2)]], rtol=1e-13)


@pytest.mark.parametrize("fps, substeps", RATES)
@pytest.mark.parametrize("response", ["bounce", "stick"])
def test_fade_goes_on_from_what_a_hit_sets(fps, substeps, response):
    """What is set at 0.5 s, within a frame, fades from then on: 5 exp(-0.5 * 2) after 1 s."""
    ops = [FLOOR | {"response": response}, setting("hit", 5), {"type": "fade", "rate": 2, "set": {"radius": 0}}]
    np.testing.assert_allclose(after(ops, None, fps, substeps)["radius"], 5 * np.exp(-1), rtol=1e-13)


def test_draw_of_a_hit_is_new_at_each():
    """`per: hit` draws anew at each hit, and holds between."""
    ops = [
        FLOOR | {"resilience": 1},
        {"type": "bounce_plane", "id": "top", "point": [0, 1.1, 0], "normal": [0, -1, 0]},
        setting("hit", {"rand": [0, 1], "per": "hit"}),
        setting("frame", {"expr": "hits"}, "mass", id="b"),
        setting("frame", {"expr": "vec(radius, mass, 0)"}, "color", id="c"),
    ]
    seen = {(float(mass), float(radius)) for radius, mass in (after(ops, n)["color"][0, :2] for n in range(1, 25))}
    assert len(seen) == len({mass for mass, _ in seen}) == len({radius for _, radius in seen}) >= 2


@pytest.mark.parametrize("reference", [False, True])
def test_a_power_written_as_two_to_four_takes_any_sign(reference):
    """x ** 2, x ** 3 and pow(x, 4) are products, of negative numbers too."""
    for text, count in (("position.x ** 2", 2), ("position.x ** 3", 3), ("pow(position.x, 4)", 4)):
        found = particles(graph([{"type": "set", "set": {"radius": {"expr": text}}}], {"count": 64}), 1, reference=reference)
        x = found["position"][:, 0].astype(float)
        assert x.min() < -0.5 and np.allclose(found["radius"], x**count, rtol=1e-6)


def test_what_reads_a_named_draw_of_a_hit_reads_the_same():
    """A named value that is drawn per hit is one number for all who read it at a hit."""
    both = {"color": {"expr": "vec(toss, toss, 1)"}, "opacity": {"expr": "toss"}}
    ops = [{"type": "gravity"}, FLOOR | {"resilience": 1}, {"type": "set", "when": "hit", "set": both}]
    found = particles(graph(ops, {"rate": 240}, {"frames": [1, 48]}, values={"toss": {"rand": [0.1, 0.9], "per": "hit"}}), 48)
    hit = found["opacity"] < 1
    assert (found["color"][hit, :2] == found["opacity"][hit, None]).all() and len(np.unique(found["opacity"][hit])) > 10
