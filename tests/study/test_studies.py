"""Studies of graphs whose motion is known: orders, references, refusals, chaos, and the data that tell of them."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from graphfx.cook.trial import Trials
from graphfx.study.candidates import FAMILIES, Candidate, Family, candidates
from graphfx.study.data import FIELDS, paths_in, study_data
from graphfx.study.errors import Errors
from graphfx.study.films import picture_errors
from graphfx.study.recommend import advice, compare_pictures, keeps
from graphfx.study.reference import Reference, references, truth_of
from graphfx.study.study import Maker, Result, Study, by_rank

from .problems import flat_of, free_fall, pinball, two_vortices

SMALL = {"most": 20, "frames": [6, 12, 24], "seconds": 30.0, "repeats": 2}


@pytest.fixture(scope="module")
def vortices() -> Study:
    study = Maker(two_vortices(), precisions=(64,), **SMALL).make()
    compare_pictures(study)
    return study


MOMENTS = list(range(4, 97, 4))


@pytest.fixture(scope="module")
def chaos() -> tuple[Reference, Reference]:
    return references(pinball(frames=96), None, MOMENTS)


def test_symmetric_steps_are_of_second_order(vortices):
    """Between two vortices the error of `strang` falls as the square of the step."""
    assert vortices.order("strang", 64) == pytest.approx(2, abs=0.1)


def test_the_references_check_each_other(vortices):
    """Two references agree far below the tolerance, and no error is told that is not above their difference."""
    assert 0 < vortices.truth.difference.greatest < 1e-7
    for entry in study_data(vortices)["results"]:
        assert entry["message"] or entry["measured"] == (entry["error"]["p95"] > vortices.truth.difference.p95)


def test_what_refuses_is_listed(vortices):
    """`exact` cannot carry two vortices: it stands among the results, with its message."""
    refused = [each for each in vortices.results if each.candidate.family.name == "exact"]
    assert [each.message.startswith("there is no exact solution for vortex, vortex together") for each in refused] == [True]


def test_the_cheapest_that_keeps_the_tolerance_is_recommended(vortices):
    """No setting of fewer evaluations keeps the tolerance, and the reason names the tolerance and the error."""
    found = advice(vortices)
    assert found.result.errors.p95 <= vortices.tolerance and found.result.errors.failures == 0
    cheaper = [each for each in vortices.results if not each.message and each.evaluations < found.result.evaluations]
    assert cheaper and all(each.errors.p95 > vortices.tolerance or not each.sound for each in cheaper)
    assert "1.0e-3 m" in found.reason and "fewest" in found.reason


def test_a_tolerance_of_steps_is_told_from_that_of_the_graph(vortices):
    """A recommended method with steps of its own has another tolerance than the graph, and the reason says what that is."""
    own = [each for each in vortices.results if each.candidate.family.method == "adaptive" and each.candidate.tolerance != 1e-3]
    found = advice(replace(vortices, results=own))
    assert f"its tolerance of {found.result.candidate.setting} is what each particle's steps" in found.reason


def test_a_quicker_setting_is_told_where_that_is_sure(vortices):
    """A setting of more evaluations that surely takes less run time is named, with its share; one that may not is not."""
    best = advice(vortices).result
    good = [each for each in vortices.results if not each.message and keeps(each, vortices.tolerance)]
    dearer = next(each for each in good if each.evaluations > best.evaluations)
    slow = replace(best, seconds=[2.0, 2.1, 1.9])
    for seconds, said in (([1.0, 1.1, 0.9], True), ([1.0], False), ([1.0, 1.8, 1.9], False)):
        study = replace(vortices, results=[slow, replace(dearer, seconds=seconds)])
        assert (f"; {dearer.candidate.name} took 0.5 times its run time here" in advice(study).reason) == said


def test_nothing_tried_is_not_nothing_good(vortices):
    """Where no setting was tried it is said that there was no time, not that none keeps the tolerance."""
    reason = advice(replace(vortices, results=[])).reason
    assert reason.endswith("no setting was tried in the time that there was; --seconds allows more")


def test_run_times_are_told_as_ratios_to_sims(vortices):
    """`sims` with one step has the ratio 1 in every round."""
    baseline = vortices.of("sims", 64)[0]
    assert baseline.candidate.steps == 1 and set(vortices.ratios(baseline)) == {1.0}
    assert all(len(each.seconds) <= len(baseline.seconds) for each in vortices.results if not each.message)


def test_every_field_is_documented(vortices):
    """The data have the documented fields, no others, and no number that JSON does not know."""
    data = json.loads(json.dumps(study_data(vortices), allow_nan=False))
    inner = {path for path in paths_in(data) if not path.startswith(("own.", "sampled."))}
    spreads = ("ratio.", "reference.difference.", "seconds.", "recommended.time.", "results[].time.", "reasons.", "orders[].",
               "left_out[].", "energy.")
    assert {path for path in inner if not any(each in path for each in spreads)} <= FIELDS.keys()
    assert FIELDS.keys() <= inner


def test_one_method_stands_for_those_that_are_the_same():
    """Free fall is exact: `strang` is not tried again, and that is said."""
    study = Maker(free_fall(), precisions=(64,), **SMALL).make()
    assert study.of("strang", 64) == [] and study.of("exact", 64)[0].errors.greatest < 1e-12
    assert ("strang, 64 bits", "in this graph it is the same as exact") in study.left_out


def test_chaos_is_compared_up_to_where_it_is_known(chaos):
    """Among mirrors the references part: only what both know to a tenth of the tolerance is compared."""
    truth = truth_of(*chaos, MOMENTS, 1e-3)
    assert truth.chaotic and truth.until is not None and truth.until < 96
    assert truth.difference.greatest <= 0.1 * 1e-3
    assert truth.unknown > 0


def test_nothing_is_said_where_the_references_disagree_at_once(chaos):
    """If not even the first frame is known, nothing is compared, and nothing is recommended."""
    study = Study(pinball(frames=96), [96], truth=truth_of(*chaos, [96], 1e-9))
    assert study.truth.until is None
    assert "nobody knows" in advice(study).reason and study_data(study)["recommended"]["name"] is None


def test_failures_are_told():
    """The paper's scheme flings a stiff spring away: its particles are counted as failed, and it is not advised."""
    emit = {"count": 5, "set": {"position": {"in_box": {}}, "velocity": [1, 0, 0]}}
    flat = flat_of([{"type": "spring", "frequency": 1e3, "damping_ratio": 0}], emit)
    study = Maker(flat, precisions=(64,), **SMALL).make()
    sims = study.of("sims", 64)[0]
    assert sims.errors.failures == 5 and sims.errors.p95 == np.inf and not sims.sound
    assert study_data(study)["results"][-1]["keeps"] is not None
    assert advice(study).result.candidate.family.name == "exact"


def test_ctrl_c_keeps_what_is_done():
    """A study that is stopped tells what it has, and what it has not."""
    def stop(what: str, share: float) -> None:
        if what.startswith("sims, 2 steps"):
            raise KeyboardInterrupt

    study = Maker(two_vortices(), precisions=(64,), tell=stop, **SMALL).make()
    assert study.stopped and study.of("sims", 64) and ("the rest", "it was stopped") in study.left_out
    assert study_data(study)["stopped"] is True


def test_what_there_is_no_time_for_is_left_out_and_named():
    """When time runs out the dearest settings are missing, not the cheapest."""
    study = Maker(two_vortices(), precisions=(64,), **{**SMALL, "seconds": 0.0}).make()
    assert study.results == [] and any("no time left" in why for _, why in study.left_out)


def test_the_cheapest_of_each_family_go_first():
    """By rank: the first of every family, then the second."""
    a, b = Family("a", "strang", (1, 2)), Family("b", "sims", (1, 2))
    given = [Candidate(a, 64, 1), Candidate(a, 64, 2), Candidate(b, 64, 1), Candidate(b, 64, 2)]
    assert [(each.family.name, each.steps) for each in by_rank(given)] == [("a", 1), ("b", 1), ("a", 2), ("b", 2)]


def test_a_graph_can_say_each_setting():
    """What a candidate states of `time`, with what else a graph has there, is what its time settings are."""
    flat = two_vortices(substeps=3, order=4)
    for candidate in candidates():
        assert replace(flat.time, **candidate.document()) == candidate.time(flat.time)
    assert {family.method for family in FAMILIES} >= {"exact", "strang", "sims"}


def test_names_of_settings():
    """Settings are told as one writes them."""
    family = FAMILIES[1]
    names = [Candidate(family, 32, 1).name, Candidate(family, 64, 4).name, Candidate(family, 64, 1, 1e-3).name]
    assert names == ["strang, 1 step, 32 bits", "strang, 4 steps, 64 bits", "strang, 1e-3 m, 64 bits"]


def test_the_extrapolated_reference_is_exact_for_exact_motion():
    """Extrapolating steps that are exact changes nothing beyond rounding."""
    flat = free_fall()
    first, _ = references(flat, None, [24])
    exact = Trials(replace(flat, time=replace(flat.time, method="exact", precision=64))).run([24])
    np.testing.assert_allclose(first.states["dots"][24].position, exact.states["dots"][24].position, rtol=0, atol=1e-13)


def test_nothing_tried_gives_no_advice():
    """Without a setting that ran, none is recommended, and that is said."""
    study = Study(free_fall(), [1])
    assert advice(study).result is None and Result(Candidate(FAMILIES[0], 32)).sound


def test_pictures_are_compared_where_that_is_asked_for():
    """An exact setting gives the reference's picture up to rounding; PSNR is -20 log10 of the RMS."""
    emit = {"count": 30, "set": {"position": {"in_box": {"max": [1, 1, 1]}}, "radius": 0.2, "velocity": [0.1, 0, 0]}}
    flat = flat_of([{"type": "gravity", "acceleration": [0, -0.1, 0]}], emit, frames=6)
    times = {"exact": flat.time, "elsewhere": replace(flat.time, method="sims", fps=2.0)}
    exact, elsewhere = picture_errors(flat, 6, times)
    assert exact.psnr > 60 and elsewhere.psnr < 40
    assert elsewhere.psnr == pytest.approx(-20 * np.log10(elsewhere.rms))


@pytest.mark.parametrize("work, errors, stops", [
    ((3, 3, 3), (1e-3, 1e-3, 1e-3), False),
    ((3, 6, 9), (1e-6, 1e-6, 1e-6), True),
    ((3, 6, 9), (1e-3, 1e-4, 1e-5), False),
])
def test_a_family_ends_where_work_no_longer_helps(work, errors, stops):
    """Smaller tolerances are left out where two took more work for no less error; not where none has been asked for yet."""
    family = next(each for each in FAMILIES if len(each.tolerances) > 4)
    study = Study(free_fall(), [1])
    for number, (evaluations, error) in enumerate(zip(work, errors, strict=True)):
        candidate = Candidate(family, 64, 1, family.tolerances[number])
        study.results.append(Result(candidate, errors=Errors(p95=error), evaluations=evaluations, seconds=[0.1]))
    assert Maker(study.flat)._says_no_more(study, study.results[-1].candidate) is stops
    assert bool(study.left_out) is stops
