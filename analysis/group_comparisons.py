"""Groups compared as the protocol declares: in one condition, or in what a condition changes."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from analysis.attainable import smallest_p_between
from analysis.estimands import timed_laps, worst_differences
from analysis.frames import StudyFrames
from analysis.groups import group_by_participant
from analysis.outcomes import UNITS, outcome_of
from analysis.place import practice_of, with_place, without_place
from analysis.stats.rank_sum import rank_sum
from analysis.stats.result import TestResult
from protocols.declared import Comparison


@dataclass(frozen=True, slots=True, kw_only=True)
class GroupComparison:
    """One outcome of two groups of people, declared in advance.

    Attributes
    ----------
    name, outcome, unit, condition, reference
        What is compared; without a reference the condition itself, else what it changes.
    groups
        The first one is compared with the second one.
    kind, family
        As the protocol declares them; no family where it is exploratory.
    n
        People of each group with a value.
    missing
        Analysed people of both groups without one.
    medians
        Of each group: s for lap times, percent for changes of lap times, else the outcome's unit.
    test
        Rank-sum test of people's values, exact up to 100 people; of lap times in log s.
    p_holm
        After Holm's correction within the family; NaN when exploratory.
    smallest_p
        The smallest p that so many people could have given, after the same correction.
    """

    name: str
    outcome: str
    unit: str
    condition: str
    reference: str | None
    groups: tuple[str, str]
    kind: str
    family: str | None
    n: tuple[int, int]
    missing: int
    medians: tuple[float, float]
    test: TestResult
    p_holm: float = math.nan
    smallest_p: float = math.nan

    @property
    def p_declared(self) -> float:
        """The uncorrected p."""
        return self.test.p


def compare_groups(frames: StudyFrames, comparison: Comparison) -> GroupComparison:
    """Compare two groups as declared; the p-value is not corrected yet.

    Each person counts once. Lap times are compared as logs, so that a difference is a ratio; what a
    condition changes is a person's log ratio of condition and reference, less each place's mean
    where place is balanced. An unfinished lap counts as the comparison says.

    Parameters
    ----------
    frames
        The study.
    comparison
        One with groups.

    Raises
    ------
    ValueError
        When it has none.
    """
    if comparison.groups is None:
        raise ValueError(f"'{comparison.name}' compares no groups")
    values = people_values(frames, comparison)
    of = group_by_participant(frames).reindex(values.index)
    first, second = (values[of == name] for name in comparison.groups)
    n = int(first.notna().sum()), int(second.notna().sum())
    timed = comparison.outcome == "lap_time_s"
    tested = replace(rank_sum(first, second), name=comparison.name)
    if timed:
        tested = replace(tested, quantity="log of the ratio of lap times, group / reference")
    return GroupComparison(
        name=comparison.name,
        outcome=comparison.outcome,
        unit=UNITS.get(comparison.outcome, ""),
        condition=comparison.condition,
        reference=comparison.reference,
        groups=comparison.groups,
        kind=comparison.kind,
        family=comparison.family if comparison.kind == "confirmatory" else None,
        n=n,
        missing=len(first) + len(second) - sum(n),
        medians=(_median(first, comparison), _median(second, comparison)),
        test=tested,
        smallest_p=smallest_p_between(*n),
    )


def people_values(frames: StudyFrames, comparison: Comparison) -> pd.Series:
    """Return the value of every analysed person that a comparison of groups is about.

    Returns
    -------
    Series
        By participant; NaN where it is missing. Of lap times log s, or log ratios; else in the
        outcome's unit. Under ``worst rank`` only the ranks of unfinished laps mean something.
    """
    if comparison.outcome == "lap_time_s":
        return _log_values(frames, comparison)
    wide = outcome_of(frames, comparison)
    value = wide[comparison.condition]
    return value if comparison.reference is None else value - wide[comparison.reference]


def _log_values(frames: StudyFrames, comparison: Comparison) -> pd.Series:
    laps = with_place(timed_laps(frames, comparison.unfinished))
    timed = laps.dropna(subset=["lap_time_s"])
    logs = pd.Series(np.log(timed["lap_time_s"].to_numpy(dtype=np.float64)), index=timed.index)
    pair = comparison.conditions
    if len(pair) > 1 and practice_of(timed, *comparison.pair) == "balanced":
        logs = without_place(timed, logs)
    wide = timed.assign(value=logs).pivot_table(
        index="participant", columns="condition", values="value"
    )
    people = sorted(frames.participants["participant"])
    wide = wide.reindex(index=people, columns=list(pair)).astype("float64")
    if len(pair) > 1:
        return worst_differences(wide[pair[0]] - wide[pair[1]], laps, *pair)
    return _worst_last(wide[pair[0]], laps, pair[0])


def _worst_last(values: pd.Series, laps: pd.DataFrame, condition: str) -> pd.Series:
    """Return values in which an unfinished lap is slower than every finished one."""
    mine = laps[laps["condition"] == condition]
    worst = mine.groupby("participant")["worst"].max().reindex(values.index).eq(other=True)
    beyond = float(values.max()) + 1 if values.notna().any() else 0.0
    return values.where(~worst, beyond)


def _median(values: pd.Series, comparison: Comparison) -> float:
    median = float(values.median()) if values.notna().any() else math.nan
    if comparison.outcome != "lap_time_s":
        return median
    return math.exp(median) if comparison.reference is None else 100 * math.expm1(median)
