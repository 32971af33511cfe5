"""Lap times in a mixed model: log time ~ condition + place + (1 | participant)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import stats

from analysis.stats.permutation import sign_flip
from analysis.stats.random_intercept import InterceptFit, fit_random_intercept
from analysis.stats.result import TestResult

INFLATED = 5.0
"""Variance inflation from which on two effects count as not told apart, the usual limit."""


@dataclass(frozen=True, slots=True)
class Design:
    """Fixed effects of the model.

    Attributes
    ----------
    matrix
        Shape (laps, effects): intercept, one column per contrast, and one per place in the session
        but the first, where places are identified.
    contrasts
        The conditions that are set against the reference, in order.
    with_place
        Whether the places are in the matrix: only where they can be told from the conditions.
    """

    matrix: NDArray[np.float64]
    contrasts: tuple[str, ...]
    with_place: bool


def lap_time_design(laps: pd.DataFrame, reference: str) -> Design:
    """Return the fixed effects of a design, with the places only if they can be told apart.

    In a fixed order the place of a lap follows from its condition: the matrix would be singular,
    and practice and condition are confounded. Practice is not linear (it follows a power law), so
    each place has an effect of its own; a straight line through them misleads. Where a few people
    have driven another order the matrix need not be singular, but practice then hangs on them:
    places are left out where they would inflate a contrast's variance ``INFLATED`` times.

    Parameters
    ----------
    laps
        One row per finished lap: participant, condition, and place (its position among a
        participant's analysed laps).
    reference
        The condition the others are set against.

    Examples
    --------
    >>> laps = pd.DataFrame(
    ...     {"participant": ["P1", "P1", "P2", "P2"], "condition": ["a", "b", "a", "b"]}
    ... )
    >>> lap_time_design(laps.assign(place=[0, 1, 0, 1]), "a").with_place  # b is always second
    False
    >>> design = lap_time_design(laps.assign(place=[0, 1, 1, 0]), "a")
    >>> design.contrasts, design.with_place, design.matrix.shape
    (('b',), True, (4, 3))
    """
    conditions = [c for c in dict.fromkeys(laps["condition"]) if c != reference]
    columns = [np.ones(len(laps)), *(indicator(laps["condition"], c) for c in conditions)]
    matrix = np.column_stack(columns)
    places = sorted(laps["place"].unique())[1:]
    wider = np.column_stack([matrix, *(indicator(laps["place"], p) for p in places)])
    identified = inflation(matrix, wider, laps["participant"]) < INFLATED
    return Design(wider if identified else matrix, tuple(conditions), identified)


def indicator(column: pd.Series, value: object) -> NDArray[np.float64]:
    """Return 1 where a column has a value, 0 elsewhere.

    Parameters
    ----------
    column
        One value per lap.
    value
        The value to look for.

    Examples
    --------
    >>> indicator(pd.Series(["limited", "baseline"]), "limited")
    array([1., 0.])
    """
    return np.asarray(column.to_numpy() == value, dtype=np.float64)


def inflation(
    matrix: NDArray[np.float64], wider: NDArray[np.float64], participants: pd.Series
) -> float:
    """Return how many times more columns inflate a contrast's variance, for the worst one.

    Within participants, where the contrasts are estimated; infinite without any information.

    Parameters
    ----------
    matrix
        Shape (laps, columns): the design, its first column the intercept.
    wider
        Shape (laps, more columns): the same columns, and more.
    participants
        Who drove each lap.

    Examples
    --------
    >>> contrast = np.array([[1.0, 0.0], [1.0, 1.0], [1.0, 0.0], [1.0, 1.0]])
    >>> people = pd.Series(["P1", "P1", "P2", "P2"])
    >>> balanced = np.column_stack([contrast, [0.0, 1.0, 1.0, 0.0]])  # the lap was second
    >>> inflation(contrast, balanced, people)
    1.0
    >>> fixed = np.column_stack([contrast, [0.0, 1.0, 0.0, 1.0]])
    >>> inflation(contrast, fixed, people)
    inf
    """
    if wider.shape == matrix.shape or matrix.shape[1] < 2:
        return math.inf
    without, with_it = (within_people(m[:, 1:], participants) for m in (matrix, wider))
    if np.linalg.matrix_rank(with_it) < with_it.shape[1]:
        return math.inf
    before, after = (np.diag(np.linalg.inv(m.T @ m)) for m in (without, with_it))
    return float((after[: len(before)] / before).max())


def within_people(matrix: NDArray[np.float64], participants: pd.Series) -> NDArray[np.float64]:
    """Return what is left of each column within participants.

    Parameters
    ----------
    matrix
        Shape (laps, columns).
    participants
        Who drove each lap.

    Examples
    --------
    >>> within_people(np.array([[1.0], [3.0], [5.0]]), pd.Series(["P1", "P1", "P2"]))
    array([[-1.],
           [ 1.],
           [ 0.]])
    """
    codes = pd.factorize(participants)[0]
    sums = np.zeros((codes.max() + 1, matrix.shape[1]))
    np.add.at(sums, codes, matrix)
    return matrix - (sums / np.bincount(codes)[:, None])[codes]


def lap_time_model(
    laps: pd.DataFrame,
    reference: str,
    rng: np.random.Generator,
    level: float = 0.95,
    wanted: Sequence[str] | None = None,
) -> tuple[TestResult, ...]:
    """Set every condition's log lap time against a reference condition's.

    Parameters
    ----------
    laps
        One row per lap: participant, condition, place (position among the participant's analysed
        laps), lap_time_s. Laps without a time are left out.
    reference
        The condition the others are set against.
    rng
        For the permutation test, where the model has to fall back on it.
    level
        Confidence level of the intervals.
    wanted
        The conditions whose contrasts are returned; None for all.

    Returns
    -------
    tuple of TestResult
        One per condition: the estimate is the log of the ratio of geometric mean lap times,
        condition over reference. Standard errors and degrees of freedom are Kenward and Roger's.
        Where the model cannot be fitted, a permutation test over participants takes its place, and
        the method says so.

    References
    ----------
    Laird & Ware (1982), Biometrics 38(4), 963-974; Kenward & Roger (1997), Biometrics 53(3),
    983-997.

    Examples
    --------
    >>> laps = pd.DataFrame(
    ...     {
    ...         "participant": [who for who in ("P1", "P2", "P3", "P4") for _ in "ab"],
    ...         "condition": ["limited", "helped"] * 4,
    ...         "place": [0, 1, 1, 0, 0, 1, 1, 0],
    ...         "lap_time_s": [80.0, 60.0, 90.0, 65.0, 70.0, 55.0, 84.0, 60.0],
    ...     }
    ... )
    >>> (found,) = lap_time_model(laps, "limited", np.random.default_rng(0))
    >>> found.name, f"{np.exp(found.estimate):.2f} times the time", found.n
    ('helped against limited', '0.74 times the time', 4)
    """
    timed = laps.dropna(subset=["lap_time_s"])
    timed = timed.assign(log_time=np.log(timed["lap_time_s"].to_numpy(dtype=np.float64)))
    if reference not in set(timed["condition"]) or timed["condition"].nunique() < 2:
        return ()
    design = lap_time_design(timed, reference)
    chosen = [c for c in design.contrasts if wanted is None or c in wanted]
    n = int(timed["participant"].nunique())
    used = _laps_used(laps, timed, n)
    df = len(timed) - n - (design.matrix.shape[1] - 1)
    if n < 2 or df < 1:
        why = f"too few: {used}"
        return tuple(_named(TestResult.missing("", n, why), c, reference) for c in chosen)
    fit = fit_random_intercept(timed["log_time"], design.matrix, timed["participant"])
    if fit is None:
        remarks = (used, "the mixed model cannot be fitted: there is no residual spread")
        return tuple(_fallback(timed, c, reference, rng, remarks) for c in chosen)
    return tuple(
        _contrast(
            fit,
            design,
            design.contrasts.index(c),
            reference,
            n=n,
            level=level,
            remarks=(used, *_resting_on(timed, c, reference, n)),
        )
        for c in chosen
    )


def _laps_used(laps: pd.DataFrame, timed: pd.DataFrame, n: int) -> str:
    left = len(laps) - len(timed)
    without = f"; {left} without a time left out" if left else ""
    people = "1 participant" if n == 1 else f"{n} participants"
    return f"{len(timed)} laps of {people}{without}"


def _resting_on(timed: pd.DataFrame, condition: str, reference: str, n: int) -> tuple[str, ...]:
    """Tell how many drove both laps of a contrast, where not everybody did."""
    drove = (set(timed.loc[timed["condition"] == c, "participant"]) for c in (condition, reference))
    both = len(set.intersection(*drove))
    if both == n:
        return ()
    return (f"{condition} against {reference}: {both} of {n} participants have both",)


def _contrast(
    fit: InterceptFit,
    design: Design,
    i: int,
    reference: str,
    *,
    n: int,
    level: float,
    remarks: tuple[str, ...],
) -> TestResult:
    weights = np.zeros(design.matrix.shape[1])
    weights[i + 1] = 1.0
    model = "condition + place" if design.with_place else "condition"
    place = "" if design.with_place else "; the lap's place is not identified"
    found = model_result(fit, weights, n=n, level=level, formula=model)
    found = replace(found, method=found.method + place, notes=(*found.notes, *remarks))
    return _named(found, design.contrasts[i], reference)


def model_result(
    fit: InterceptFit, weights: NDArray[np.float64], *, n: int, level: float, formula: str
) -> TestResult:
    """Return a contrast of log times in a fitted model, tested after Kenward and Roger.

    Parameters
    ----------
    fit, weights
        The model, and the contrast's weight of each of its effects.
    n
        How many people it is of.
    level
        Confidence level.
    formula
        The fixed effects in words, for the method.

    Examples
    --------
    >>> times = np.log([80.0, 60.0, 90.0, 65.0, 70.0, 55.0])
    >>> helped = np.column_stack([np.ones(6), [0.0, 1.0] * 3])
    >>> fit = fit_random_intercept(times, helped, ["P1", "P1", "P2", "P2", "P3", "P3"])
    >>> found = model_result(fit, np.array([0.0, 1.0]), n=3, level=0.95, formula="condition")
    >>> f"{np.exp(found.estimate):.2f}", found.statistic_name, found.p < 0.05
    ('0.75', 't', True)
    """
    estimate, error, df = fit.contrast(weights)
    half = float(stats.t.ppf((1 + level) / 2, df)) * error
    return TestResult(
        name="",
        estimate=estimate,
        low=estimate - half,
        high=estimate + half,
        level=level,
        statistic=estimate / error,
        statistic_name="t",
        p=float(2 * stats.t.sf(abs(estimate / error), df)),
        n=n,
        method=f"linear mixed model, log time ~ {formula} + (1 | participant), REML; "
        f"t on {df:.3g} Kenward-Roger df",
        checks=(
            f"spread between participants {fit.between:.3g}, residual {fit.within:.3g} (sd, log s)",
        ),
    )


def _fallback(
    laps: pd.DataFrame,
    condition: str,
    reference: str,
    rng: np.random.Generator,
    remarks: tuple[str, ...],
) -> TestResult:
    wide = laps.pivot_table(index="participant", columns="condition", values="log_time")
    found = sign_flip(wide[condition] - wide[reference], rng)
    return _named(replace(found, notes=(*found.notes, *remarks)), condition, reference)


def _named(result: TestResult, condition: str, reference: str) -> TestResult:
    quantity = "log of the ratio of lap times, condition / reference"
    return replace(result, name=f"{condition} against {reference}", quantity=quantity)
