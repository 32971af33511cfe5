"""The effect that is there in a pool, and what moves it to a stated one."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from analysis.power.adjusted import adjusted, log_values, people_values
from analysis.power.pool import Pool
from protocols.declared import Comparison

Source = Literal["stated", "cohort"]


@dataclass(frozen=True, slots=True)
class Shift:
    """What is added to an analysis's differences, and the effect that is then there."""

    log: float
    unit: float
    effect: float
    source: Source


def shift_of(pool: Pool, analysis: Comparison, stated: float | None) -> Shift:
    """Centre the pool's differences on the stated effect; leave them where none is stated."""
    unit = pool.differences[analysis.name]
    if analysis.groups is not None:
        return _group_shift(pool, analysis, stated)
    if analysis.outcome != "lap_time_s":
        there = float(np.nanmean(unit))
        moved = 0.0 if stated is None else stated - there
        return Shift(moved, moved, there + moved, "cohort" if stated is None else "stated")
    everyone = np.arange(pool.size)[None]
    logs = log_values(pool, adjusted(pool, everyone), analysis)[0]
    there = float(np.nanmean(logs))
    if stated is None:
        return Shift(0.0, 0.0, there, "cohort")
    seconds = pool.reference_means[analysis.name] * math.expm1(stated) - float(np.nanmean(unit))
    return Shift(stated - there, seconds, stated, "stated")


def _group_shift(pool: Pool, analysis: Comparison, stated: float | None) -> Shift:
    """Move the first group to the stated effect on the second one."""
    everyone = np.arange(pool.size)[None]
    values = people_values(pool, adjusted(pool, everyone), analysis, everyone)[0]
    first, second = (values[pool.groups == name] for name in analysis.groups or ())
    there = float(np.nanmean(first) - np.nanmean(second))
    if stated is None:
        return Shift(0.0, 0.0, there, "cohort")
    return Shift(stated - there, stated - there, stated, "stated")
