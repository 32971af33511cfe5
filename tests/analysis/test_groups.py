"""Groups: flow, exact tests, and people's degrees of freedom."""

from dataclasses import replace

import numpy as np
import pytest
from scipy import stats

from analysis.frames import study_frames
from analysis.groups import group_model, group_results
from analysis.stats.random_intercept import fit_random_intercept
from analysis.stats.rank_sum import rank_sum
from protocols.groups import Group


@pytest.fixture
def frames(make_study):
    """Return ten people in two groups; the second drives everything a tenth slower."""
    study = make_study(participants=10, excluded={3: "too many collisions"})
    groups = {"usual": Group(), "eager": Group()}
    protocol = study.protocol.model_copy(update={"groups": groups})
    header = study.header.model_copy(update={"protocol": protocol})
    found = study_frames(replace(study, header=header))
    of = {f"P{n:04d}": ("usual", "eager")[n % 2] for n in range(1, 11)}
    everybody = found.everybody.assign(group=found.everybody["participant"].map(of))
    slower = found.laps["participant"].map(of).eq("eager")
    laps = found.laps.assign(lap_time_s=found.laps["lap_time_s"] * np.where(slower, 1.1, 1.0))
    return replace(found, everybody=everybody, laps=laps)


def test_flow_by_group_adds_up(frames):
    """Recorded = refused + excluded + analysed in each group."""
    flow = group_results(frames).flow.set_index("group")
    assert flow.loc["eager"].tolist() == [5, 0, 1, "too many collisions: 1", 4]
    assert flow.loc["usual"].tolist() == [5, 0, 0, "", 5]


def test_people_are_compared_once_each(frames):
    """Each condition by its people's log times; each contrast by their differences."""
    found = {t.name: t for t in group_results(frames).tests}
    wide = np.log(
        frames.laps.pivot_table(index="participant", columns="condition", values="lap_time_s")
    )
    of = frames.everybody.set_index("participant")["group"].reindex(wide.index)
    own = wide["baseline"] - wide["limited"]
    expected = rank_sum(own[of == "eager"], own[of == "usual"])
    assert found["baseline against limited: eager against usual"].p == pytest.approx(expected.p)
    assert found["limited: eager against usual"].n == 9
    assert len(found) == 4 + 3


def test_the_models_groups_stand_on_people(frames):
    """Nine people: the group's contrast has no more than that, the interactions have laps' df."""
    laps = frames.laps.assign(
        group=frames.laps["participant"].map(frames.everybody.set_index("participant")["group"]),
        log_time=np.log(frames.laps["lap_time_s"]),
    )
    found = group_model(frames, laps, "eager", "usual")
    df = [float(t.method.split("t on ")[1].split()[0]) for t in found]
    assert df[0] < len(laps) - 8
    assert all(d == pytest.approx(21, abs=0.5) for d in df[1:])


def test_a_study_without_groups_has_no_section(study):
    """None, not an empty table."""
    assert group_results(study_frames(study)) is None


@pytest.mark.slow
def test_groups_that_do_not_differ_are_told_apart_in_5_percent():
    """Two groups of three people with ten laps each: 400 null cohorts, 2 to 8% rejected."""
    rng = np.random.default_rng(0)
    x = np.column_stack([np.ones(60), np.repeat([0.0, 1.0] * 3, 10)])
    people = np.repeat(np.arange(6), 10)
    rejected = []
    for _ in range(400):
        y = np.repeat(rng.normal(4, 0.2, 6), 10) + rng.normal(0, 0.1, 60)
        estimate, error, df = fit_random_intercept(y, x, people).contrast([0, 1])
        rejected.append(2 * stats.t.sf(abs(estimate / error), df) <= 0.05)
    assert 0.02 < np.mean(rejected) < 0.08
