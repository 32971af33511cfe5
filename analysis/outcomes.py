"""Outcomes by participant and condition: the pairs that paired tests need."""

import pandas as pd

from analysis.composites import answered, scores_by_participant
from analysis.frames import StudyFrames
from protocols.declared import Comparison

UNITS = {"lap_time_s": "s", "duration_s": "s", "contact_time_s": "s"}
"""Units of the lap outcomes that have one."""


def by_participant(frames: StudyFrames, outcome: str) -> pd.DataFrame:
    """Return an outcome of the lap table, or of a measure: rows participants, columns conditions.

    Where a condition was driven more than once, a participant's laps are averaged. Lap times exist
    for finished laps only; other outcomes include unfinished laps.

    Parameters
    ----------
    frames
        The study.
    outcome
        A numeric column of the lap table.
    """
    return _wide(frames, frames.laps.assign(value=pd.to_numeric(frames.laps[outcome])))


def answers_by_participant(frames: StudyFrames, instrument: str, item: str) -> pd.DataFrame:
    """Return the answers to an item, or a composite score: rows participants, columns conditions.

    Where a condition was driven more than once, the last answer counts (``StudyFrames.surveys``).

    Parameters
    ----------
    frames
        The study.
    instrument
        An instrument's name.
    item
        One of its items, or else of its subscales.
    """
    asked = frames.study.header.study.instrument(instrument)
    if not any(known.id == item for known in asked.items):
        return scores_by_participant(frames, asked, item)
    return wide_answers(frames, instrument, item)


def wide_answers(frames: StudyFrames, instrument: str, item: str) -> pd.DataFrame:
    """Return the answers to one item: rows participants, columns conditions."""
    surveys = frames.surveys
    asked = surveys[(surveys["instrument"] == instrument) & (surveys["item"] == item)]
    return _wide(frames, asked.assign(value=answered(asked)))


def outcome_of(frames: StudyFrames, comparison: Comparison) -> pd.DataFrame:
    """Return the outcome that a declared comparison names: participants by conditions."""
    if comparison.item is None:
        return by_participant(frames, comparison.outcome)
    return answers_by_participant(frames, *comparison.item)


def values(frames: StudyFrames, outcome: str, condition: str) -> pd.Series:
    """Return an outcome lap by lap, in one condition."""
    laps = frames.laps[frames.laps["condition"] == condition]
    return pd.to_numeric(laps[outcome]).astype("float64")


def _wide(frames: StudyFrames, rows: pd.DataFrame) -> pd.DataFrame:
    wide = rows.pivot_table(
        index="participant", columns="condition", values="value", aggfunc="mean", dropna=False
    )
    return wide.reindex(
        index=sorted(frames.participants["participant"]), columns=list(frames.conditions)
    ).astype("float64")
