"""How punctual this machine is at the moment: asked before a lap, because a lap cannot wait."""

import time
from collections.abc import Callable

import numpy as np

TOO_LATE_S = 0.015
"""A machine that wakes later than this, in one of twenty times, is too busy for a lap, s."""


def lateness_s(
    probes: int = 40,
    every_s: float = 0.005,
    sleep: Callable[[float], None] = time.sleep,
    now: Callable[[], float] = time.monotonic,
) -> float:
    """Return how late this thread wakes from short sleeps: the 95th percentile, s.

    Parameters
    ----------
    probes, every_s
        How many sleeps, and how long each is, s.
    sleep, now
        What sleeps, and the clock it is compared with.

    Examples
    --------
    >>> clock = iter([0.0, 0.007, 0.007, 0.014])
    >>> round(lateness_s(2, 0.005, sleep=lambda _: None, now=lambda: next(clock)), 6)
    0.002
    """
    late = np.empty(probes)
    for probe in range(probes):
        begun = now()
        sleep(every_s)
        late[probe] = now() - begun - every_s
    return max(float(np.quantile(late, 0.95)), 0.0)
