"""Questionnaire answers by item and condition."""

import pandas as pd

from analysis.composites import answered
from analysis.frames import StudyFrames
from protocols.instrument import Instrument, Item
from protocols.laps import WHOLE_SESSION
from protocols.questions import asked_items
from protocols.study import StudyProtocol


def survey_table(frames: StudyFrames, instrument: Instrument) -> pd.DataFrame:
    """Return one row per item and condition in which it was to be asked, or was.

    Columns: item, text, condition, asked, answered, missing, not_reached, median, the count of
    every point of the scale (``n_1`` upwards), and agreement in percent of those who answered: the
    last two for items answered by a point.
    Everybody who is analysed was to be asked: asked = answered + missing (asked, but left out) +
    not_reached (no row in the record, because the participant had left or did not drive the lap).
    """
    answers = frames.surveys[frames.surveys["instrument"] == instrument.name]
    planned = planned_questions(frames.study.protocol, instrument)
    rows = []
    for item in instrument.items:
        for condition in (*frames.conditions, WHOLE_SESSION):
            chosen = (answers["item"] == item.id) & (answers["condition"] == condition)
            if (condition, item.id) in planned or chosen.any():
                given = _given(answers[chosen], item)
                rows.append({"item": item.id, "text": item.text, "condition": condition}
                            | _counts(given, len(frames.participants), instrument, item)
                            )  # fmt: skip
    nothing = _counts(pd.Series(dtype=float), 0, instrument, instrument.items[0])
    columns = ["item", "text", "condition", *nothing]
    return pd.DataFrame(rows, columns=columns)


def planned_questions(
    protocol: StudyProtocol, instrument: Instrument
) -> frozenset[tuple[str, str]]:
    """Return the conditions and items in which a protocol asks an instrument, practice apart."""
    after_laps = (
        (lap.condition, item)
        for lap in protocol.laps
        for survey in lap.survey
        if not lap.practice and survey.instrument == instrument.name
        for item in asked_items(protocol, lap, survey, instrument)
    )
    at_the_end = (
        (WHOLE_SESSION, item)
        for survey in protocol.survey
        if survey.instrument == instrument.name
        for item in (instrument.ids(assisted=True) if survey.items == "all" else survey.items)
    )
    return frozenset((*after_laps, *at_the_end))


def _given(answers: pd.DataFrame, item: Item) -> pd.Series:
    """Return the answers to an item; of text only whether there is any (0, or missing)."""
    if item.answer != "text":
        return answered(answers)
    if "response_text" not in answers:
        return pd.Series(float("nan"), index=answers.index)
    return answers["response_text"].notna().map({True: 0.0, False: float("nan")}).astype("float64")


def _counts(
    given: pd.Series, asked: int, instrument: Instrument, item: Item
) -> dict[str, float | int]:
    there = given.dropna()
    pointed = item.answer == "point" and len(there) > 0
    agreeing = int((there >= instrument.agreement_from).sum())
    sized = item.answer != "text" and len(there) > 0
    return {
        "asked": asked,
        "answered": len(there),
        "missing": len(given) - len(there),
        "not_reached": asked - len(given),
        "median": float(there.median()) if sized else float("nan"),
        **{
            f"n_{i}": int((there == i).sum()) if item.answer == "point" else 0
            for i in range(1, instrument.points + 1)
        },
        "agree_percent": 100 * agreeing / len(there) if pointed else float("nan"),
    }
