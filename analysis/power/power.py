"""Power against the number of participants, for every analysis that a protocol declares."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from analysis.attainable import ALPHA
from analysis.power.adjusted import adjusted, log_differences, people_values
from analysis.power.draws import draw_studies, pool_error
from analysis.power.effects import Shift, Source, shift_of
from analysis.power.pool import Array, Pool, wanted_orders
from analysis.power.vectorised import pseudomedians, rank_sum_rows, signed_rank_p, tost_p
from analysis.stats.holm import holm
from protocols.declared import Comparison
from protocols.study import StudyProtocol

STUDIES = 1000
"""Studies drawn for each size."""


@dataclass(frozen=True, slots=True)
class PowerRow:
    """Power of one analysis at one size.

    Attributes
    ----------
    analysis
        Its name.
    n
        Participants, drop-outs included.
    power
        Share of studies in which it is significant at 5%, after Holm where it is confirmatory.
    mc_error, pool_error
        Standard errors of that share: of drawing a limited number of studies, and of the pool being
        a sample of people. For a stated effect the pool gives the shape alone.
    source
        Whether the effect was stated, or taken from the cohort.
    effect
        The effect that is there: log ratio for lap times, else in the outcome's unit.
    wrong_sign
        Share of significant results on the other side of 0; NaN where there are none.
    exaggeration
        Mean size of significant estimates over the effect; NaN without an effect.
    width
        Mean width of the 95% interval, on the scale of the effect.
    """

    analysis: str
    n: int
    power: float
    mc_error: float
    pool_error: float
    source: Source
    effect: float
    wrong_sign: float
    exaggeration: float
    width: float


def power_rows(
    protocol: StudyProtocol,
    pool: Pool,
    sizes: Sequence[int],
    effects: Mapping[str, float],
    *,
    seed: int,
    studies: int = STUDIES,
) -> tuple[PowerRow, ...]:
    """Return the power of every declared analysis at every size.

    Parameters
    ----------
    protocol
        Declares the analyses, and says who drives which order and how many drop out.
    pool
        The people; at most a quarter of them are drawn at once.
    sizes
        Numbers of participants.
    effects
        Stated effects by analysis: log ratios for lap times, else in the outcome's unit. Of an
        analysis that is not in it the cohort's own effect is taken.
    seed
        Of the draws, and of the orders.
    studies
        How many are drawn for each size.
    """
    rows: list[PowerRow] = []
    shifts = {a.name: shift_of(pool, a, effects.get(a.name)) for a in protocol.analyses}
    for n in sizes:
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(n,)))
        drawn = draw_studies(pool, wanted_orders(protocol, n, seed), studies, rng)
        stays = rng.random(drawn.shape) >= protocol.cohort.expected_dropout
        logs = np.where(stays[..., None], adjusted(pool, drawn), np.nan)
        rows += _at_size(protocol, _Drawn(pool, drawn, stays, logs), shifts)
    return tuple(rows)


@dataclass(frozen=True, slots=True)
class _Drawn:
    """Drawn studies: rows of the pool, who stays, and log times less each place's effect."""

    pool: Pool
    people: NDArray[np.intp]
    stays: NDArray[np.bool_]
    logs: Array


@dataclass(frozen=True, slots=True)
class _Tested:
    """p, estimate and width of the interval of each drawn study."""

    p: Array
    estimates: Array
    widths: Array


def _at_size(protocol: StudyProtocol, drawn: _Drawn, shifts: Mapping[str, Shift]) -> list[PowerRow]:
    tested = {
        a.name: (_within if a.groups is None else _between)(drawn, a, shifts[a.name])
        for a in protocol.analyses
    }
    corrected = _after_holm(protocol.analyses, {name: t.p for name, t in tested.items()})
    return [
        _row(
            a,
            drawn.people,
            tested[a.name],
            corrected[a.name] < ALPHA,
            size=drawn.pool.size,
            shift=shifts[a.name],
        )
        for a in protocol.analyses
    ]


def _within(drawn: _Drawn, analysis: Comparison, shift: Shift) -> _Tested:
    pool = drawn.pool
    unit = np.where(drawn.stays, pool.differences[analysis.name][drawn.people], np.nan) + shift.unit
    d = unit
    if analysis.outcome == "lap_time_s":
        d = log_differences(pool, drawn.people, drawn.logs, analysis) + shift.log
    margin = analysis.equivalence_margin
    p = signed_rank_p(d) if margin is None else tost_p(unit, margin)
    return _Tested(p, *pseudomedians(d))


def _between(drawn: _Drawn, analysis: Comparison, shift: Shift) -> _Tested:
    values = people_values(drawn.pool, drawn.logs, analysis, drawn.people)
    values = np.where(drawn.stays, values, np.nan)
    of = drawn.pool.groups[drawn.people[0]]  # a column holds people of one group
    first, second = (values[:, of == name] for name in analysis.groups or ())
    return _Tested(*rank_sum_rows(first + shift.log, second))


def _after_holm(
    analyses: Sequence[Comparison], p: Mapping[str, NDArray[np.float64]]
) -> dict[str, NDArray[np.float64]]:
    found = dict(p)
    for family in {a.family for a in analyses if a.kind == "confirmatory"}:
        names = [a.name for a in analyses if a.kind == "confirmatory" and a.family == family]
        columns = np.column_stack([p[name] for name in names])
        corrected = np.array([holm(list(row)) for row in columns])
        found |= {name: corrected[:, i] for i, name in enumerate(names)}
    return found


def _row(
    analysis: Comparison,
    drawn: NDArray[np.intp],
    tested: _Tested,
    rejected: NDArray[np.bool_],
    *,
    size: int,
    shift: Shift,
) -> PowerRow:
    power = float(rejected.mean())
    significant = tested.estimates[rejected]
    equal = analysis.equivalence_margin is not None
    known = len(significant) > 0 and shift.effect != 0 and not equal
    return PowerRow(
        analysis=analysis.name,
        n=drawn.shape[1],
        power=power,
        mc_error=math.sqrt(power * (1 - power) / len(drawn)),
        pool_error=pool_error(drawn, rejected, size),
        source=shift.source,
        effect=shift.effect,
        wrong_sign=float((significant * shift.effect < 0).mean()) if known else math.nan,
        exaggeration=float(np.abs(significant).mean() / abs(shift.effect)) if known else math.nan,
        width=float(np.nanmean(tested.widths)) if np.isfinite(tested.widths).any() else math.nan,
    )


def smallest_n(rows: Sequence[PowerRow], analysis: str, target: float) -> int | None:
    """Return the smallest size from which on the power stays at the target; None if none does."""
    mine = sorted((r for r in rows if r.analysis == analysis), key=lambda r: r.n)
    found = None
    for row in reversed(mine):
        if row.power < target:
            break
        found = row.n
    return found
