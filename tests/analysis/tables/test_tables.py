"""Tables: shares, counts and numbers beside the paper's."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from analysis.comparisons import declared_comparisons, lap_time_comparisons
from analysis.frames import study_frames
from analysis.lap_records import read_laps
from analysis.tables.against_paper import paper_table
from analysis.tables.comparisons import comparison_table, speedup_table
from analysis.tables.lap_times import lap_time_table
from analysis.tables.measures import measure_table
from analysis.tables.reliability import reliability_table
from analysis.tables.sections import section_table
from analysis.tables.survey import survey_table


@pytest.fixture(scope="module")
def frames(study):
    """Return the frames of the uneventful study."""
    return study_frames(study)


@pytest.fixture(scope="module")
def records(frames):
    """Return its measured laps."""
    return read_laps(frames)


def test_unfinished_laps_are_counted_not_averaged(make_study):
    """The limited condition has one lap less in its mean, and one in its own column."""
    study = make_study(unfinished=frozenset({(1, 2)}), withdrew={2: 4})
    table = lap_time_table(study_frames(study)).set_index("condition")
    times = study_frames(study).laps.set_index(["participant", "condition"])["lap_time_s"]
    assert table.loc["limited", ["n", "unfinished", "not_driven"]].tolist() == [3, 1, 0]
    assert table.loc["limited", "mean_s"] == pytest.approx(
        times.xs("limited", level="condition").mean()
    )
    assert table.loc["model-assisted", "unfinished"] == 1


def test_shares_of_assistance_add_up(frames, records):
    """Within a condition, all assistance lies in some section."""
    table = section_table(frames, records)
    shares = table.groupby("condition")["share_of_assistance_percent"].sum()
    assert shares.tolist() == pytest.approx([100, 100])
    sharp = table[(table["role"] == "demonstrator") & (table["kind"] == "sharp_right")]
    assert sharp["assisted_percent"].tolist() == [100, 100]


def test_help_that_nobody_recorded_is_not_zero(frames, records):
    """Without the shadow demonstrator's record its share is missing; what was given stays."""
    silent = replace(records, steps=records.steps.assign(h_would=np.nan))
    table = section_table(frames, silent)
    assert table["would_percent"].isna().all()
    assert table["assisted_percent"].equals(section_table(frames, records)["assisted_percent"])


def test_sections_follow_the_course(frames, records):
    """Every section appears once per condition with help, in driving order."""
    table = section_table(frames, records)
    names = [s.name for s in frames.study.course.sections]
    assert table["section"].tolist() == names * 2


def test_answers_add_up(make_study):
    """Counts of the scale's points and missing answers make up all that was asked."""
    study = make_study(unanswered=frozenset({(1, "Q5")}))
    table = survey_table(study_frames(study), study.instruments[0])
    points = table[[f"n_{i}" for i in range(1, 6)]].sum(axis=1)
    assert (points == table["answered"]).all()
    parts = table[["answered", "missing", "not_reached"]].sum(axis=1)
    assert (parts == table["asked"]).all()
    assert (table["asked"] == 4).all()
    q5 = table[table["item"] == "Q5"]
    assert q5["missing"].tolist() == [1, 1]


def test_questions_that_were_not_reached_are_counted(make_study):
    """Who left before a question stays in what was to be asked; no row vanishes."""
    study = make_study(withdrew=dict.fromkeys(range(1, 5), 4) | {2: 0})
    table = survey_table(study_frames(study), study.instruments[0])
    counted = table.groupby("condition", sort=False)[["asked", "answered", "not_reached"]].sum()
    assert counted.to_dict("index") == {
        "baseline": {"asked": 16, "answered": 12, "not_reached": 4},
        "limited": {"asked": 16, "answered": 12, "not_reached": 4},
        "human-assisted": {"asked": 44, "answered": 33, "not_reached": 11},
        "model-assisted": {"asked": 44, "answered": 0, "not_reached": 44},
    }


def test_agreement_starts_where_the_instrument_says(make_study):
    """All answers are 4, the lowest point that counts: all agree; at 3 no one does."""
    study = make_study(answer=4)
    table = survey_table(study_frames(study), study.instruments[0])
    assert (table["agree_percent"] == 100).all()


def test_reliability_bins_hold_every_prediction(frames, records):
    """Steps in all bins are the steps with a prediction; predicted p lies in its bin."""
    table = reliability_table(frames, records)
    known = records.steps[["p_help", "h_would"]].dropna()
    assert table["steps"].sum() == len(known)
    assert ((table["predicted"] >= table["low"]) & (table["predicted"] <= table["high"])).all()


def test_measures_by_condition_use_finished_laps(make_study):
    """An unfinished lap is in no mean of a measure."""
    frames = study_frames(make_study(unfinished=frozenset({(1, 2)})))
    table = measure_table(frames, read_laps(frames)).set_index(["measure", "condition"])
    assert table.loc[("path_length_m", "limited"), "n"] == 3
    assert table.loc[("path_length_m", "baseline"), "n"] == 4


def test_the_papers_number_stands_beside_ours(frames, records, study):
    """Every row has the paper's value, ours, and where the paper says it."""
    measures = measure_table(frames, records)
    survey = survey_table(frames, study.instruments[0])
    table = paper_table(frames, lap_time_comparisons(frames), [survey], measures)
    ours = table.set_index("what")
    assert ours.loc["limited: mean lap time", "paper"] == 76.7
    assert ours.loc["limited: mean lap time", "ours"] == pytest.approx(
        frames.laps.loc[frames.laps["condition"] == "limited", "lap_time_s"].mean()
    )
    assert {"Q5", "Q7", "Q8", "Q11"} == {w.split()[-1] for w in table["what"] if "agree" in w}
    assert table["section"].str.len().gt(0).all()


def test_the_increase_through_the_limitation_is_the_inverse_ratio(frames, records):
    """Limited / baseline - 1, with the interval's ends in order."""
    table = paper_table(frames, lap_time_comparisons(frames), [], measure_table(frames, records))
    row = table.set_index("what").loc["limited: increase over baseline, ratio of means"]
    times = lap_time_table(frames).set_index("condition")["mean_s"]
    assert row["ours"] == pytest.approx(100 * (times["limited"] / times["baseline"] - 1))
    assert row["ours_low"] < row["ours"] < row["ours_high"]


def test_speedups_turn_their_intervals_round(frames):
    """Seconds gained are minus the difference; low stays below high."""
    table = speedup_table(lap_time_comparisons(frames))
    assert len(table) == 6
    assert (table["gain_s_low"] < table["gain_s"]).all()
    assert (table["gain_s"] < table["gain_s_high"]).all()


def test_comparisons_that_cannot_be_computed_say_why(make_study):
    """One participant: numbers are missing, and the notes hold the reason."""
    frames = study_frames(make_study(participants=1))
    table = comparison_table(declared_comparisons(frames))
    assert table["mean_difference_low"].isna().all()
    assert table["notes"].str.contains("needs at least 2 pairs").any()


def test_a_condition_nobody_drove_leaves_its_row(make_study):
    """All left before the model's lap: the condition stays in the table with n = 0."""
    frames = study_frames(make_study(withdrew=dict.fromkeys(range(1, 5), 3)))
    table = lap_time_table(frames).set_index("condition")
    assert table.loc["model-assisted", "n"] == 0
    assert np.isnan(table.loc["model-assisted", "mean_s"])
    assert isinstance(table, pd.DataFrame)
