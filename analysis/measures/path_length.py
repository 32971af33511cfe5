"""How far the chair travelled."""

import numpy as np

from analysis.measures.streams import Steps, stream


def path_length(steps: Steps) -> float:
    """Return the length of the driven path, in m.

    Examples
    --------
    >>> import pyarrow as pa
    >>> path_length(Steps(pa.table({"x_m": [0.0, 3.0, 3.0], "y_m": [0.0, 0.0, 4.0]})))
    7.0
    """
    if len(steps) < 2:
        return float("nan")
    return float(np.hypot(np.diff(stream(steps, "x_m")), np.diff(stream(steps, "y_m"))).sum())
