"""A lap's steps as measures see them: streams of numbers, missing where nothing was recorded."""

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

Steps = pd.DataFrame
"""One lap's step table (``protocols.record.steps``), one row per control step."""

Numbers = NDArray[np.float64]
Flags = NDArray[np.bool_]


def stream(steps: Steps, name: str) -> Numbers:
    """Return a column as numbers; NaN where it is missing, all NaN when it was not recorded."""
    if name not in steps:
        return np.full(len(steps), np.nan)
    column = steps[name]
    if column.dtype == np.float64:
        return column.to_numpy()
    return pd.to_numeric(column).to_numpy(dtype=np.float64, na_value=np.nan)


def period(steps: Steps) -> float:
    """Return the length of a control step in s; NaN for fewer than two steps."""
    t = stream(steps, "t_s")
    return float(np.median(np.diff(t))) if len(t) > 1 else float("nan")


def helped(steps: Steps) -> Flags | None:
    """Return in which steps an assistant's command counted; None when control was not recorded."""
    if "control" not in steps or len(steps) == 0:
        return None
    control = steps["control"].to_numpy(dtype=object)
    return None if pd.isna(control).any() else np.asarray(control != "driver", dtype=np.bool_)


def would_help(steps: Steps) -> Flags | None:
    """Return in which steps the shadow demonstrator would help; None when it was not recorded."""
    h = stream(steps, "h_would")
    if len(h) == 0 or np.isnan(h).any():
        return None
    return np.asarray(h > 0)


def command(steps: Steps, who: str) -> Numbers:
    """Return commands in shares of full deflection.

    Parameters
    ----------
    steps
        A lap's steps.
    who
        Stem of the columns: ``intent``, ``user``, ``arbitrated``, ``executed``, ``a``, ``would``,
        ``mean``, ``result``.

    Returns
    -------
    NDArray
        Shape (steps, 2): v over the top speed, w over the top turn rate. Both are then of order 1,
        so that a norm or an angle between two commands means something.
    """
    v, w = stream(steps, f"{who}_v"), stream(steps, f"{who}_w")
    return np.column_stack([v / MAX_SPEED, w / MAX_TURN_RATE])
