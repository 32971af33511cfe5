"""How well models predicted when and how to help, lap by lap of their teaching (Figure 4)."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from analysis.measures.discrimination import area_under_roc
from analysis.reproduction.anticipation import leads
from analysis.reproduction.teaching import PredictedLap, Run
from lad.calibration import brier_score

UNDECIDED = 0.001
"""p(h) nearer to 0.5 than this is undecided."""


@dataclass(frozen=True, slots=True)
class Spread:
    """A quantity over runs: median, quartiles, and of how many values."""

    median: float
    low: float
    high: float
    n: int


def accuracy_table(runs: Sequence[Run]) -> pd.DataFrame:
    """Return one row per run and lap.

    Returns
    -------
    DataFrame
        ``run``; ``demonstrations`` learnt before the lap; ``lap``, which of the recorded laps it
        is; ``test``, whether the lap was only predicted; ``auc`` of p(h); ``rmse_v`` (m/s) and
        ``rmse_w`` (rad/s) where the demonstrator helped; ``brier``; ``undecided``, the share of
        steps with |p(h) - 0.5| < 0.001; ``lead_s``, the mean anticipation of the lap's takeovers.
    """
    return pd.DataFrame(
        [
            {
                "run": run,
                "demonstrations": before,
                "lap": lap.lap,
                "test": before == len(laps) - 1,
                "auc": auc(lap),
                "rmse_v": rmse(lap, 0),
                "rmse_w": rmse(lap, 1),
                "brier": brier_score(lap.p_help, lap.helped),
                "undecided": float((np.abs(lap.p_help - 0.5) < UNDECIDED).mean()),
                "lead_s": _mean(leads([lap])),
            }
            for run, laps in enumerate(runs)
            for before, lap in enumerate(laps)
        ]
    )


def auc(lap: PredictedLap) -> float:
    """Return the area under the ROC curve of p(h); NaN where help was given always or never."""
    if lap.helped.all() or not lap.helped.any():
        return float("nan")
    return area_under_roc(lap.p_help, lap.helped)


def rmse(lap: PredictedLap, component: int) -> float:
    """Return the error of the predicted command where the demonstrator helped.

    Parameters
    ----------
    lap
        The lap.
    component
        0 for translation, m/s; 1 for rotation, rad/s.
    """
    off = lap.mean[lap.helped, component] - lap.action[lap.helped, component]
    return float(np.sqrt((off**2).mean())) if len(off) else float("nan")


def spread(values: Iterable[float]) -> Spread:
    """Return median and quartiles of the values that are not missing."""
    found = np.array([v for v in values if np.isfinite(v)])
    if not len(found):
        return Spread(np.nan, np.nan, np.nan, 0)
    low, median, high = (float(q) for q in np.quantile(found, [0.25, 0.5, 0.75]))
    return Spread(median, low, high, len(found))


def pooled(
    runs: Sequence[Run], demonstrations: int
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return p(h) and the demonstrator's signal of all runs' laps after some demonstrations."""
    laps = [run[demonstrations] for run in runs]
    return (
        np.concatenate([lap.p_help for lap in laps]),
        np.concatenate([lap.helped for lap in laps]),
    )


def _mean(values: NDArray[np.float64]) -> float:
    known = values[np.isfinite(values)]
    return float(known.mean()) if len(known) else float("nan")
