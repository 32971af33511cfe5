"""What an unfinished lap counts as in a comparison of lap times: the estimand."""

from typing import get_args

import numpy as np
import pandas as pd

from analysis.frames import StudyFrames
from protocols.declared import Unfinished

ESTIMANDS: tuple[Unfinished, ...] = get_args(Unfinished)


def timed_laps(frames: StudyFrames, unfinished: Unfinished) -> pd.DataFrame:
    """Return the analysed laps with the lap time that the estimand gives them.

    Parameters
    ----------
    frames
        The study.
    unfinished
        ``complete pairs``: an unfinished lap has no time; ``limit``: a lap that ran into its time
        limit took that long; ``worst rank``: it has no time, and ``worst`` says that it is slower
        than every finished one.

    Returns
    -------
    DataFrame
        The laps, with ``worst``. Laps that ended in another way than by their time limit have no
        time under any estimand: nobody knows what they would have taken.
    """
    laps = frames.laps
    over = (laps["end_reason"] == "time_limit") & ~laps["completed"].astype(bool)
    if unfinished == "limit":
        limits = {p.condition: p.time_limit_s for p in frames.study.protocol.laps}
        limit = laps["condition"].map(limits).astype("float64")
        capped = laps["lap_time_s"].clip(upper=limit)
        return laps.assign(lap_time_s=capped.where(~over, limit), worst=False)
    return laps.assign(worst=over if unfinished == "worst rank" else False)


def worst_differences(
    differences: pd.Series, laps: pd.DataFrame, condition: str, reference: str
) -> pd.Series:
    """Return differences in which an unfinished lap is slower than every finished one.

    Parameters
    ----------
    differences
        By participant, condition minus reference; missing where a lap has no time.
    laps
        participant, condition and ``worst``.

    Returns
    -------
    Series
        A pair with one unfinished lap differs by more than every other pair; one with two does not
        differ. Only their signs and ranks mean something.
    """
    worst = laps.pivot_table(index="participant", columns="condition", values="worst",
                             aggfunc="max", observed=False)  # fmt: skip
    worst = worst.reindex(index=differences.index, columns=[condition, reference])
    driven = worst.notna().all(axis=1)
    sign = worst[condition].astype(float).fillna(0) - worst[reference].astype(float).fillna(0)
    either = driven & worst.eq(1).any(axis=1)
    finite = differences.abs().max()
    beyond = 2 * (finite if np.isfinite(finite) and finite > 0 else 1.0)
    return differences.where(~either, sign * beyond)
