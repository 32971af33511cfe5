"""Lap times in a mixed model: log time ~ condition + (1 | participant)."""

import math
import warnings
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy import stats
from statsmodels.regression.mixed_linear_model import MixedLM
from statsmodels.tools.sm_exceptions import ConvergenceWarning

from analysis.stats.permutation import sign_flip
from analysis.stats.result import TestResult

INFLATED = 5.0
"""Variance inflation from which on two effects count as not told apart, the usual limit."""

_MODEL = "linear mixed model, log time ~ condition + (1 | participant)"


@dataclass(frozen=True, slots=True)
class Design:
    """Fixed effects of the model.

    Attributes
    ----------
    matrix
        Shape (laps, effects): intercept, one column per contrast, and the lap's place in the
        session where it is identified.
    contrasts
        The conditions that are set against the reference, in order.
    with_lap
        Whether the lap's place is in the matrix: only where it can be told from the conditions.
    """

    matrix: NDArray[np.float64]
    contrasts: tuple[str, ...]
    with_lap: bool


def lap_time_design(laps: pd.DataFrame, reference: str) -> Design:
    """Return the fixed effects of a design, with the lap's place only if it can be told apart.

    In a fixed order the place of a lap follows from its condition: the matrix would be singular,
    and practice and condition are confounded. Where one person of many has driven another order,
    or one lap twice, the matrix is not singular, but practice then hangs on this one person:
    the place is left out where it would inflate a contrast's variance ``INFLATED`` times.

    Parameters
    ----------
    laps
        One row per finished lap: participant, condition, lap.
    reference
        The condition the others are set against.
    """
    conditions = [c for c in dict.fromkeys(laps["condition"]) if c != reference]
    columns = [np.ones(len(laps))]
    columns += [(laps["condition"] == c).to_numpy(dtype=np.float64) for c in conditions]
    matrix = np.column_stack(columns)
    lap = laps["lap"].to_numpy(dtype=np.float64)
    wider = np.column_stack([matrix, lap - lap.mean()]) if len(lap) else matrix
    identified = _inflation(matrix, wider, laps["participant"]) < INFLATED
    return Design(wider if identified else matrix, tuple(conditions), identified)


def _inflation(
    matrix: NDArray[np.float64], wider: NDArray[np.float64], participants: pd.Series
) -> float:
    """Return how many times one more column inflates a contrast's variance, for the worst one.

    Within participants, where the contrasts are estimated; infinite without any information.
    """
    if wider.shape == matrix.shape or matrix.shape[1] < 2:
        return math.inf
    without, with_it = (_within(m[:, 1:], participants) for m in (matrix, wider))
    if np.linalg.matrix_rank(with_it) < with_it.shape[1]:
        return math.inf
    before, after = (np.diag(np.linalg.inv(m.T @ m)) for m in (without, with_it))
    return float((after[: len(before)] / before).max())


def _within(matrix: NDArray[np.float64], participants: pd.Series) -> NDArray[np.float64]:
    """Return what is left of each column within participants."""
    frame = pd.DataFrame(matrix)
    means = frame.groupby(participants.to_numpy()).transform("mean")
    return (frame - means).to_numpy()


def lap_time_model(
    laps: pd.DataFrame, reference: str, rng: np.random.Generator, level: float = 0.95
) -> tuple[TestResult, ...]:
    """Set every condition's log lap time against a reference condition's.

    Parameters
    ----------
    laps
        One row per lap: participant, condition, lap (place in the session), lap_time_s. Laps
        without a time are left out.
    reference
        The condition the others are set against.
    rng
        For the permutation test, where the model has to fall back on it.
    level
        Confidence level of the intervals.

    Returns
    -------
    tuple of TestResult
        One per condition: the estimate is the log of the ratio of geometric mean lap times,
        condition over reference. Tests are t on residual degrees of freedom within participants
        (exact for complete data). Where the model does not converge, or is caught with an effect
        of exactly zero, a permutation test over participants takes its place, and the method says
        so.

    References
    ----------
    Laird & Ware (1982), Biometrics 38(4), 963-974.
    """
    timed = laps.dropna(subset=["lap_time_s"])
    timed = timed.assign(log_time=np.log(timed["lap_time_s"].to_numpy(dtype=np.float64)))
    design = lap_time_design(timed, reference)
    if not design.contrasts or reference not in set(timed["condition"]):
        return ()
    n = int(timed["participant"].nunique())
    used = _laps_used(laps, timed, n)
    df = len(timed) - n - (design.matrix.shape[1] - 1)
    if n < 2 or df < 1:
        why = f"too few: {used}"
        return tuple(_named(TestResult.missing("", n, why), c, reference) for c in design.contrasts)
    fit, remarks = _fit(timed, design)
    remarks = (used, *remarks)
    if fit is None:
        return tuple(_fallback(timed, c, reference, rng, remarks) for c in design.contrasts)
    return tuple(
        _contrast(
            fit,
            design,
            i,
            reference,
            df=df,
            n=n,
            level=level,
            remarks=(*remarks, *_resting_on(timed, design.contrasts[i], reference, n)),
        )
        for i in range(len(design.contrasts))
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


def _fit(laps: pd.DataFrame, design: Design) -> tuple[Any, tuple[str, ...]]:
    """Return the fit, or None, and what happened."""
    codes = pd.factorize(laps["participant"])[0]
    try:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            fit = MixedLM(laps["log_time"].to_numpy(), design.matrix, groups=codes).fit(
                reml=True, method="powell"
            )
            errors = np.asarray(fit.bse_fe)
    except (np.linalg.LinAlgError, ValueError) as error:
        return None, (f"the mixed model failed: {error}",)
    # Of warnings only the fit's own: numpy's on the way are its search, and its end is checked.
    of_the_fit = (w for w in caught if issubclass(w.category, ConvergenceWarning))
    texts = dict.fromkeys(str(w.message).partition("\n")[0].rstrip(".") for w in of_the_fit)
    said = tuple(f"statsmodels: {text}" for text in texts)
    effects = np.asarray(fit.fe_params)[1:]
    if not fit.converged:
        return None, ("the mixed model did not converge", *said)
    if (effects == 0).any() or not np.isfinite(errors).all():
        return None, ("the mixed model returned an effect of exactly zero or no error", *said)
    return fit, said


def _contrast(
    fit: Any,
    design: Design,
    i: int,
    reference: str,
    *,
    df: int,
    n: int,
    level: float,
    remarks: tuple[str, ...],
) -> TestResult:
    estimate, error = float(fit.fe_params[i + 1]), float(fit.bse_fe[i + 1])
    half = float(stats.t.ppf((1 + level) / 2, df)) * error
    between, within = math.sqrt(float(fit.cov_re[0, 0])), math.sqrt(float(fit.scale))
    lap = "with the lap's place" if design.with_lap else "the lap's place is not identified"
    found = TestResult(
        name="",
        estimate=estimate,
        low=estimate - half,
        high=estimate + half,
        level=level,
        statistic=estimate / error,
        statistic_name="t",
        p=float(2 * stats.t.sf(abs(estimate / error), df)),
        n=n,
        method=f"{_MODEL}, REML, Powell; t on {df} df; {lap}",
        checks=(
            "converged",
            f"standard deviation between participants {between:.3g}, residual {within:.3g} (log s)",
        ),
        notes=remarks,
    )
    return _named(found, design.contrasts[i], reference)


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
