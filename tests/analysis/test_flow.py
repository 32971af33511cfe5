"""Who took part, and which laps there are: the arithmetic adds up."""

import pandas as pd
import pytest

from analysis.flow import participants_flow
from analysis.frames import study_frames
from analysis.tables.lap_times import lap_time_table
from protocols.record.reader import open_study


@pytest.fixture
def eventful(make_study):
    """Return a study in which laps were cut short and people left or were excluded."""
    return make_study(
        participants=6,
        unfinished=frozenset({(1, 2), (2, 2)}),
        withdrew={3: 3, 5: 0},
        words={3: "I feel dizzy", 5: "not my day"},
        excluded={4: "too many collisions", 5: "too many collisions"},
    )


def test_participants_add_up(eventful):
    """Planned = not run + failed + recorded; recorded = refused + excluded + analysed."""
    flow = participants_flow(study_frames(eventful))
    assert flow.planned == flow.not_run + flow.failed + flow.recorded == 6
    assert flow.recorded == flow.refused + sum(flow.excluded.values()) + flow.analysed
    assert flow.excluded == {"too many collisions": 2}
    assert (flow.analysed, flow.completed) == (4, 1)


def test_a_lap_too_many_makes_up_for_no_other(make_study):
    """Who drove one condition twice and another never did not finish every planned lap."""
    folder = make_study(participants=2).folder
    laps = pd.read_parquet(folder / "laps.parquet")
    laps.loc[(laps["participant"] == "P0001") & (laps["lap"] == 3), "condition"] = "limited"
    laps.to_parquet(folder / "laps.parquet")
    assert participants_flow(study_frames(open_study(folder))).completed == 1


def test_nobody_finished_when_nothing_was(make_study):
    """Without a finished lap the count is 0."""
    unfinished = frozenset((who, lap) for who in (1, 2) for lap in range(5))
    frames = study_frames(make_study(participants=2, unfinished=unfinished))
    assert participants_flow(frames).completed == 0


def test_laps_add_up(eventful):
    """Per condition, laps planned = finished + unfinished + not driven."""
    laps = participants_flow(study_frames(eventful)).laps.set_index("condition")
    parts = laps.drop(columns=["planned", "finished_without_time"]).sum(axis=1)
    assert (laps["planned"] == parts).all()
    assert laps.loc["limited", "time_limit"] == 2
    assert laps.loc["human-assisted", "withdrew"] == 1
    assert laps.loc["model-assisted", "not_driven"] == 1


def test_who_leaves_in_practice_is_in_every_denominator(make_study):
    """The lap rows still add up to all participants, with the one who left as not driven."""
    flow = participants_flow(study_frames(make_study(participants=3, withdrew={2: 0})))
    assert (flow.analysed, flow.completed) == (3, 2)
    assert flow.laps["planned"].tolist() == [3] * 4
    assert flow.laps["not_driven"].tolist() == [1] * 4


def test_a_finished_lap_without_a_time_is_counted(make_study):
    """Finished = timed + without a time, in the lap flow and beside the lap times."""
    folder = make_study(participants=3).folder
    laps = pd.read_parquet(folder / "laps.parquet")
    laps.loc[(laps["participant"] == "P0001") & (laps["lap"] == 2), "lap_time_s"] = None
    laps.to_parquet(folder / "laps.parquet")
    frames = study_frames(open_study(folder))
    flow = participants_flow(frames).laps.set_index("condition")
    assert flow.loc["limited", ["finished", "finished_without_time"]].tolist() == [3, 1]
    times = lap_time_table(frames).set_index("condition")
    assert times.loc["limited", ["n", "without_time"]].tolist() == [2, 1]
    assert times["without_time"].sum() == 1


def test_withdrawals_keep_their_words(eventful):
    """All who left are listed with their words, also those who left in practice or are excluded."""
    left = participants_flow(study_frames(eventful)).withdrawals
    assert [tuple(row) for row in left.itertuples(index=False)] == [
        ("P0003", 3, "human-assisted", "I feel dizzy"),
        ("P0005", 0, "familiarisation", "not my day"),
    ]


def test_who_refused_consent_is_not_quoted(eventful):
    """Words of a participant without consent stay in the record."""
    people = pd.read_parquet(eventful.folder / "participants.parquet").drop(columns="traits")
    people["consented"] = people["participant"] != "P0003"
    people.to_parquet(eventful.folder / "participants.parquet")
    flow = participants_flow(study_frames(open_study(eventful.folder)))
    assert list(flow.withdrawals["participant"]) == ["P0005"]


def test_the_excluded_are_in_no_frame(eventful):
    """No lap or answer of an excluded participant is analysed; nor is any practice lap."""
    frames = study_frames(eventful)
    out = {"P0004", "P0005"}
    assert not out & set(frames.laps["participant"])
    assert not out & set(frames.surveys["participant"])
    assert 0 not in set(frames.laps["lap"])


def test_rows_that_refer_to_nothing_are_named(make_study):
    """A lap of a stranger, an unknown condition, an unknown instrument: said, not dropped."""
    folder = make_study(participants=2).folder
    assert participants_flow(study_frames(open_study(folder))).left_out == ()
    laps = pd.read_parquet(folder / "laps.parquet")
    laps.loc[0, "participant"] = "P0099"
    laps.loc[1, "condition"] = "blindfolded"
    laps.to_parquet(folder / "laps.parquet")
    surveys = pd.read_parquet(folder / "surveys.parquet")
    surveys.loc[0, "instrument"] = "horoscope"
    surveys.to_parquet(folder / "surveys.parquet")
    said = participants_flow(study_frames(open_study(folder))).left_out
    assert said == (
        "1 lap of people who are not in the table of participants (P0099)",
        "1 lap of conditions that the study does not have (blindfolded)",
        "1 answer of instruments that the study does not have (horoscope)",
    )
