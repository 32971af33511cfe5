"""How far from the centreline the chair was driven."""

import numpy as np

from analysis.measures.streams import Steps, stream


def path_deviation(steps: Steps) -> float:
    """Return the mean distance from the centreline per metre of progress, in m.

    Steps are weighted by the distance they covered, so that standing still does not count.
    """
    offset = np.abs(stream(steps, "offset_m"))
    x, y = stream(steps, "x_m"), stream(steps, "y_m")
    if len(steps) < 2 or np.isnan(offset).any():
        return float("nan")
    covered = np.hypot(np.diff(x), np.diff(y))
    total = float(covered.sum())
    return float(offset[:-1] @ covered / total) if total > 0 else float("nan")
