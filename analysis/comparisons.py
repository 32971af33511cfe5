"""Two conditions compared within participants: every test and effect size, in one record."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames
from analysis.outcomes import UNITS, answers_by_participant, by_participant, values
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
from protocols.declared import Comparison

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
        Wilcoxon's test and its effect size.
    dz, difference
        Effect size and test of the mean; None for answers, which have no mean.
    ks
        Kolmogorov-Smirnov over all laps, descriptive; None for answers.
    ratio_of_means, mean_of_ratios
        Speedups, reference over condition; None for anything but times.
    margin, equivalence
        The declared margin in the outcome's unit, and TOST within it; None without one.
    odds
        Ordinal regression of an answer, a log odds ratio; None for anything else.
    p_holm
        After Holm's correction within the family: the p of TOST where a margin is declared, which
        makes equivalence what is to be confirmed, else the signed-rank p; NaN when not
        confirmatory.
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
    dz: TestResult | None = None
    difference: TestResult | None = None
    ks: TestResult | None = None
    ratio_of_means: TestResult | None = None
    mean_of_ratios: TestResult | None = None
    margin: float | None = None
    equivalence: TestResult | None = None
    odds: TestResult | None = None
    p_holm: float = math.nan

    @property
    def p_declared(self) -> float:
        """The uncorrected p of the test that the declaration asks for."""
        return self.signed_rank.p if self.equivalence is None else self.equivalence.p


def declared_comparisons(frames: StudyFrames) -> tuple[PairedComparison, ...]:
    """Return what the protocol declares, in its order; confirmatory families Holm-corrected."""
    results = [_declared(frames, comparison) for comparison in frames.study.protocol.analyses]
    for family in {r.family for r in results if r.kind == "confirmatory"}:
        members = [
            i for i, r in enumerate(results) if r.kind == "confirmatory" and r.family == family
        ]
        adjusted = holm([results[i].p_declared for i in members])
        for i, p in zip(members, adjusted, strict=True):
            results[i] = replace(results[i], p_holm=p)
    return tuple(results)


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
    """Return every item's answers in every two conditions after which it was asked."""
    found = []
    for item in items:
        wide = answers_by_participant(frames, instrument, item)
        asked = [c for c in frames.conditions if wide[c].notna().any()]
        found += [
            _with_odds(
                frames, wide, _compare(frames, wide, f"{instrument}.{item}", condition, reference)
            )
            for reference, condition in itertools.combinations(asked, 2)
        ]
    return tuple(found)


def _declared(frames: StudyFrames, comparison: Comparison) -> PairedComparison:
    condition, reference = comparison.condition, comparison.reference
    if comparison.item is None:
        wide = by_participant(frames, comparison.outcome)
    else:
        wide = answers_by_participant(frames, *comparison.item)
    result = _compare(frames, wide, comparison.outcome, condition, reference)
    if comparison.item is None:
        result = _with_laps(frames, result)
    else:
        result = _with_odds(frames, wide, result)
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
    )


def _compare(
    frames: StudyFrames, wide: pd.DataFrame, outcome: str, condition: str, reference: str
) -> PairedComparison:
    differences = (wide[condition] - wide[reference]).to_numpy()
    both = np.isfinite(differences)
    rng = generator(frames.study, f"{outcome}: {condition} - {reference}")
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
        signed_rank=signed_rank(differences),
        rank_biserial=rank_biserial(differences, rng),
    )


def _with_laps(frames: StudyFrames, result: PairedComparison) -> PairedComparison:
    """Add what only numbers have: means, distribution functions, and speedups of times."""
    outcome, condition, reference = result.outcome, result.condition, result.reference
    wide = by_participant(frames, outcome)
    differences = wide[condition] - wide[reference]
    rng = generator(frames.study, f"means of {outcome}: {condition} - {reference}")
    ks = two_sample_ks(
        values(frames, outcome, condition), values(frames, outcome, reference), same_people=True
    )
    result = replace(
        result, ks=ks, dz=cohen_dz(differences, rng), difference=mean_difference(differences)
    )
    if outcome != "lap_time_s":
        return result
    return replace(
        result,
        ratio_of_means=ratio_of_means(wide[reference], wide[condition]),
        mean_of_ratios=mean_of_ratios(wide[reference], wide[condition]),
    )


def _with_odds(
    frames: StudyFrames, wide: pd.DataFrame, result: PairedComparison
) -> PairedComparison:
    """Add what only answers have: an ordinal regression."""
    condition, reference = result.condition, result.reference
    rng = generator(frames.study, f"odds of {result.outcome}: {condition} - {reference}")
    return replace(result, odds=proportional_odds(wide[condition], wide[reference], rng))


def _mean(column: pd.Series) -> float:
    return float(column.mean()) if len(column) else math.nan
