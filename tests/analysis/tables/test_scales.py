"""Composite scores."""

import pytest

from analysis.frames import study_frames
from analysis.tables.scales import scale_table


def test_reverse_coded_items_are_turned(make_study):
    """All answers are 5: turned items score 1, so the mean is between, by their number."""
    study = make_study(answer=5)
    instrument = study.instruments[0]
    table = scale_table(study_frames(study), instrument).set_index(["subscale", "condition"])
    items = [i for i in instrument.items if i.subscale == "assistance"]
    expected = sum(1 if i.reverse else 5 for i in items) / len(items)
    assert table.loc[("assistance", "model-assisted"), "mean"] == pytest.approx(expected)
    assert table.loc[("task", "baseline"), "note"] == "all people have the same score"


def test_incomplete_sheets_have_no_score(make_study):
    """Who left an item out has no composite score of its subscale, only of that one."""
    study = make_study(unanswered=frozenset({(1, "Q5")}))
    table = scale_table(study_frames(study), study.instruments[0])
    rows = table.set_index(["subscale", "condition"])
    assert rows.loc[("assistance", "model-assisted"), ["n", "incomplete"]].tolist() == [3, 1]
    assert rows.loc[("task", "model-assisted"), ["n", "incomplete"]].tolist() == [4, 0]


def test_who_had_left_is_incomplete(make_study):
    """Who was not asked after a lap has no score there, and is not forgotten."""
    study = make_study(withdrew={1: 4})
    table = scale_table(study_frames(study), study.instruments[0])
    rows = table.set_index(["subscale", "condition"])
    assert rows.loc[("task", "model-assisted"), ["n", "incomplete"]].tolist() == [3, 1]


def test_a_subscale_that_was_not_asked_has_no_row(make_study):
    """After laps without assistance no one is asked about it, so there is no score."""
    study = make_study()
    table = scale_table(study_frames(study), study.instruments[0])
    asked = set(table.loc[table["subscale"] == "assistance", "condition"])
    assert asked == {"human-assisted", "model-assisted"}
    assert set(table["n"]) == {4}
