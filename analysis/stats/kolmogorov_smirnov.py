"""The two-sample Kolmogorov-Smirnov test, as the paper used it (section IV.E)."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy import special

from analysis.stats.result import TestResult
from analysis.stats.samples import Sample, present

EXACT_BELOW = 10_000
"""Product of the sample sizes below which the p-value is exact (as in R's ``ks.test``)."""

_NAME = "Kolmogorov-Smirnov"


def two_sample_ks(x: Sample, y: Sample, *, same_people: bool) -> TestResult:
    """Compare two samples' distribution functions.

    Parameters
    ----------
    x, y
        The samples, in any order and unit; missing values are left out.
    same_people
        Whether both samples come from the same participants. The test assumes that they do not;
        the result then only describes.

    Returns
    -------
    TestResult
        Estimate and statistic are the largest distance D; the p-value is exact for small samples
        (ties included), asymptotic for large ones. A note gives the p-value with Stephens'
        correction, which is the one behind the paper's p = .4370.

    Examples
    --------
    >>> two_sample_ks([1, 2, 3], [4, 5, 6], same_people=False).statistic
    1.0
    """
    a, b = present(x), present(y)
    if len(a) == 0 or len(b) == 0:
        return TestResult.missing(_NAME, len(a) + len(b), "one of the two samples is empty")
    d = _distance(a, b)
    exact = len(a) * len(b) < EXACT_BELOW
    p = _exact_p(a, b, d) if exact else asymptotic_p(d, len(a), len(b))
    notes = [
        f"samples of {len(a)} and {len(b)}",
        f"p with Stephens' correction: {stephens_p(d, len(a), len(b)):.4f}",
    ]
    if same_people:
        notes.append("descriptive only: both samples come from the same people")
    return TestResult(
        name=_NAME,
        quantity="largest distance of the distribution functions",
        estimate=d,
        statistic=d,
        statistic_name="D",
        p=p,
        n=len(a) + len(b),
        method=f"two-sample Kolmogorov-Smirnov, two-sided, {'exact' if exact else 'asymptotic'}",
        notes=tuple(notes),
    )


def asymptotic_p(d: float, m: int, n: int) -> float:
    """Return Kolmogorov's limiting p-value of a distance between samples of m and n."""
    return float(special.kolmogorov(d * math.sqrt(m * n / (m + n))))


def stephens_p(d: float, m: int, n: int) -> float:
    """Return the limiting p-value with Stephens' (1970) correction for small samples.

    Examples
    --------
    The paper's k = 0.3125 and p = 0.4370 (section IV.E) belong to samples of 12 and 16:

    >>> round(stephens_p(0.3125, 12, 16), 4)
    0.437
    """
    root = math.sqrt(m * n / (m + n))
    return float(special.kolmogorov(d * (root + 0.12 + 0.11 / root)))


def _distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    at = np.concatenate([a, b])
    below_a = np.searchsorted(np.sort(a), at, side="right") / len(a)
    below_b = np.searchsorted(np.sort(b), at, side="right") / len(b)
    return float(np.abs(below_a - below_b).max())


def _exact_p(a: NDArray[np.float64], b: NDArray[np.float64], d: float) -> float:
    """P(D >= d) given the pooled values: walk all ways to deal them out to the two samples.

    ``inside[j]`` is the chance that i of the first sample and j of the second have come without
    the distance having reached d where a tie group ends.
    """
    m, n = len(a), len(b)
    pooled = np.sort(np.concatenate([a, b]))
    ends = np.append(np.diff(pooled) > 0, True)  # the last value ends its group
    reach = (0.5 + math.floor(d * m * n - 1e-7)) / (m * n)
    inside = np.zeros(n + 1)
    for i in range(m + 1):
        for j in range(n + 1):
            if i + j == 0:
                inside[0] = 1.0
            elif ends[i + j - 1] and abs(i / m - j / n) >= reach:
                inside[j] = 0.0
            else:
                came_from_a = inside[j] * i / (i + j) if i else 0.0
                came_from_b = inside[j - 1] * j / (i + j) if j else 0.0
                inside[j] = came_from_a + came_from_b
    return float(min(1.0, max(0.0, 1.0 - inside[n])))
