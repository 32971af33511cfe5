"""Composite scores of a questionnaire, and their reliability."""

import pandas as pd

from analysis.frames import StudyFrames
from analysis.stats.cronbach_alpha import cronbach_alpha
from analysis.stats.describe import describe
from protocols.instrument import Instrument, Item


def scale_table(frames: StudyFrames, instrument: Instrument) -> pd.DataFrame:
    """Return one row per subscale and condition: Cronbach's alpha, and the score.

    A person's score is the mean of the subscale's items, reverse-coded ones turned; who left an
    item out, or was not asked, has none and counts as incomplete. Items that were not asked after
    a condition are not part of its score.
    """
    rows = []
    for subscale in dict.fromkeys(item.subscale for item in instrument.items):
        items = [item for item in instrument.items if item.subscale == subscale]
        for condition in frames.conditions:
            sheets = _sheets(frames, instrument, items, condition)
            if sheets.empty:
                continue
            alpha = cronbach_alpha(sheets.to_numpy())
            score = describe(sheets.dropna().mean(axis=1))
            rows.append(
                {
                    "subscale": subscale,
                    "condition": condition,
                    "items": sheets.shape[1],
                    "n": score.n,
                    "incomplete": len(frames.participants) - score.n,
                    "mean": score.mean,
                    "sd": score.sd,
                    "alpha": alpha.estimate,
                    "alpha_low": alpha.low,
                    "alpha_high": alpha.high,
                    "note": alpha.why_not or "",
                }
            )
    columns = ["subscale", "condition", "items", "n", "incomplete", "mean", "sd", "alpha",
               "alpha_low", "alpha_high", "note"]  # fmt: skip
    return pd.DataFrame(rows, columns=columns)


def _sheets(
    frames: StudyFrames, instrument: Instrument, items: list[Item], condition: str
) -> pd.DataFrame:
    """Return turned answers after a condition: participants by items."""
    answers = frames.surveys
    chosen = (
        (answers["instrument"] == instrument.name)
        & (answers["condition"] == condition)
        & answers["item"].isin([item.id for item in items])
    )
    given = answers[chosen]
    given = given.assign(value=pd.to_numeric(given["response"]).astype("float64"))
    sheets = given.pivot_table(index="participant", columns="item", values="value", dropna=False)
    for item in items:
        if item.reverse and item.id in sheets:
            sheets[item.id] = instrument.points + 1 - sheets[item.id]
    return sheets
