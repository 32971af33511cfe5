"""One pass over the steps of every lap."""

import shutil

import numpy as np
import pandas as pd

from analysis import lap_records
from analysis.frames import study_frames
from analysis.lap_records import read_laps
from analysis.measures.path_length import path_length
from analysis.measures.streams import Steps
from analysis.processes import processes


def test_every_analysed_lap_is_measured_once(study):
    """One row per analysed lap, with the numbers its own steps give."""
    frames = study_frames(study)
    measures = read_laps(frames).measures
    assert len(measures) == len(frames.laps)
    row = measures[(measures["participant"] == "P0003") & (measures["lap"] == 2)].iloc[0]
    assert row["path_length_m"] == path_length(Steps(study.steps("P0003", 2)))


def test_measures_agree_with_the_recorded_lap_table(study):
    """Assisted fraction and interventions are those that were recorded while driving."""
    frames = study_frames(study)
    measures = read_laps(frames).measures
    both = measures.merge(frames.laps, on=["participant", "lap"], suffixes=("", "_recorded"))
    assert (both["assisted_fraction"] - both["assisted_fraction_recorded"]).abs().max() < 1e-12
    assert (both["interventions"] == both["interventions_recorded"]).all()


def test_steps_are_pooled_with_who_and_where(study):
    """The pool holds every step of every analysed lap."""
    frames = study_frames(study)
    pool = read_laps(frames).steps
    assert len(pool) == frames.laps["steps"].sum()
    assert set(pool["condition"]) == set(frames.conditions)


def test_a_lap_without_a_step_table_is_counted(make_study):
    """Elsewhere steps may not have been recorded: the lap stays, its measures are missing."""
    study = make_study()
    shutil.rmtree(study.folder / "sessions" / "P0002")
    records = read_laps(study_frames(study))
    assert records.without_steps == 4
    gaps = records.measures[records.measures["participant"] == "P0002"]
    assert gaps["path_length_m"].isna().all()


def test_an_empty_step_table_counts_as_none(make_study):
    """A table without a row says nothing: its lap is one without steps, and no column suffers."""
    study = make_study(participants=2)
    path = study.folder / "sessions" / "P0001" / "steps-4.parquet"
    pd.read_parquet(path).iloc[:0].to_parquet(path)
    records = read_laps(study_frames(study))
    assert (records.without_steps, records.unrecorded, records.damaged) == (1, (), ())


def test_a_damaged_step_table_is_named_and_the_rest_measured(make_study):
    """Half a file: its lap has no measures, all the others do."""
    study = make_study(participants=2)
    path = study.folder / "sessions" / "P0001" / "steps-4.parquet"
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    records = read_laps(study_frames(study))
    assert records.without_steps == 1
    assert records.damaged[0].startswith("sessions/P0001/steps-4.parquet: ")
    assert records.measures["path_length_m"].notna().sum() == 7


def test_progress_is_told(study):
    """Long work says what it is doing."""
    said = []
    read_laps(study_frames(study), said.append)
    assert said[0].startswith("Measuring laps: 0 of")


def test_columns_without_any_value_are_named(make_study, erase):
    """Those of which no step of any lap has one; not those that some laps lack."""
    study = make_study(participants=2)
    assert read_laps(study_frames(study)).unrecorded == ()
    erase(study.folder, "h_would")
    erase(study.folder, "p_help", "P0001/steps-1.parquet")
    assert read_laps(study_frames(study)).unrecorded == ("h_would",)


def test_gaps_are_counted_in_laps(make_study):
    """What cannot be used of a lap's steps is named once, with the number of laps."""
    study = make_study(participants=2)
    assert read_laps(study_frames(study)).gaps == {}
    for who, lap in (("P0001", 1), ("P0001", 4), ("P0002", 4)):
        path = study.folder / "sessions" / who / f"steps-{lap}.parquet"
        steps = pd.read_parquet(path)
        steps["t_s"] = steps["t_s"].astype(int).astype(float)
        if lap == 4:
            steps.loc[3, "p_help"] = np.inf
        steps.to_parquet(path)
    assert read_laps(study_frames(study)).gaps == {
        "p_help is infinite in some steps: missing there": 2,
        "t_s does not increase from step to step: measures that need the time are missing": 3,
    }


def test_several_processes_read_what_one_reads(study, monkeypatch):
    """Laps come in their order, with the same numbers and the same kinds of columns."""
    frames = study_frames(study)
    one = read_laps(frames)
    monkeypatch.setattr(lap_records, "PIECE", 3)
    with processes(2) as others:
        two = read_laps(frames, others=others)
    pd.testing.assert_frame_equal(one.measures, two.measures)
    pd.testing.assert_frame_equal(one.steps, two.steps)
    assert (one.gaps, one.unrecorded) == (two.gaps, two.unrecorded)
