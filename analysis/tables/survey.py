"""Questionnaire answers by item and condition."""

import pandas as pd

from analysis.frames import StudyFrames
from protocols.instrument import Instrument


def survey_table(frames: StudyFrames, instrument: Instrument) -> pd.DataFrame:
    """Return one row per item and condition in which it was asked.

    Columns: item, text, condition, asked, answered, missing, median, the count of every point of
    the scale (``n_1`` upwards), and agreement in percent of those who answered. An answer that
    was never asked for because the participant left early is in neither ``asked`` nor ``missing``.
    """
    answers = frames.surveys[frames.surveys["instrument"] == instrument.name]
    rows = []
    for item in instrument.items:
        for condition in frames.conditions:
            chosen = (answers["item"] == item.id) & (answers["condition"] == condition)
            if chosen.any():
                given = pd.to_numeric(answers.loc[chosen, "response"])
                rows.append({"item": item.id, "text": item.text, "condition": condition}
                            | _counts(given, instrument))  # fmt: skip
    columns = ["item", "text", "condition", *_counts(pd.Series(dtype=float), instrument)]
    return pd.DataFrame(rows, columns=columns)


def _counts(given: pd.Series, instrument: Instrument) -> dict[str, float | int]:
    answered = given.dropna()
    agreeing = int((answered >= instrument.agreement_from).sum())
    return {
        "asked": len(given),
        "answered": len(answered),
        "missing": len(given) - len(answered),
        "median": float(answered.median()) if len(answered) else float("nan"),
        **{f"n_{i}": int((answered == i).sum()) for i in range(1, instrument.points + 1)},
        "agree_percent": 100 * agreeing / len(answered) if len(answered) else float("nan"),
    }
