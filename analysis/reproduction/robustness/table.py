"""One row per variant: how well it predicts, and how fast the laps are that it helps in."""

from collections.abc import Sequence

import numpy as np
import pandas as pd

from analysis.reproduction.accuracy import spread
from analysis.reproduction.robustness.evidence import DEMONSTRATIONS, Tried
from analysis.stats.describe import describe
from analysis.stats.mean_difference import mean_difference


def variant_table(tested: Sequence[Tried]) -> pd.DataFrame:
    """Return one row per variant.

    Returns
    -------
    DataFrame
        ``name``, ``group``, ``label``. Medians over random orders: ``auc_1`` after one
        demonstration with quartiles ``auc_1_low`` and ``auc_1_high``; ``auc_training`` over the
        laps that were learnt from and ``auc_test`` in the last one, with quartiles; of the test
        lap ``rmse_v`` (m/s), ``rmse_w`` (rad/s), ``brier`` and ``undecided``, the share of steps
        with |p(h) - 0.5| < 0.001. Of laps after 1 and 3 demonstrations: ``lap_n_mean`` with its
        95% interval, ``lap_n_sd``, ``lap_n_median`` (s), their number ``lap_n_n``, how many of
        them are ``lap_n_unfinished`` and count as the time they were given, and
        ``lap_n_undecided``, the share of undecided steps. Against the default, ``d_auc_1``,
        ``d_lap_1`` and ``d_lap_3`` with ``_low`` and ``_high`` (95%).
    """
    return pd.DataFrame([_row(one, tested[0]) for one in tested])


def _row(one: Tried, default: Tried) -> dict[str, object]:
    variant = one.variant
    row: dict[str, object] = {
        "name": variant.name,
        "group": variant.group,
        "label": variant.label,
        **_accuracy(one.accuracy),
    }
    for n in DEMONSTRATIONS:
        condition = f"model after {n}"
        row |= _laps(f"lap_{n}", one.laps[condition], one.finished[condition])
        row[f"lap_{n}_undecided"] = one.undecided[f"model after {n}"]
    row |= _change("d_auc_1", _auc_after_1(one), _auc_after_1(default))
    for n in DEMONSTRATIONS:
        condition = f"model after {n}"
        row |= _change(f"d_lap_{n}", one.laps[condition], default.laps[condition])
    return row


def _accuracy(accuracy: pd.DataFrame) -> dict[str, float]:
    test = accuracy[accuracy["test"]]
    parts = {
        "auc_1": accuracy[accuracy["demonstrations"] == 1]["auc"],
        "auc_training": accuracy[~accuracy["test"]]["auc"],
        "auc_test": test["auc"],
    }
    found: dict[str, float] = {}
    for name, values in parts.items():
        s = spread(values)
        found |= {name: s.median, f"{name}_low": s.low, f"{name}_high": s.high, f"{name}_n": s.n}
    for name in ("rmse_v", "rmse_w", "brier", "undecided"):
        found[name] = spread(test[name]).median
    return found


def _laps(name: str, times: pd.Series, finished: pd.Series) -> dict[str, float]:
    d, about = describe(times), mean_difference(times)
    return {
        f"{name}_mean": d.mean,
        f"{name}_low": about.low,
        f"{name}_high": about.high,
        f"{name}_sd": d.sd,
        f"{name}_median": d.median,
        f"{name}_n": d.n,
        f"{name}_unfinished": int((~finished).sum()),
    }


def _change(name: str, values: pd.Series, reference: pd.Series) -> dict[str, float]:
    differences = (values - reference).dropna()
    if len(differences) and np.ptp(differences) == 0:
        same = float(differences.iloc[0])
        return {name: same, f"{name}_low": same, f"{name}_high": same}
    found = mean_difference(differences)
    return {name: found.estimate, f"{name}_low": found.low, f"{name}_high": found.high}


def _auc_after_1(one: Tried) -> pd.Series:
    after_1 = one.accuracy[one.accuracy["demonstrations"] == 1]
    return after_1.set_index("run")["auc"]
