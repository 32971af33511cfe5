"""Whether the model anticipates help (section IV.D): when p(h) rises, against the takeover."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from analysis.measures.episodes import Episode, episodes
from analysis.reproduction.teaching import PredictedLap

RISEN = 0.25
"""p(h) that counts as anticipation; half the paper's W_h."""


def leads(laps: Iterable[PredictedLap]) -> NDArray[np.float64]:
    """Return the lead of p(h) over each takeover, s.

    The lead is the time from the step in which p(h) reached 0.25, and stayed there until the
    takeover, to the takeover; negative when it came there only during the help.

    Returns
    -------
    NDArray
        One per takeover; NaN where p(h) did not reach 0.25 until the help ended.
    """
    return np.array([_lead(lap, help_) for lap in laps for help_ in episodes(lap.helped)])


def _lead(lap: PredictedLap, given: Episode) -> float:
    risen = lap.p_help >= RISEN
    if not risen[given.start]:
        later = np.flatnonzero(risen[given.start : given.stop])
        return float(lap.t[given.start] - lap.t[given.start + later[0]]) if len(later) else np.nan
    below = np.flatnonzero(~risen[: given.start])
    since = below[-1] + 1 if len(below) else 0
    return float(lap.t[given.start] - lap.t[since])
