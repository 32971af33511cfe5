"""The table that ranks assistants: means by setting, differences in pairs, and mean ranks."""

from collections.abc import Mapping

import pandas as pd

from analysis.benchmark.measures import MEASURES
from analysis.stats.mean_difference import mean_difference

BY = "minus_demonstrator_s"
"""What assistants are ranked by: how much slower than the demonstrator's their laps are."""

WORST = ("lap_s", BY, "takeovers")
"""Measures of which the largest is given beside the mean."""


def cell_table(measures: pd.DataFrame) -> pd.DataFrame:
    """Return means over replicates, with the 95% interval of the lap time.

    Parameters
    ----------
    measures
        Rows of ``measures_of`` with columns ``setting`` and ``assistant``.

    Returns
    -------
    DataFrame
        One row for each setting, number of demonstrations and assistant: ``n``, ``low`` and
        ``high`` of ``minus_demonstrator_s``, the mean of each measure, and of those in ``WORST``
        the largest, as ``worst_`` and the name.
    """
    rows = []
    for key, cell in measures.groupby(["setting", "demonstrations", "assistant"], sort=False):
        result = mean_difference(cell[BY].tolist())
        means = {name: float(cell[name].mean()) for name in MEASURES}
        worst = {f"worst_{name}": float(cell[name].max()) for name in WORST}
        keys = dict(zip(("setting", "demonstrations", "assistant"), key, strict=True))
        rows.append(keys | {"n": len(cell), "low": result.low, "high": result.high} | means | worst)
    return pd.DataFrame(rows)


def ranking(measures: pd.DataFrame) -> pd.DataFrame:
    """Return the assistants, best mean rank first.

    In every setting and after every number of demonstrations assistants get ranks by their mean
    lap; equal ones share. Only cells in which all of them took part are ranked. Differences from
    the best-ranked are taken replicate by replicate: the same seed gives every assistant the same
    people, noise and demonstrations.

    Returns
    -------
    DataFrame
        ``assistant``, ``mean_rank``, ``cells``, mean ``minus_demonstrator_s``, ``finished``, and
        ``slower_s`` than the best-ranked with its 95% interval ``low`` to ``high`` over ``pairs``
        replicates, each the mean over the cells it has in common.
    """
    where = ["setting", "demonstrations"]
    common = measures.pivot_table(BY, where, "assistant", aggfunc="mean").dropna()
    ranks = common.rank(axis=1).mean().sort_values(kind="stable")
    shared = measures.set_index(where).loc[common.index].reset_index()
    best = _by_replicate(shared, str(ranks.index[0])) if len(ranks) else pd.Series(dtype=float)
    return pd.DataFrame(
        [_ranked(str(name), float(rank), len(common), shared, best) for name, rank in ranks.items()]
    )


def _ranked(
    name: str, rank: float, cells: int, measures: pd.DataFrame, best: pd.Series
) -> Mapping[str, object]:
    own = measures[measures["assistant"] == name]
    slower = mean_difference((_by_replicate(measures, name) - best).dropna().tolist())
    return {
        "assistant": name,
        "mean_rank": rank,
        "cells": cells,
        BY: float(own[BY].mean()),
        "finished": float(own["finished"].mean()),
        "slower_s": slower.estimate,
        "low": slower.low,
        "high": slower.high,
        "pairs": slower.n,
    }


def _by_replicate(measures: pd.DataFrame, name: str) -> pd.Series:
    own = measures[measures["assistant"] == name]
    return own.groupby("participant")[BY].mean()
