"""Composite scores of a questionnaire, and their reliability."""

import pandas as pd

from analysis.composites import scores, sheets, subscales
from analysis.frames import StudyFrames
from analysis.stats.cronbach_alpha import cronbach_alpha
from analysis.stats.describe import describe
from protocols.instrument import Instrument
from protocols.laps import WHOLE_SESSION

RELIABLE = 0.6
"""Alpha from which on a scale of several items is interpreted; below, its items measure different
things."""


def scale_table(frames: StudyFrames, instrument: Instrument) -> pd.DataFrame:
    """Return one row per subscale and condition: Cronbach's alpha, and the score.

    A person's score is the mean of the subscale's items, reverse-coded ones turned, on the
    instrument's own scale of scores; who left an item out, or was not asked, has none and counts
    as incomplete. Items that were not asked after a condition are not part of its score.
    """
    rows = []
    for subscale in subscales(instrument):
        for condition in (*frames.conditions, WHOLE_SESSION):
            answers = sheets(frames, instrument, subscale, condition)
            if answers.empty:
                continue
            alpha = cronbach_alpha(answers.to_numpy())
            score = describe(scores(frames, instrument, subscale, condition))
            rows.append(
                {
                    "subscale": subscale,
                    "condition": condition,
                    "items": answers.shape[1],
                    "n": score.n,
                    "incomplete": len(frames.participants) - score.n,
                    "mean": score.mean,
                    "sd": score.sd,
                    "alpha": alpha.estimate,
                    "alpha_low": alpha.low,
                    "alpha_high": alpha.high,
                    "note": alpha.why_not or _unreliable(alpha.estimate),
                }
            )
    columns = ["subscale", "condition", "items", "n", "incomplete", "mean", "sd", "alpha",
               "alpha_low", "alpha_high", "note"]  # fmt: skip
    return pd.DataFrame(rows, columns=columns)


def _unreliable(alpha: float) -> str:
    return f"not interpreted: alpha below {RELIABLE:g}" if alpha < RELIABLE else ""
