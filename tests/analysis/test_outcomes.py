"""Pairs by participant and condition."""

import numpy as np

from analysis.frames import study_frames
from analysis.outcomes import answers_by_participant, by_participant, values


def test_an_unfinished_lap_has_no_lap_time(make_study):
    """It leaves a gap in the pairs, not a number."""
    frames = study_frames(make_study(unfinished=frozenset({(1, 2)})))
    wide = by_participant(frames, "lap_time_s")
    assert list(wide.columns) == ["baseline", "limited", "human-assisted", "model-assisted"]
    assert np.isnan(wide.loc["P0001", "limited"])
    assert wide.notna().sum().sum() == 4 * 4 - 1


def test_who_drove_nothing_stays_a_row(make_study):
    """A participant without an analysed lap is a row of gaps: no participant is lost."""
    frames = study_frames(make_study(withdrew={2: 0}))
    wide = by_participant(frames, "lap_time_s")
    assert wide.loc["P0002"].isna().all()
    assert len(wide) == 4


def test_unanswered_questions_are_gaps(make_study):
    """An unanswered item is missing after every lap it was asked."""
    frames = study_frames(make_study(unanswered=frozenset({(1, "Q7")})))
    wide = answers_by_participant(frames, "driving-assistance", "Q7")
    assert wide.loc["P0001"].isna().all()
    assert wide.loc["P0002", ["human-assisted", "model-assisted"]].notna().all()
    assert wide[["baseline", "limited"]].isna().all(axis=None)


def test_lap_values_are_the_finished_laps(make_study):
    """Lap by lap, unfinished laps have no time and stay in the list as missing."""
    frames = study_frames(make_study(unfinished=frozenset({(1, 2)})))
    assert values(frames, "lap_time_s", "limited").isna().sum() == 1
