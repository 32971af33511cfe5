"""Holm's step-down correction over a declared family."""

from collections.abc import Sequence

import numpy as np


def holm(p_values: Sequence[float]) -> tuple[float, ...]:
    """Return the adjusted p-values of a family, in its order.

    Parameters
    ----------
    p_values
        One per test of the family. A test that could not be computed (NaN) stays NaN, yet counts:
        the family is what was declared, not what could be computed.

    References
    ----------
    Holm (1979), Scandinavian Journal of Statistics 6(2), 65-70.

    Examples
    --------
    >>> holm([0.01, 0.04, 0.03])
    (0.03, 0.06, 0.06)
    """
    p = np.asarray(p_values, dtype=np.float64)
    adjusted = np.full(len(p), np.nan)
    highest = 0.0
    for rank, i in enumerate(np.argsort(p)):  # NaN sorts last
        if np.isnan(p[i]):
            break
        highest = max(highest, min(1.0, (len(p) - rank) * float(p[i])))
        adjusted[i] = highest
    return tuple(float(value) for value in adjusted)
