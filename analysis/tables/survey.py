"""Questionnaire answers by item and condition."""

import pandas as pd

from analysis.frames import StudyFrames
from protocols.instrument import Instrument
from protocols.questions import asked_items
from protocols.study import StudyProtocol


def survey_table(frames: StudyFrames, instrument: Instrument) -> pd.DataFrame:
    """Return one row per item and condition in which it was to be asked, or was.

    Columns: item, text, condition, asked, answered, missing, not_reached, median, the count of
    every point of the scale (``n_1`` upwards), and agreement in percent of those who answered.
    Everybody who is analysed was to be asked: asked = answered + missing (asked, but left out) +
    not_reached (no row in the record, because the participant had left or did not drive the lap).
    """
    answers = frames.surveys[frames.surveys["instrument"] == instrument.name]
    planned = planned_questions(frames.study.protocol, instrument)
    rows = []
    for item in instrument.items:
        for condition in frames.conditions:
            chosen = (answers["item"] == item.id) & (answers["condition"] == condition)
            if (condition, item.id) in planned or chosen.any():
                given = pd.to_numeric(answers.loc[chosen, "response"])
                rows.append({"item": item.id, "text": item.text, "condition": condition}
                            | _counts(given, len(frames.participants), instrument))  # fmt: skip
    columns = ["item", "text", "condition", *_counts(pd.Series(dtype=float), 0, instrument)]
    return pd.DataFrame(rows, columns=columns)


def planned_questions(
    protocol: StudyProtocol, instrument: Instrument
) -> frozenset[tuple[str, str]]:
    """Return the conditions and items in which a protocol asks an instrument, practice apart."""
    return frozenset(
        (lap.condition, item)
        for lap in protocol.laps
        for survey in lap.survey
        if not lap.practice and survey.instrument == instrument.name
        for item in asked_items(protocol, lap, survey, instrument)
    )


def _counts(given: pd.Series, asked: int, instrument: Instrument) -> dict[str, float | int]:
    answered = given.dropna()
    agreeing = int((answered >= instrument.agreement_from).sum())
    return {
        "asked": asked,
        "answered": len(answered),
        "missing": len(given) - len(answered),
        "not_reached": asked - len(given),
        "median": float(answered.median()) if len(answered) else float("nan"),
        **{f"n_{i}": int((answered == i).sum()) for i in range(1, instrument.points + 1)},
        "agree_percent": 100 * agreeing / len(answered) if len(answered) else float("nan"),
    }
