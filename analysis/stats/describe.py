"""The numbers of one sample in a table."""

import math
from dataclasses import dataclass

import numpy as np

from analysis.stats.samples import Sample, present


@dataclass(frozen=True, slots=True)
class Description:
    """A sample in numbers.

    Attributes
    ----------
    n, missing
        Values there are, and values that are missing.
    mean, sd, median, low, high
        In the sample's unit; sd with n - 1, NaN for fewer than two values; low and high are the
        smallest and largest value.
    """

    n: int
    missing: int
    mean: float
    sd: float
    median: float
    low: float
    high: float


def describe(values: Sample) -> Description:
    """Describe a sample; missing values are counted and left out.

    Examples
    --------
    >>> describe([1.0, 2.0, 3.0, float("nan")])
    Description(n=3, missing=1, mean=2.0, sd=1.0, median=2.0, low=1.0, high=3.0)
    """
    x = present(values)
    missing = np.asarray(values, dtype=np.float64).size - len(x)
    if len(x) == 0:
        return Description(0, missing, *[math.nan] * 5)
    sd = float(x.std(ddof=1)) if len(x) > 1 else math.nan
    return Description(
        len(x), missing, float(x.mean()), sd, float(np.median(x)), float(x.min()), float(x.max())
    )
