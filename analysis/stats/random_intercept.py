"""A linear mixed model with one random intercept per person: REML and Kenward-Roger.

With one variance ratio to find, the likelihood is a function of one number, so the optimum is found
by a bounded search and cannot fail to converge. statsmodels' MixedLM, used before, takes standard
errors from the observed Hessian at a fixed variance block (0.55 to 1.41 of lme4's where laps are
missing) and has no denominator degrees of freedom.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import optimize

Matrix = NDArray[np.float64]

_TINY = 1e-12


@dataclass(frozen=True, slots=True)
class InterceptFit:
    """What was fitted.

    Attributes
    ----------
    effects
        Shape (effects,): generalised least squares at the REML variances.
    covariance
        Shape (effects, effects): (X' V^-1 X)^-1, what lme4 prints.
    adjusted
        The same with Kenward and Roger's correction for the variances being estimates.
    between, within
        Standard deviations between people and of the residual.
    """

    effects: Matrix
    covariance: Matrix
    adjusted: Matrix
    between: float
    within: float
    _pieces: tuple[Matrix, Matrix]
    _information: Matrix

    def contrast(self, weights: ArrayLike) -> tuple[float, float, float]:
        """Return a contrast's estimate, its standard error, and its degrees of freedom.

        Parameters
        ----------
        weights
            Shape (effects,).

        Returns
        -------
        tuple of float
            Kenward and Roger's standard error and degrees of freedom, 1 at least.
        """
        w = np.asarray(weights, dtype=np.float64)
        phi = self.covariance
        scale = float(w @ phi @ w)
        # A_2 of Kenward and Roger for one contrast; then m = 2 / A_2 and lambda = 1.
        slopes = np.array([w @ phi @ p @ phi @ w for p in self._pieces]) / scale
        a2 = float(slopes @ self._information @ slopes)
        df = max(1.0, 2 / a2) if a2 > 0 else math.inf
        return float(w @ self.effects), math.sqrt(float(w @ self.adjusted @ w)), df


def fit_random_intercept(y: ArrayLike, x: ArrayLike, people: ArrayLike) -> InterceptFit | None:
    """Fit y ~ x + (1 | person) by restricted maximum likelihood.

    Parameters
    ----------
    y
        Shape (rows,).
    x
        Shape (rows, effects), of full column rank, the intercept included.
    people
        Shape (rows,): who each row is of.

    Returns
    -------
    InterceptFit or None
        None where nothing is left to estimate a spread from: fewer rows than effects and people
        need, a matrix without full rank, or a fit without residuals.

    References
    ----------
    Laird & Ware (1982), Biometrics 38(4), 963-974; Kenward & Roger (1997), Biometrics 53(3),
    983-997.

    Examples
    --------
    >>> import numpy as np
    >>> y = np.array([1.0, 2.1, 2.0, 3.2, 3.0, 3.9])
    >>> x = np.column_stack([np.ones(6), [0, 1] * 3])
    >>> fit = fit_random_intercept(y, x, [1, 1, 2, 2, 3, 3])
    >>> estimate, error, df = fit.contrast([0, 1])
    >>> round(estimate, 3), round(error, 3), round(df)
    (1.067, 0.088, 2)
    """
    values, matrix = np.asarray(y, dtype=np.float64), np.asarray(x, dtype=np.float64)
    codes = np.unique(np.asarray(people), return_inverse=True)[1]
    n, effects = matrix.shape
    if n - effects < 1 or np.linalg.matrix_rank(matrix) < effects:
        return None
    sums = _Sums(values, matrix, codes)
    ratio = _best_ratio(sums)
    if ratio is None:
        return None
    solved = sums.solve(ratio)
    sigma2 = solved.rss / (n - effects)
    tau2 = ratio * sigma2
    phi = sigma2 * np.linalg.inv(solved.normal)
    pieces, doubles, traces = sums.derivatives(sigma2, tau2)
    information = np.empty((2, 2))
    for i in range(2):
        for j in range(2):
            information[i, j] = 0.5 * (
                traces[i, j]
                - 2 * np.trace(phi @ doubles[i][j])
                + np.trace(phi @ pieces[i] @ phi @ pieces[j])
            )
    if np.linalg.cond(information) > 1 / _TINY:  # one row a person: one variance alone is known
        spread = np.linalg.pinv(information)
    else:
        spread = np.linalg.inv(information)
    bias = sum(
        spread[i, j] * (doubles[i][j] - pieces[i] @ phi @ pieces[j])
        for i in range(2)
        for j in range(2)
    )
    return InterceptFit(
        effects=solved.effects,
        covariance=phi,
        adjusted=phi + 2 * phi @ bias @ phi,
        between=math.sqrt(tau2),
        within=math.sqrt(sigma2),
        _pieces=pieces,
        _information=np.asarray(spread, dtype=np.float64),
    )


@dataclass(frozen=True, slots=True)
class _Solved:
    """Generalised least squares at one variance ratio."""

    effects: Matrix
    normal: Matrix
    rss: float
    log_determinant: float


class _Sums:
    """Sums of the rows, over all and by person: all that the likelihood needs."""

    def __init__(self, y: Matrix, x: Matrix, codes: NDArray[np.intp]) -> None:
        people = int(codes.max()) + 1
        self.sizes = np.bincount(codes, minlength=people).astype(np.float64)
        both = np.column_stack([x, y])
        by_person = np.zeros((people, both.shape[1]))
        np.add.at(by_person, codes, both)
        self.total, self.by_person = both.T @ both, by_person
        self.n, self.effects = x.shape

    def weighted(self, weights: Matrix) -> Matrix:
        """Return the sum over people of weight times the outer product of their sums."""
        product: Matrix = (self.by_person * weights[:, None]).T @ self.by_person
        return product

    def solve(self, ratio: float) -> _Solved:
        """Solve for the effects at a ratio of the variances, between over within."""
        # (I + r J)^-1 = I - r / (1 + r m) J, for a person with m rows.
        whitened = self.total - self.weighted(ratio / (1 + ratio * self.sizes))
        k = self.effects
        normal, right = whitened[:k, :k], whitened[:k, k]
        effects: Matrix = np.asarray(np.linalg.solve(normal, right), dtype=np.float64)
        rss = max(0.0, float(whitened[k, k] - right @ effects))
        log_v = float(np.log1p(ratio * self.sizes).sum())
        return _Solved(effects, normal, rss, log_v + float(np.linalg.slogdet(normal)[1]))

    def criterion(self, ratio: float) -> float:
        """Return minus twice the restricted log likelihood, up to a constant."""
        solved = self.solve(ratio)
        df = self.n - self.effects
        return float(df * math.log(max(solved.rss, 1e-300)) + solved.log_determinant)

    def derivatives(
        self, sigma2: float, tau2: float
    ) -> tuple[tuple[Matrix, Matrix], list[list[Matrix]], Matrix]:
        """Return P_i, Q_ij and tr(V^-1 V_i V^-1 V_j), for i, j = between, within."""
        k, m = self.effects, self.sizes
        shrink = tau2 / (sigma2 * (sigma2 + tau2 * m))  # V^-1 = I / sigma2 - shrink J
        on_j = 1 / (sigma2 + tau2 * m)  # V^-1 1 = on_j 1

        def quadratic(on_identity: float, on_ones: Matrix) -> Matrix:
            return (on_identity * self.total + self.weighted(on_ones))[:k, :k]

        def power(exponent: int) -> Matrix:
            """Return the weight of J in V^-exponent, beside I / sigma2^exponent."""
            return (on_j**exponent - sigma2**-exponent) / m

        assert np.allclose(power(1), -shrink)  # noqa: S101  # the two forms of the inverse agree
        pieces = (-quadratic(0.0, on_j**2), -quadratic(sigma2**-2, power(2)))
        mixed = quadratic(0.0, on_j**3)
        doubles = [
            [quadratic(0.0, m * on_j**3), mixed],
            [mixed, quadratic(sigma2**-3, power(3))],
        ]
        between = float((m**2 * on_j**2).sum())
        cross = float((m * on_j**2).sum())
        within = float(((m - 1) / sigma2**2 + on_j**2).sum())
        return pieces, doubles, np.array([[between, cross], [cross, within]])


def _best_ratio(sums: _Sums) -> float | None:
    """Return the ratio of variances, between over within, of the highest restricted likelihood."""
    spread = sums.solve(0.0).rss
    scale = max(float(sums.total[-1, -1]), _TINY)
    if spread <= _TINY * scale:
        return None  # without residuals there is nothing to estimate
    if sums.sizes.max() == 1:
        return 0.0

    def at(log_ratio: float) -> float:
        return sums.criterion(math.exp(log_ratio))

    grid = np.linspace(-12, 14, 27)
    heights = [at(g) for g in grid]
    best = int(np.argmin(heights))
    if best == len(grid) - 1:
        return None  # people differ, and their laps do not: no residual spread
    low, high = grid[max(best - 1, 0)], grid[best + 1]
    found = optimize.minimize_scalar(at, bounds=(low, high), method="bounded",
                                     options={"xatol": 1e-10})  # fmt: skip
    ratio = math.exp(float(found.x))
    return ratio if found.fun < sums.criterion(0.0) else 0.0
