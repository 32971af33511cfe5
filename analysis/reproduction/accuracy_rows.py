"""How well the model predicted when and how to help, beside the paper's (section IV.D)."""

from collections.abc import Iterator, Sequence

import numpy as np
import pandas as pd

from analysis.reproduction.accuracy import Spread, spread
from analysis.reproduction.anticipation import leads
from analysis.reproduction.row import Kind, Row
from analysis.reproduction.teaching import Run
from analysis.reproduction.tolerances import judged

SECTION = "Model accuracy (IV.D)"

AUC_AFTER_1, AUC_TRAINING, AUC_TEST = 0.95, 0.9905, 0.9881
"""As section IV.D prints them."""


def accuracy_rows(accuracy: pd.DataFrame, runs: Sequence[Run]) -> tuple[Row, ...]:
    """Return the rows of ``rd-accuracy``: medians over runs with quartiles.

    Parameters
    ----------
    accuracy
        As ``analysis.reproduction.accuracy.accuracy_table`` returns it.
    runs
        The runs it is about.
    """
    return tuple(map(judged, (*_when(accuracy), *_how(accuracy), *_anticipation(runs))))


def _when(accuracy: pd.DataFrame) -> Iterator[Row]:
    training, test = accuracy[~accuracy["test"]], accuracy[accuracy["test"]]
    after_1 = accuracy[accuracy["demonstrations"] == 1]
    yield _row("auc after 1", "", AUC_AFTER_1, spread(after_1["auc"]), "predicted")
    yield _row("auc training median", "", AUC_TRAINING, spread(training["auc"]), "predicted")
    yield _row("auc test median", "", AUC_TEST, spread(test["auc"]), "predicted")
    yield _row("brier after 1", "", None, spread(after_1["brier"]), "descriptive")
    yield _row("brier test median", "", None, spread(test["brier"]), "descriptive")


def _how(accuracy: pd.DataFrame) -> Iterator[Row]:
    after_1, test = accuracy[accuracy["demonstrations"] == 1], accuracy[accuracy["test"]]
    for laps, which in ((after_1, "after 1"), (test, "test median")):
        for column, unit, name in (("rmse_v", "m/s", "a_v"), ("rmse_w", "rad/s", "a_w")):
            yield _row(f"rmse {name} {which}", unit, None, spread(laps[column]), "descriptive")


def _anticipation(runs: Sequence[Run]) -> Iterator[Row]:
    tests = [leads([run[-1]]) for run in runs]
    means = [float(lead[np.isfinite(lead)].mean()) for lead in tests if np.isfinite(lead).any()]
    yield _row("anticipation lead test median", "s", None, spread(means), "predicted")
    ahead = [100 * float((lead > 0).mean()) for lead in tests if len(lead)]
    yield Row(
        SECTION, "takeovers anticipated test", "%", None,
        float(np.mean(ahead)) if ahead else float("nan"), len(ahead), float("nan"), float("nan"),
        kind="predicted",
    )  # fmt: skip


def _row(quantity: str, unit: str, paper: float | None, found: Spread, kind: Kind) -> Row:
    return Row(
        SECTION, quantity, unit, paper, found.median, found.n, found.low, found.high, kind=kind
    )
