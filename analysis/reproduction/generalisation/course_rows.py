"""Other courses as rows of the page's JSON."""

from collections.abc import Hashable, Iterator
from typing import Any

import pandas as pd

from analysis.reproduction.row import Row

SECTION = "Generalisation to other courses"


def generalisation_rows(laps: pd.DataFrame, shares: pd.DataFrame) -> tuple[Row, ...]:
    """Return lap times, differences and shares of help: without a verdict.

    Parameters
    ----------
    laps, shares
        As ``course_table`` and ``section_table`` return them.
    """
    return (*_lap_rows(laps), *map(_share_row, shares.to_dict("records")))


def _lap_rows(laps: pd.DataFrame) -> Iterator[Row]:
    for r in laps.to_dict("records"):
        course, n = r["course"], r["n"]
        ends = (r["low_s"], r["high_s"])
        yield _row(f"{course} lap {r['condition']}", "s", r["mean_s"], n, ends)
        if r["condition"] == "model":
            for other in ("limited", "demonstrator"):
                ends = (r[f"over_{other}_low"], r[f"over_{other}_high"])
                yield _row(f"{course} model minus {other}", "s", r[f"over_{other}_s"], n, ends)


def _share_row(r: dict[Hashable, Any]) -> Row:
    quantity = f"{r['course']} steps helped, {str(r['kind']).replace('_', ' ')}"
    return _row(quantity, "%", 100 * r["assisted"], r["n"], (100 * r["low"], 100 * r["high"]))


def _row(quantity: str, unit: str, ours: float, n: int, ends: tuple[float, float]) -> Row:
    low, high = map(float, ends)
    return Row(SECTION, quantity, unit, None, float(ours), int(n), low, high, kind="descriptive")
