"""Rows as they are printed."""

from collections.abc import Mapping

from analysis.report.numbers import NOTHING, interval, number
from analysis.reproduction.row import Row, Rule, Verdict

VERDICT_TEXT: Mapping[Verdict, str] = {"holds": "holds", "differs": "differs", "none": ""}
"""A verdict as a word; empty without a verdict."""

DIGITS: Mapping[str, int] = {"s": 2, "%": 0, "": 4, "m/s": 3, "rad/s": 3}
"""Printed decimals by unit; 2 for others."""

_TOLERANCE: Mapping[Rule, str] = {
    "near paper": "paper ± {}",
    "at least": "at least {}",
    "near zero": "0 ± {}",
    "interval near zero": "interval within ± {}",
}


def number_of(row: Row, value: float | None) -> str:
    """Return one of a row's numbers with the decimals of its unit."""
    return NOTHING if value is None else number(value, DIGITS.get(row.unit, 2))


def interval_of(row: Row) -> str:
    """Return a row's interval."""
    return interval(row.low, row.high, DIGITS.get(row.unit, 2))


def tolerance_of(row: Row) -> str:
    """Return in words what a row's tolerance allows.

    Examples
    --------
    >>> tolerance_of(Row("IV.D", "auc test median", "", 0.9881, 0.999, 15, 0.99, 1.0,
    ...                  kind="predicted", tolerance=0.0031, rule="at least"))
    'at least 0.985'
    """
    if row.tolerance is None:
        return NOTHING
    if row.rule == "at least" and row.paper is not None:
        return _TOLERANCE[row.rule].format(f"{row.paper - row.tolerance:.4g}")
    return _TOLERANCE[row.rule].format(f"{row.tolerance:g}")
