"""The comparison of variants as rows of the page's JSON."""

from collections.abc import Iterator
from typing import Any

import pandas as pd

from analysis.reproduction.row import Row

SECTION = "Robustness and baselines"

_ACCURACY = (
    ("auc_1", "auc after 1"),
    ("auc_training", "auc training median"),
    ("auc_test", "auc test median"),
)
_TEST_LAP = (
    ("rmse_v", "rmse a_v test median", "m/s"),
    ("rmse_w", "rmse a_w test median", "rad/s"),
    ("brier", "brier test median", ""),
    ("undecided", "undecided steps test", ""),
)
_NONE = (float("nan"), float("nan"))


def robustness_rows(table: pd.DataFrame) -> tuple[Row, ...]:
    """Return every variant's rows: without the paper's figure, so without a verdict.

    Parameters
    ----------
    table
        As ``analysis.reproduction.robustness.table.variant_table`` returns it.
    """
    records = ({str(k): v for k, v in r.items()} for r in table.to_dict("records"))
    return tuple(row for record in records for row in _rows(record))


def _rows(v: dict[str, Any]) -> Iterator[Row]:
    def row(what: str, unit: str, column: str, n: str, ends: tuple[float, float] = _NONE) -> Row:
        low, high = (float(end) for end in ends)
        quantity = f"{what}, {v['label']}"
        return Row(SECTION, quantity, unit, None, float(v[column]), int(v[n]), low, high,
                   kind="descriptive")  # fmt: skip

    def ends(column: str) -> tuple[float, float]:
        return v[f"{column}_low"], v[f"{column}_high"]

    for column, what in _ACCURACY:
        yield row(what, "", column, f"{column}_n", ends(column))
    for column, what, unit in _TEST_LAP:
        yield row(what, unit, column, "auc_test_n")
    for lap in ("lap_1", "lap_3"):
        what = f"model after {lap[-1]}"
        yield row(f"rd lap {what}", "s", f"{lap}_mean", f"{lap}_n", ends(lap))
        yield row(f"rd lap {what} sd", "s", f"{lap}_sd", f"{lap}_n")
        yield row(f"rd lap {what} undecided steps", "", f"{lap}_undecided", f"{lap}_n")
        if v["group"] != "default":
            change = f"d_{lap}"
            yield row(f"{what} minus default", "s", change, f"{lap}_n", ends(change))
