"""Simulated studies of twelve, drawn from a pool, and where the paper falls among them."""

from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

CONDITIONS = ("baseline", "limited", "human-assisted", "model-assisted")

PUBLISHED = {
    "baseline mean": 48.5,
    "baseline sd": 20.0,
    "limited mean": 76.7,
    "limited sd": 24.8,
    "human-assisted mean": 44.55,
    "human-assisted sd": 8.0,
    "model-assisted mean": 56.1,
    "model-assisted sd": np.nan,
    "limited - model": 20.6,
    "limited / model": 1.37,
    "model - human": 11.55,
}
"""Soh & Demiris (2013), section V.B; the last is the difference of its means."""

JOINT = ("human-assisted mean", "human-assisted sd", "model-assisted mean")
"""Printed and predicted: looked at together."""


def table(laps: pd.DataFrame) -> pd.DataFrame:
    """Return lap times in seconds, a person a row, a condition a column; NaN where unfinished."""
    counted = laps[~laps["practice"]]
    wide = counted.pivot_table(index="number", columns="condition", values="lap_time_s")
    people = sorted(laps["number"].unique())
    return wide.reindex(index=people, columns=list(CONDITIONS))


def draw_studies(times: pd.DataFrame, studies: int, size: int, seed: int) -> pd.DataFrame:
    """Return what each study would print, a study a row.

    Each study's people are drawn from the pool without replacement; studies share people.
    """
    rng = np.random.default_rng(seed)
    values = times.to_numpy()
    return pd.DataFrame(
        [printed(values[rng.choice(len(values), size, replace=False)]) for _ in range(studies)]
    )


def printed(times: NDArray[np.float64]) -> dict[str, float]:
    """Return the figures of one study, as the paper prints them: from finished laps.

    Parameters
    ----------
    times
        Shape (people, 4): lap times in the order of ``CONDITIONS``, s; NaN where unfinished.
    """
    figures = {}
    for name, column in zip(CONDITIONS, times.T, strict=True):
        done = column[~np.isnan(column)]
        figures[f"{name} mean"] = float(done.mean()) if len(done) else np.nan
        figures[f"{name} sd"] = float(done.std(ddof=1)) if len(done) > 1 else np.nan
    limited, model = figures["limited mean"], figures["model-assisted mean"]
    figures["limited - model"] = limited - model
    figures["limited / model"] = limited / model
    figures["model - human"] = model - figures["human-assisted mean"]
    return figures


@dataclass(frozen=True)
class Prediction:
    """One figure over simulated studies.

    Attributes
    ----------
    median, low, high
        Median and central 95% of the studies.
    below
        Share of studies below the published figure; NaN where nothing is published.
    """

    median: float
    low: float
    high: float
    below: float


def predict(studies: pd.DataFrame) -> dict[str, Prediction]:
    """Return each figure's prediction."""
    found = {}
    for name in studies.columns:
        values = studies[name].dropna()
        low, median, high = np.percentile(values, [2.5, 50.0, 97.5])
        paper = PUBLISHED[name]
        below = np.nan if np.isnan(paper) else float((values < paper).mean())
        found[name] = Prediction(float(median), float(low), float(high), below)
    return found


def as_far_out(studies: pd.DataFrame) -> float:
    """Return the share of studies at least as far from the studies' middle as the paper.

    By Mahalanobis distance of the logarithms of the figures in ``JOINT``; 0 says that no study
    is as unlike the others as the paper is.
    """
    logs = np.log(studies[list(JOINT)].dropna().to_numpy())
    paper = np.log([PUBLISHED[name] for name in JOINT])
    middle, inverse = logs.mean(axis=0), np.linalg.inv(np.cov(logs.T))

    def far(points: NDArray[np.float64]) -> NDArray[np.float64]:
        off = np.atleast_2d(points) - middle
        return np.asarray(np.einsum("ij,jk,ik->i", off, inverse, off))

    return float((far(logs) >= far(paper)[0]).mean())
