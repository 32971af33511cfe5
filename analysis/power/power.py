"""Power against the number of participants, for every analysis that a protocol declares."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from analysis.attainable import ALPHA, people_needed
from analysis.power.draws import draw_studies, pool_error
from analysis.power.pool import Array, Pool, wanted_orders
from analysis.power.vectorised import pseudomedians, signed_rank_p, tost_p
from analysis.stats.holm import holm
from protocols.declared import Comparison
from protocols.study import StudyProtocol

Source = Literal["stated", "cohort"]

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
    shifts = {a.name: _shift(pool, a, effects.get(a.name)) for a in protocol.analyses}
    for n in sizes:
        rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(n,)))
        drawn = draw_studies(pool, wanted_orders(protocol, n, seed), studies, rng)
        stays = rng.random(drawn.shape) >= protocol.cohort.expected_dropout
        rows += _at_size(protocol, pool, drawn, stays, shifts)
    return tuple(rows)


@dataclass(frozen=True, slots=True)
class _Shift:
    """What is added to an analysis's differences, and the effect that is then there."""

    log: float
    unit: float
    effect: float
    source: Source


def _shift(pool: Pool, analysis: Comparison, stated: float | None) -> _Shift:
    """Centre the pool's differences on the stated effect; leave them where none is stated."""
    unit = pool.differences[analysis.name]
    if analysis.outcome != "lap_time_s":
        there = float(np.nanmean(unit))
        moved = 0.0 if stated is None else stated - there
        return _Shift(moved, moved, there + moved, "cohort" if stated is None else "stated")
    everyone = np.arange(pool.size)[None]
    logs = _log_differences(pool, adjusted(pool, everyone), analysis)[0]
    there = float(np.nanmean(logs))
    if stated is None:
        return _Shift(0.0, 0.0, there, "cohort")
    seconds = pool.reference_means[analysis.name] * math.expm1(stated) - float(np.nanmean(unit))
    return _Shift(stated - there, seconds, stated, "stated")


def adjusted(pool: Pool, drawn: NDArray[np.intp]) -> Array:
    """Return log times of drawn studies less each place's effect, where a study identifies it.

    Returns
    -------
    NDArray
        Shape (studies, n, conditions).
    """
    logs, places = pool.log_times[drawn], pool.places[drawn]
    levels = np.unique(places[np.isfinite(places)])
    if len(np.unique(pool.orders)) < 2 or len(levels) < 2:
        return logs
    found = logs.copy()
    for study in range(len(logs)):
        found[study] -= _place_effects(logs[study], places[study], levels)
    return found


def _place_effects(logs: Array, places: Array, levels: Array) -> Array:
    """Return each lap's place effect by least squares beside people and conditions; else zeros."""
    there = np.isfinite(logs)
    n, k = logs.shape
    columns = [np.broadcast_to(np.eye(k)[c], (n, k)) for c in range(1, k)]
    place_columns = [(places == level).astype(float) for level in levels[1:]]
    stack = np.stack([*columns, *place_columns], axis=-1) * there[..., None]
    count = np.maximum(there.sum(axis=1), 1)[:, None, None]
    within = (stack - stack.sum(axis=1, keepdims=True) / count) * there[..., None]
    y = np.where(there, logs, 0.0)
    y = (y - y.sum(axis=1, keepdims=True) / count[..., 0]) * there
    x, target = within.reshape(n * k, -1), y.reshape(-1)
    if np.linalg.matrix_rank(x) < x.shape[1]:
        return np.zeros_like(logs)
    effects = np.linalg.lstsq(x, target, rcond=None)[0][k - 1 :]
    taken: Array = sum(
        (e * c for e, c in zip(effects, place_columns, strict=True)), np.zeros_like(logs)
    )
    return taken


def _log_differences(pool: Pool, logs: Array, analysis: Comparison) -> Array:
    condition, reference = pool.columns(analysis)
    return np.asarray(logs[..., condition] - logs[..., reference])


def _at_size(
    protocol: StudyProtocol,
    pool: Pool,
    drawn: NDArray[np.intp],
    stays: NDArray[np.bool_],
    shifts: Mapping[str, _Shift],
) -> list[PowerRow]:
    logs = np.where(stays[..., None], adjusted(pool, drawn), np.nan)
    tested, p = {}, {}
    for analysis in protocol.analyses:
        shift, name = shifts[analysis.name], analysis.name
        unit = np.where(stays, pool.differences[name][drawn], np.nan) + shift.unit
        timed = analysis.outcome == "lap_time_s"
        d = _log_differences(pool, logs, analysis) + shift.log if timed else unit
        margin = analysis.equivalence_margin
        p[name] = signed_rank_p(d) if margin is None else tost_p(unit, margin)
        tested[name] = d
    corrected = _after_holm(protocol.analyses, p)
    return [
        _row(
            a,
            drawn,
            tested[a.name],
            corrected[a.name] < ALPHA,
            size=pool.size,
            shift=shifts[a.name],
        )
        for a in protocol.analyses
    ]


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
    differences: Array,
    rejected: NDArray[np.bool_],
    *,
    size: int,
    shift: _Shift,
) -> PowerRow:
    power = float(rejected.mean())
    estimates, widths = pseudomedians(differences)
    significant = estimates[rejected]
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
        width=float(np.nanmean(widths)) if np.isfinite(widths).any() else math.nan,
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


def impossible_below(protocol: StudyProtocol, analysis: Comparison) -> int | None:
    """Return the number of complete pairs below which an analysis cannot be significant.

    None for a test of equivalence, whose p has no smallest value.
    """
    if analysis.equivalence_margin is not None:
        return None
    if analysis.kind != "confirmatory":
        return people_needed(1)
    family = [
        a
        for a in protocol.analyses
        if a.kind == "confirmatory" and a.family == analysis.family and a.equivalence_margin is None
    ]
    return people_needed(len(family))
