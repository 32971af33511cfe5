"""Which laps and answers are analysed, and what of them."""

import re

import pandas as pd
import pytest

from analysis.flow import participants_flow
from analysis.frames import study_frames
from analysis.outcomes import answers_by_participant
from analysis.report.page import build_page
from analysis.results import analyse
from protocols.record.reader import open_study

TWICE = """
schema: 1
name: other
title: The same questions after two laps of a condition
course: lab-office
cohort: {participants: 2}
conditions:
  free: {}
laps:
  - {condition: free, practice: true, survey: [{instrument: driving-assistance, items: [Q1]}]}
  - {condition: free, survey: [{instrument: driving-assistance, items: [Q1]}]}
  - {condition: free, survey: [{instrument: driving-assistance, items: [Q1]}]}
"""

LIMITED_FIRST = """
schema: 1
name: other
title: Practice in a condition that is analysed, too
course: lab-office
cohort: {participants: 2}
conditions:
  free: {}
  limited: {limitation: {right_turn_rad_s: 0.15}}
laps:
  - {condition: limited, practice: true}
  - {condition: free}
  - {condition: limited}
"""


def changed(study, table, change):
    """Return the study's frames after a change to one of its tables."""
    path = study.folder / f"{table}.parquet"
    change(pd.read_parquet(path)).to_parquet(path)
    return study_frames(open_study(study.folder))


def test_a_time_of_an_unfinished_lap_is_no_lap_time(make_study):
    """It is in no average, and the page is told."""

    def timed(laps):
        laps.loc[~laps["completed"], "lap_time_s"] = 500.0
        return laps

    frames = changed(make_study(unfinished=frozenset({(1, 2)})), "laps", timed)
    assert frames.laps["lap_time_s"].max() < 500
    assert frames.laps["lap_time_s"].isna().sum() == 1
    assert participants_flow(frames).left_out == ("1 lap time of laps that were not finished",)


def test_laps_of_other_conditions_are_in_no_frame(make_study):
    """Neither of unknown conditions nor of those that are only practised; both are named."""

    def renamed(laps):
        laps.loc[1, "condition"] = "blindfolded"
        laps.loc[laps["lap"] == 0, "practice"] = False
        return laps

    frames = changed(make_study(participants=2), "laps", renamed)
    assert len(frames.laps) == 7
    assert set(frames.laps["condition"]) == set(frames.conditions)
    assert participants_flow(frames).left_out == (
        "1 lap of conditions that the study does not have (blindfolded)",
        "2 laps of conditions that are not planned, or for practice only (familiarisation)",
    )


@pytest.mark.parametrize("practice", ["absent", "missing"])
def test_practice_that_was_not_recorded_is_as_planned(make_study, tmp_path, practice):
    """Without the column the protocol says which laps are practice, also of a later condition."""
    path = tmp_path / "limited-first.yaml"
    path.write_text(LIMITED_FIRST)

    def forget(laps):
        return laps.drop(columns="practice") if practice == "absent" else laps.assign(practice=None)

    frames = changed(make_study(path, participants=2), "laps", forget)
    assert frames.laps["lap"].tolist() == [1, 2, 1, 2]
    assert participants_flow(frames).left_out == ()


def test_the_last_answer_counts(make_study, tmp_path):
    """Answers are not averaged; one after practice, or to be overruled, is not used, and named."""
    path = tmp_path / "twice.yaml"
    path.write_text(TWICE)

    def answered(surveys):
        return surveys.assign(response=pd.array([5, 1, 4, 5, 2, None], dtype="Int8"))

    frames = changed(make_study(path, participants=2), "surveys", answered)
    assert frames.surveys["response"].tolist() == [4, 2]
    wide = answers_by_participant(frames, "driving-assistance", "Q1")
    assert wide["free"].tolist() == [4, 2]
    assert participants_flow(frames).left_out == (
        "2 earlier answers where a condition was driven more than once (the last one given counts)",
    )


def test_answers_that_nobody_can_use_are_named(make_study):
    """Of an unknown participant, in an unknown condition, to an unknown item."""

    def spoilt(surveys):
        surveys.loc[0, "participant"] = "GHOST"
        surveys.loc[4, "item"] = "Q99"
        surveys.loc[5, "condition"] = "zzz"
        return surveys

    frames = changed(make_study(participants=2), "surveys", spoilt)
    assert participants_flow(frames).left_out == (
        "1 answer of people who are not in the table of participants (GHOST)",
        "1 answer of conditions that the study does not have (zzz)",
        "1 answer of items of driving-assistance that the study does not have (Q99)",
    )


@pytest.fixture
def elsewhere(make_study):
    """Return the folder of a study that was not simulated."""
    folder = make_study(participants=2).folder
    header = folder / "study.yaml"
    header.write_text(
        re.sub("(?m)^seed: .*\norigin: .*$", "seed: null\norigin: elsewhere", header.read_text())
    )
    return folder


def test_answers_off_the_scale_are_missing(elsewhere):
    """Every other answer counts, and the page is told which row it is."""
    path = elsewhere / "surveys.parquet"
    surveys = pd.read_parquet(path)
    surveys.loc[[3, 5], "response"] = 9
    surveys.to_parquet(path)
    frames = study_frames(open_study(elsewhere))
    assert frames.surveys["response"].isna().sum() == 2
    assert frames.surveys["response"].max() <= 5
    said = "column response: 9 in row 3; allowed: 1 to 5 (driving-assistance), or nothing"
    assert frames.unread == (f"surveys.parquet: {said} (and 1 more)",)


def test_without_readable_answers_the_rest_is_reported(elsewhere, page_text):
    """A damaged table of answers is named; lap times and all else are there."""
    path = elsewhere / "surveys.parquet"
    path.write_bytes(path.read_bytes()[:-20])
    results = analyse(open_study(elsewhere))
    page = build_page(results)
    text = page_text(page)
    assert "Not read, and treated as missing: surveys.parquet: not a readable Parquet" in text
    assert results.lap_times[0].complete == 2
