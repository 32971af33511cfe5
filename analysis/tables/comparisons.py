"""Paired comparisons and speedups, one row each."""

import math
from collections.abc import Iterable

import numpy as np
import pandas as pd

from analysis.comparisons import PairedComparison
from analysis.stats.result import TestResult


def comparison_table(comparisons: Iterable[PairedComparison]) -> pd.DataFrame:
    """Return one row per comparison: n, Wilcoxon, Holm, effect sizes, mean difference, KS."""
    return pd.DataFrame([_row(c) for c in comparisons])


def speedup_table(comparisons: Iterable[PairedComparison]) -> pd.DataFrame:
    """Return one row per comparison of times: seconds gained and both ratios, with intervals.

    Ratios are reference over condition; a percentage above 100 is a speedup, as the paper's 137%.
    """
    return pd.DataFrame(
        [
            {
                "condition": c.condition,
                "reference": c.reference,
                "n": c.complete,
                "mean_condition_s": c.mean_condition,
                "mean_reference_s": c.mean_reference,
                **_estimate("gain_s", c.difference, -1.0),
                **_estimate("ratio_of_means_percent", c.ratio_of_means, 100.0),
                **_estimate("mean_of_ratios_percent", c.mean_of_ratios, 100.0),
            }
            for c in comparisons
            if c.ratio_of_means is not None
        ]
    )


def _row(c: PairedComparison) -> dict[str, object]:
    return {
        "name": c.name,
        "kind": c.kind,
        "family": c.family or "",
        "outcome": c.outcome,
        "unit": c.unit,
        "condition": c.condition,
        "reference": c.reference,
        "n_pairs": c.complete,
        "n_missing": c.incomplete,
        "mean_condition": c.mean_condition,
        "mean_reference": c.mean_reference,
        "practice": c.practice or "",
        **_change(c),
        "p": c.lead.p,
        "p_holm": c.p_holm,
        "smallest_p": c.smallest_p,
        **_estimate("mean_difference", c.difference),
        **_estimate("pseudomedian", c.signed_rank),
        "wilcoxon_statistic": c.signed_rank.statistic,
        "wilcoxon_p": c.signed_rank.p,
        "p_items": c.p_items,
        **_estimate("rank_biserial", c.rank_biserial),
        **_estimate("d_z", c.dz),
        **_odds_ratio(c.odds),
        "ks_d": math.nan if c.ks is None else c.ks.statistic,
        "ks_p": math.nan if c.ks is None else c.ks.p,
        "margin": math.nan if c.margin is None else c.margin,
        **_estimate("tost", c.equivalence),
        "tost_p": math.nan if c.equivalence is None else c.equivalence.p,
        "notes": "; ".join(_remarks(c)),
    }


def _estimate(name: str, result: TestResult | None, factor: float = 1.0) -> dict[str, float]:
    """Return estimate and interval; a negative factor turns the interval round."""
    if result is None:
        return {name: math.nan, f"{name}_low": math.nan, f"{name}_high": math.nan}
    low, high = sorted((factor * result.low, factor * result.high))
    return {name: factor * result.estimate, f"{name}_low": low, f"{name}_high": high}


def _change(c: PairedComparison) -> dict[str, float]:
    """Return the change of lap time in percent, where lap times are compared."""
    names = ("change_percent", "change_percent_low", "change_percent_high")
    if c.lap_time is None:
        return dict.fromkeys(names, math.nan)
    ends = (c.lead.estimate, c.lead.low, c.lead.high)
    return {name: 100 * math.expm1(end) for name, end in zip(names, ends, strict=True)}


def sensitivity_table(comparisons: Iterable[PairedComparison]) -> pd.DataFrame:
    """Return one row per comparison and way to count unfinished laps, where there are any.

    Columns: name, condition, reference, unfinished, declared (whether the protocol asks for this
    way), n, change_percent with its interval (none for worst ranks, which are no lap times), and p.
    """
    rows: list[dict[str, object]] = []
    for c in comparisons:
        if c.lap_time is None or not c.sensitivity:
            continue
        for tested in (c.lap_time, *c.sensitivity):
            sized = tested.unfinished != "worst rank"
            ends = (tested.test.estimate, tested.test.low, tested.test.high)
            changes = [100 * math.expm1(end) if sized else math.nan for end in ends]
            rows.append(
                {
                    "name": c.name,
                    "condition": c.condition,
                    "reference": c.reference,
                    "unfinished": tested.unfinished,
                    "declared": tested is c.lap_time,
                    "n": tested.test.n,
                    "change_percent": changes[0],
                    "change_percent_low": changes[1],
                    "change_percent_high": changes[2],
                    "p": tested.test.p,
                }
            )
    return pd.DataFrame(rows)


def _odds_ratio(result: TestResult | None) -> dict[str, float]:
    """Return the odds ratio; an end that separates the two conditions is infinite or zero."""
    found = _estimate("odds_ratio", result)
    return {name: float(np.exp(value)) for name, value in found.items()}


def _remarks(c: PairedComparison) -> list[str]:
    """Return the notes of a row, each once with the quantities that it is about."""
    parts = [c.signed_rank, c.rank_biserial, c.dz, c.difference, c.equivalence, c.odds]
    results = [r for r in parts if r is not None]
    said = [(r.why_not, r.name) for r in results if r.why_not is not None]
    said += [(note, r.name) for r in results if r is not c.signed_rank for note in r.notes]
    of: dict[str, list[str]] = {}
    for text, name in said:
        of.setdefault(text, []).append(name)
    return [*(f"{', '.join(names)}: {text}" for text, names in of.items()), *c.signed_rank.notes]
