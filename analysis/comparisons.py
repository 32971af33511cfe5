"""Two conditions compared within participants: every test and effect size, in one record."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import pandas as pd

from analysis.attainable import smallest_p
from analysis.estimands import ESTIMANDS
from analysis.frames import StudyFrames
from analysis.group_comparisons import GroupComparison, compare_groups
from analysis.lap_time_test import LapTimeTest, lap_time_test
from analysis.outcomes import UNITS, by_participant, outcome_of, values, wide_answers
from analysis.place import Practice
from analysis.randomness import generator
from analysis.stats.effect_size import cohen_dz, rank_biserial
from analysis.stats.holm import holm
from analysis.stats.kolmogorov_smirnov import two_sample_ks
from analysis.stats.mean_difference import mean_difference
from analysis.stats.proportional_odds import proportional_odds
from analysis.stats.ratio import mean_of_ratios, ratio_of_means
from analysis.stats.result import TestResult
from analysis.stats.signed_rank import signed_rank
from analysis.stats.tost import paired_tost
from protocols.declared import Comparison, Unfinished

Kind = Literal["confirmatory", "exploratory"]


@dataclass(frozen=True, slots=True, kw_only=True)
class PairedComparison:
    """One outcome in two conditions of the same participants.

    Attributes
    ----------
    name, outcome, unit, condition, reference
        What is compared; differences are condition minus reference.
    kind, family, declared
        As the protocol declares it; exploratory without a family when it does not.
    complete, incomplete
        Analysed participants with both values, and with one or none.
    mean_condition, mean_reference
        Means over the complete pairs.
    signed_rank, rank_biserial
        Wilcoxon's test of the differences in the outcome's unit, and its effect size.
    practice
        What is done about practice in a comparison of lap times; None for other outcomes.
    lap_time
        The test of log ratios of lap times; None for other outcomes.
    sensitivity
        The same with unfinished laps counted in the other ways; empty where every lap was finished.
    dz, difference
        Effect size and test of the mean; None for answers, which have no mean.
    ks
        Kolmogorov-Smirnov over all laps, descriptive; None for answers.
    ratio_of_means, mean_of_ratios
        Speedups, reference over condition; None for anything but times.
    margin, equivalence
        The declared margin in the outcome's unit, and TOST within it; None without one.
    odds
        Ordinal regression of an item, a marginal log odds ratio; None for anything else.
    p_holm
        After Holm's correction within the family, of ``p_declared``; NaN when not confirmatory.
    p_items
        After Holm's correction over all comparisons of the same instrument's items; NaN for
        anything but an undeclared comparison of an item.
    smallest_p
        The smallest p that the test could have given with these pairs, after the same correction;
        NaN for a test without such a bound.
    """

    name: str
    outcome: str
    unit: str
    condition: str
    reference: str
    kind: Kind = "exploratory"
    family: str | None = None
    declared: bool = False
    complete: int
    incomplete: int
    mean_condition: float
    mean_reference: float
    signed_rank: TestResult
    rank_biserial: TestResult
    practice: Practice | None = None
    lap_time: LapTimeTest | None = None
    sensitivity: tuple[LapTimeTest, ...] = ()
    dz: TestResult | None = None
    difference: TestResult | None = None
    ks: TestResult | None = None
    ratio_of_means: TestResult | None = None
    mean_of_ratios: TestResult | None = None
    margin: float | None = None
    equivalence: TestResult | None = None
    odds: TestResult | None = None
    p_holm: float = math.nan
    p_items: float = math.nan
    smallest_p: float = math.nan

    @property
    def lead(self) -> TestResult:
        """The test a verdict rests on: of log ratios for lap times, else the signed-rank test."""
        return self.signed_rank if self.lap_time is None else self.lap_time.test

    @property
    def p_declared(self) -> float:
        """The uncorrected p of the test that the declaration asks for."""
        return self.lead.p if self.equivalence is None else self.equivalence.p


def declared_comparisons(frames: StudyFrames) -> tuple[PairedComparison, ...]:
    """Return what the protocol declares within participants; see ``declared_results``."""
    return declared_results(frames)[0]


def declared_results(
    frames: StudyFrames,
) -> tuple[tuple[PairedComparison, ...], tuple[GroupComparison, ...]]:
    """Return what the protocol declares: within participants, and between groups of them.

    Each in the protocol's order; confirmatory families are Holm-corrected over both.
    """
    results: list[PairedComparison | GroupComparison] = [
        _declared(frames, comparison)
        if comparison.groups is None
        else compare_groups(frames, comparison)
        for comparison in frames.study.protocol.analyses
    ]
    for family in {r.family for r in results if r.kind == "confirmatory"}:
        members = [
            i for i, r in enumerate(results) if r.kind == "confirmatory" and r.family == family
        ]
        adjusted = holm([results[i].p_declared for i in members])
        least = holm([_least(results[i]) for i in members])
        for i, p, low in zip(members, adjusted, least, strict=True):
            bounded = math.isfinite(results[i].smallest_p)
            results[i] = replace(results[i], p_holm=p, smallest_p=low if bounded else math.nan)
    return (
        tuple(r for r in results if isinstance(r, PairedComparison)),
        tuple(r for r in results if isinstance(r, GroupComparison)),
    )


def _least(c: PairedComparison | GroupComparison) -> float:
    """Return the smallest p of a declared test: 0 where it has no bound."""
    return c.smallest_p if math.isfinite(c.smallest_p) else 0.0


def lap_time_comparisons(frames: StudyFrames) -> tuple[PairedComparison, ...]:
    """Return lap times of every two conditions, the later one against the earlier one."""
    wide = by_participant(frames, "lap_time_s")
    return tuple(
        _with_laps(frames, _compare(frames, wide, "lap_time_s", condition, reference))
        for reference, condition in itertools.combinations(frames.conditions, 2)
    )


def item_comparisons(
    frames: StudyFrames, instrument: str, items: Sequence[str]
) -> tuple[PairedComparison, ...]:
    """Return every item's answers in every two conditions after which it was asked.

    Their p-values are corrected together: twenty-four tests of true null hypotheses give at least
    one p of 5% or less in a third of all studies.
    """
    found = []
    for item in items:
        wide = wide_answers(frames, instrument, item)
        asked = [c for c in frames.conditions if wide[c].notna().any()]
        about = _with_odds if _is_point(frames, instrument, item) else _with_means
        found += [
            about(frames, wide, _compare(frames, wide, f"{instrument}.{item}", after, before))
            for before, after in itertools.combinations(asked, 2)
        ]
    corrected = holm([c.signed_rank.p for c in found]) if found else ()
    return tuple(replace(c, p_items=p) for c, p in zip(found, corrected, strict=True))


def _declared(frames: StudyFrames, comparison: Comparison) -> PairedComparison:
    condition, reference = comparison.pair
    wide = outcome_of(frames, comparison)
    result = _compare(frames, wide, comparison.outcome, condition, reference)
    if comparison.item is None:
        result = _with_laps(frames, result, comparison.unfinished)
    elif _is_point(frames, *comparison.item):
        result = _with_odds(frames, wide, result)
    else:
        result = _with_means(frames, wide, result)
    margin = comparison.equivalence_margin
    differences = wide[condition] - wide[reference]
    return replace(
        result,
        name=comparison.name,
        kind=comparison.kind,
        declared=True,
        family=comparison.family if comparison.kind == "confirmatory" else None,
        margin=margin,
        equivalence=None if margin is None else paired_tost(differences, margin),
        smallest_p=result.smallest_p if margin is None else math.nan,
    )


def _is_point(frames: StudyFrames, instrument: str, item: str) -> bool:
    """Tell whether an outcome is one item answered by a point of a scale."""
    asked = frames.study.header.study.instrument(instrument)
    return any(i.id == item and i.answer == "point" for i in asked.items)


def _compare(
    frames: StudyFrames, wide: pd.DataFrame, outcome: str, condition: str, reference: str
) -> PairedComparison:
    differences = (wide[condition] - wide[reference]).to_numpy()
    both = np.isfinite(differences)
    rng = generator(frames.study, f"{outcome}: {condition} - {reference}")
    tested = signed_rank(differences)
    return PairedComparison(
        name=f"{condition} against {reference}",
        outcome=outcome,
        unit=UNITS.get(outcome, ""),
        condition=condition,
        reference=reference,
        complete=int(both.sum()),
        incomplete=int((~both).sum()),
        mean_condition=_mean(wide.loc[both, condition]),
        mean_reference=_mean(wide.loc[both, reference]),
        signed_rank=tested,
        rank_biserial=rank_biserial(differences, rng),
        smallest_p=smallest_p(int((differences[both] != 0).sum())),
    )


def _with_laps(
    frames: StudyFrames, result: PairedComparison, unfinished: Unfinished = "complete pairs"
) -> PairedComparison:
    """Add what only numbers have: means, distribution functions, and speedups of times."""
    outcome, condition, reference = result.outcome, result.condition, result.reference
    wide = by_participant(frames, outcome)
    ks = two_sample_ks(
        values(frames, outcome, condition), values(frames, outcome, reference), same_people=True
    )
    result = replace(_with_means(frames, wide, result), ks=ks)
    if outcome != "lap_time_s":
        return result
    tested = lap_time_test(frames, condition, reference, unfinished)
    laps = frames.laps[frames.laps["condition"].isin([condition, reference])]
    others = [e for e in ESTIMANDS if e != unfinished and not laps["completed"].all()]
    return replace(
        result,
        practice=tested.practice,
        lap_time=tested,
        smallest_p=tested.smallest_p,
        sensitivity=tuple(lap_time_test(frames, condition, reference, e) for e in others),
        ratio_of_means=ratio_of_means(wide[reference], wide[condition]),
        mean_of_ratios=mean_of_ratios(wide[reference], wide[condition]),
    )


def _with_means(
    frames: StudyFrames, wide: pd.DataFrame, result: PairedComparison
) -> PairedComparison:
    """Add mean difference and d_z: for outcomes whose means mean something."""
    outcome, condition, reference = result.outcome, result.condition, result.reference
    differences = wide[condition] - wide[reference]
    rng = generator(frames.study, f"means of {outcome}: {condition} - {reference}")
    return replace(result, dz=cohen_dz(differences, rng), difference=mean_difference(differences))


def _with_odds(
    frames: StudyFrames, wide: pd.DataFrame, result: PairedComparison
) -> PairedComparison:
    """Add what only answers have: an ordinal regression."""
    condition, reference = result.condition, result.reference
    rng = generator(frames.study, f"odds of {result.outcome}: {condition} - {reference}")
    return replace(result, odds=proportional_odds(wide[condition], wide[reference], rng))


def _mean(column: pd.Series) -> float:
    return float(column.mean()) if len(column) else math.nan
