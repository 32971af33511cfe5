"""Paired comparisons: declared ones, Holm within a family, and what is missing."""

from dataclasses import replace

import numpy as np
import pytest

from analysis.comparisons import declared_comparisons, item_comparisons, lap_time_comparisons
from analysis.frames import study_frames
from analysis.outcomes import by_participant
from analysis.stats.holm import holm


def test_confirmatory_comparisons_are_corrected_together(study):
    """Holm over the declared family; exploratory ones carry no corrected p."""
    found = declared_comparisons(study_frames(study))
    confirmatory = [c for c in found if c.kind == "confirmatory"]
    assert [c.name for c in found] == [c.name for c in study.protocol.analyses]
    assert len(confirmatory) == 3
    expected = holm([c.lap_time.test.p for c in confirmatory])
    assert [c.p_holm for c in confirmatory] == pytest.approx(expected)
    assert all(np.isnan(c.p_holm) for c in found if c.kind == "exploratory")


def test_a_declared_margin_gets_an_equivalence_test(study):
    """Only the comparison that declares a margin has one."""
    found = declared_comparisons(study_frames(study))
    with_test = [c.name for c in found if c.equivalence is not None]
    assert with_test == ["the model against the demonstrator"]


def test_differences_are_condition_minus_reference(study):
    """The limited lap is slower than the baseline: positive differences, ratio below one."""
    frames = study_frames(study)
    found = {(c.condition, c.reference): c for c in lap_time_comparisons(frames)}
    c = found["limited", "baseline"]
    wide = by_participant(frames, "lap_time_s")
    assert c.difference.estimate == pytest.approx((wide["limited"] - wide["baseline"]).mean())
    assert c.difference.estimate > 0
    assert c.ratio_of_means.estimate == pytest.approx(
        wide["baseline"].mean() / wide["limited"].mean()
    )


def test_incomplete_pairs_are_left_out_and_counted(make_study):
    """One unfinished limited lap is missing from the comparisons that need it, from no other."""
    frames = study_frames(make_study(unfinished=frozenset({(1, 2)})))
    for c in lap_time_comparisons(frames):
        needs_it = "limited" in (c.condition, c.reference)
        assert (c.complete, c.incomplete) == ((3, 1) if needs_it else (4, 0))


def test_answers_are_compared_where_both_conditions_asked(study):
    """Items 1 to 4 in six pairs of conditions, items 5 to 11 in one."""
    items = [f"Q{i}" for i in range(1, 12)]
    found = item_comparisons(study_frames(study), "driving-assistance", items)
    assert len(found) == 4 * 6 + 7
    assert all(c.difference is None and c.dz is None for c in found)


def test_one_participant_gives_reasons_not_numbers(make_study):
    """Nothing can be tested with one person; every comparison says so."""
    for c in declared_comparisons(study_frames(make_study(participants=1))):
        assert c.complete == 1
        assert np.isnan(c.p_holm) or c.p_holm == 1
        if c.difference is not None:
            assert c.difference.notes == ("one pair: no interval and no t test",)


def test_a_declared_margin_makes_equivalence_what_is_confirmed(study):
    """Holm corrects the p of TOST there; Wilcoxon's elsewhere."""
    analyses = [
        a.model_copy(update={"kind": "confirmatory"})
        for a in study.protocol.analyses
        if a.item is None
    ]
    protocol = study.protocol.model_copy(update={"analyses": tuple(analyses)})
    header = study.header.model_copy(update={"protocol": protocol})
    found = declared_comparisons(study_frames(replace(study, header=header)))
    (same,) = [c for c in found if c.margin is not None]
    assert same.equivalence is not None
    assert same.p_declared == same.equivalence.p
    assert [c.p_holm for c in found] == pytest.approx(holm([c.p_declared for c in found]))


def test_items_of_an_instrument_are_corrected_together(study):
    """Holm over all 31 comparisons of items, beside the uncorrected p."""
    items = [f"Q{i}" for i in range(1, 12)]
    found = item_comparisons(study_frames(study), "driving-assistance", items)
    assert [c.p_items for c in found] == pytest.approx(holm([c.signed_rank.p for c in found]))


@pytest.mark.parametrize(("people", "least"), [(6, 6 / 64), (7, 6 / 128)])
def test_the_smallest_p_after_holm_is_known(make_study, people, least):
    """Three tests: with six complete pairs none can be below .094, with seven .047."""
    for c in declared_comparisons(study_frames(make_study(participants=people))):
        if c.kind == "confirmatory":
            assert c.smallest_p == pytest.approx(least)
            assert c.p_holm >= c.smallest_p
        if c.margin is not None:
            assert np.isnan(c.smallest_p)


def test_equal_answers_cannot_be_tested(make_study):
    """When all answers are equal there is no difference to rank."""
    frames = study_frames(make_study(answer=3))
    (c,) = item_comparisons(frames, "driving-assistance", ["Q7"])
    assert c.signed_rank.why_not == "every difference is zero"
    assert c.rank_biserial.why_not == "every difference is zero"


def test_the_same_study_gives_the_same_numbers(study):
    """Bootstrap draws come from the study's seed."""
    frames = study_frames(study)
    assert repr(lap_time_comparisons(frames)) == repr(lap_time_comparisons(frames))
