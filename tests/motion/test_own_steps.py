"""Steps of each particle's own: of the order that is said, as accurate as is asked, and for those alone who need them."""

import numpy as np
import pytest

from graphfx.errors import GraphError
from graphfx.motion import pacing
from graphfx.plan.pacing import FIRST_TURNS

from .bursts import burst, carried, ends, places

ATTRACTORS = [
    {"type": "gravity"},
    {"type": "attract", "strength": 10, "softening": 0.3},
    {"type": "attract", "id": "other", "center": [1, 1, 0], "strength": 5, "softening": 0.3},
]
VORTICES = [{"type": "vortex"}, {"type": "vortex", "id": "other", "center": [1, 0, 0], "axis": [0, 0.6, 0.8]}]
AGAINST_WIND = [{"type": "wind"}, {"type": "attract", "softening": 0.5}]
MIXED = [
    *ATTRACTORS,
    {"type": "vortex"},
    {"type": "random_acceleration", "strength": 3},
    {"type": "bounce_plane", "point": [0, -1, 0], "resilience": 0.7, "friction": 0.1},
]


def error(found, true):
    """Return the root of the mean square distance."""
    return np.sqrt(np.mean(np.sum((found - true) ** 2, axis=1)))


@pytest.mark.parametrize("counts", [(1, 2), (1, 2, 3), (1, 2, 3, 4)])
def test_extrapolation_takes_the_even_powers_away(counts):
    """Results T + a / n^2 + b / n^4 ... of n steps, with as many terms as there are counts less one, come to T."""
    values, errors = pacing.weights_of(counts)
    terms = np.random.default_rng(1).normal(size=len(counts) - 1)
    found = [7.0 + sum(term / n ** (2 * k + 2) for k, term in enumerate(terms)) for n in counts]
    total = found[-1] + sum(w * (found[-1] - other) for w, other in zip(values, found[:-1], strict=True))
    wrong = sum(w * (found[-1] - other) for w, other in zip(errors, found[:-1], strict=True))
    assert total == pytest.approx(7.0, abs=1e-13)
    assert wrong != 0 and abs(wrong) < abs(found[-1] - 7.0)


@pytest.mark.parametrize("order", [4, 6, 8])
@pytest.mark.parametrize("ops", [ATTRACTORS, VORTICES], ids=["attractors", "vortices"])
def test_order_of_whole_steps(ops, order):
    """Halving steps that are never refused divides the error by about 2^order."""
    sets = {} if ops is ATTRACTORS else {"velocity": [0, 0, 0]}
    true = ends(ops, order=8, tolerance=1e-11, sets=sets, frames=[0, 24])
    rates = (2, 4, 8) if order == 8 and ops is VORTICES else (6, 12, 24)
    errors = [error(ends(ops, order=order, tolerance=1e6, sets=sets, fps=fps, frames=[0, fps]), true) for fps in rates]
    observed = np.log2(np.array(errors[:-1]) / errors[1:])
    assert observed.max() > order - 0.5 and observed.min() > order - 1.5


@pytest.mark.parametrize("method, order", [("adaptive", 4), ("adaptive", 6), ("adaptive", 8), ("rk45", 6)])
def test_error_follows_the_tolerance(method, order):
    """The error after a second is at most the tolerance, which is that of a second, and a smaller one costs no less."""
    true = ends(ATTRACTORS, order=8, tolerance=1e-12)
    work = []
    for tolerance in (1e-3, 1e-6, 1e-9):
        simulation = carried(burst(ATTRACTORS, 64, {"method": method, "order": order, "tolerance": tolerance}))
        assert np.quantile(np.linalg.norm(places(simulation) - true, axis=1), 0.95) <= tolerance
        work.append(simulation.particles["some"].turns)
    assert work == sorted(work)


@pytest.mark.parametrize("order", [4, 6, 8])
def test_velocity_in_an_acceleration_keeps_the_order_at_four_at_least(order, tmp_path):
    """An acceleration that reads the velocity is extrapolated to order 4 at least."""
    true = ends(AGAINST_WIND, order=8, tolerance=1e-12)
    errors = [error(ends(AGAINST_WIND, order=order, tolerance=1e6, fps=fps, frames=[0, fps]), true) for fps in (6, 12, 24)]
    assert np.log2(errors[0] / errors[1]) > 3.5


@pytest.mark.parametrize("precision", [32, 64])
@pytest.mark.parametrize("method, ops", [("adaptive", MIXED), ("rk45", [*ATTRACTORS, *MIXED[-2:]])], ids=["adaptive", "rk45"])
def test_blocks_and_plain_python_give_the_same_bits(method, ops, precision):
    """Steps of their own, noise in cells of another length than frames, and bounces: all bits are the same."""
    effect = burst(ops, 10, {"method": method, "precision": precision, "tolerance": 1e-4, "fps": 10, "frames": [0, 5]})
    assert places(carried(effect)).tobytes() == places(carried(effect, reference=True)).tobytes()


def test_threads_and_company_change_no_bit():
    """The first particles of 2,000 on three threads move as they do alone."""
    many = places(carried(burst(MIXED, 2000, {"tolerance": 1e-5, "frames": [0, 8]}), threads=3))
    few = places(carried(burst(MIXED, 5, {"tolerance": 1e-5, "frames": [0, 8]})))
    assert many[:5].tobytes() == few.tobytes()


def test_mild_particles_do_not_pay_for_stiff_ones():
    """Beside one particle of a hundred that circles close to an attractor the others take the steps that they take alone."""
    pull = [{"type": "attract", "strength": 10, "softening": 0.01}]
    far = {"position": {"in_sphere": {"center": [20, 0, 0]}}, "velocity": [0, 0, 1]}
    close = {"position": {"in_sphere": {"center": [0.1, 0, 0], "radius": 0.02}}, "velocity": [0, 0, 10]}
    mild = carried(burst(pull, 990, {"tolerance": 1e-6}, **far)).particles["some"]
    stiff = carried(burst(pull, 10, {"tolerance": 1e-6}, **close)).particles["some"]
    assert mild.turns == 990 * 24 and stiff.turns > 10 * 24 * 20


def test_a_run_goes_on_with_those_alone_who_need_more_steps():
    """Of a mixture only the particles near an attractor are gathered to go on: the first run takes few steps, and no other
    is of particles that are far."""
    effect = burst(
        [{"type": "attract", "strength": 10, "softening": 0.01}],
        1000,
        {"tolerance": 1e-6, "frames": [0, 2]},
        mass={"rand": [0, 1]},
        position={"expr": "vec(0.1, 0, 0) if mass < 0.01 else vec(20, 0, 0)"},
        velocity={"expr": "vec(0, 0, 10) if mass < 0.01 else vec(0, 0, 1)"},
    )
    simulation = effect.simulation()
    runs: list[tuple[int, int]] = []
    run = simulation.programs.run

    def watched(made, particles, interval, listed=None, by_place=None, **given):
        found = run(made, particles, interval, listed, by_place=by_place, **given)
        if by_place is not None and "turns" in by_place:
            count = particles.store.count if listed is None else len(listed)
            runs.append((count, int(by_place["turns"][0][:count].max())))
        return found

    simulation.programs.run = watched
    for _ in simulation.frames(1):
        pass
    near = int(np.count_nonzero(np.asarray(simulation.particles["some"].value("mass"))[..., :1000] < 0.01))
    (first, few), *others = runs
    assert 0 < near < 30 and first == 1000 and few == FIRST_TURNS
    assert others and {count for count, _ in others} == {near}


def test_what_cannot_be_carried_is_counted_and_stays_finite():
    """Particles that plunge into unsoftened points beyond what numbers can tell are reported; no place is infinite."""
    ops = [
        {"type": "attract", "strength": 1e12, "softening": 0},
        {"type": "attract", "id": "other", "center": [1e-7, 0, 0], "strength": 1e12, "softening": 0},
    ]
    simulation = carried(burst(ops, 20, {"tolerance": 1e-9, "precision": 32, "frames": [0, 3]}))
    assert simulation.particles["some"].failed > 0 and np.isfinite(places(simulation)).all()


def test_no_number_for_an_error_is_no_acceptance():
    """A step whose error is no number is refused, and divided by eight; at the finest share it is given up."""
    nan = np.float64(np.nan)
    one, fine = np.float64(1.0), np.float64(2.0**-40)
    accepted, fails, share = pacing.judged.body(nan, 0.0 * one, one, one, one, one, fine, 16.0 * one)
    assert not accepted and not fails and share == 0.125
    assert pacing.judged.body(nan, 0.0 * one, one, fine, one, fine, fine, 16.0 * one)[1]


def test_rounding_is_no_error_of_a_step():
    """An error that rounding hides is accepted, and the next step is longer, however small the tolerance."""
    one = np.float64(1.0)
    share = np.float64(0.25)
    given = (one * 1e-9, one * 2e-9, one * 1e-30, share, one, share, one * 2.0**-40, one * 16)
    accepted, fails, following = pacing.judged.body(*given)
    assert accepted and not fails and following == 0.5


def test_rk45_refuses_flows():
    """What is declared as a flow has no rate of change: the message names it, its place and the way out."""
    with pytest.raises(GraphError) as caught:
        carried(burst([{"type": "gravity"}, *VORTICES], 4, {"method": "rk45"}))
    (problem,) = caught.value.problems
    assert problem.path == "nodes.act/vortex"
    assert problem.message == "rk45 needs rates of change, and vortex is a flow; choose 'auto' or 'adaptive'"


LINEAR = [{"type": "spring", "frequency": 2}, {"type": "damp"}, {"type": "spiral"}]


@pytest.mark.parametrize("also", [[{"type": "gravity"}], LINEAR], ids=["gravity", "linear"])
def test_an_orbit_carries_what_disturbs_it_little(also):
    """About a point without softening the orbit is the base: one step a frame is right, and rk45 comes to the same with many."""
    ops = [{"type": "attract", "strength": 10, "softening": 0}, *also]
    simulation = carried(burst(ops, 64, {"tolerance": 1e-5}))
    true = ends(ops, order=8, tolerance=1e-10)
    assert simulation.particles["some"].turns < 64 * 24 * 1.5
    assert np.quantile(np.linalg.norm(places(simulation) - true, axis=1), 0.95) < 1e-5
    other = ends(ops, method="rk45", tolerance=1e-9)
    assert np.quantile(np.linalg.norm(other - true, axis=1), 0.95) < 1e-7


@pytest.mark.parametrize("softening", [0, 0.3])
def test_bounces_in_a_field_cost_ten_evaluations_a_frame_at_most(softening):
    """Gravity, an attractor and bounces at order 6: 95 % within 1e-5 m after a second, at 10 evaluations a frame at most."""
    ops = [
        {"type": "gravity"},
        {"type": "attract", "strength": 10, "softening": softening},
        {"type": "bounce_plane", "point": [0, -1, 0], "resilience": 0.8},
    ]
    simulation = carried(burst(ops, 200, {"tolerance": 1e-5}))
    true = ends(ops, 200, order=8, tolerance=1e-10)
    assert np.quantile(np.linalg.norm(places(simulation) - true, axis=1), 0.95) <= 1e-5
    assert 6 * simulation.particles["some"].turns <= 10 * 200 * 24
