"""When a person ends the session: the lap takes too long, or the person feels unwell.

Assumptions. What is known: none of the paper's twelve participants
left, which is compatible with anything up to about one session in four (26.5%, the upper end of
the two-sided 95% interval of Clopper & Pearson, 1934).
"""

import numpy as np

from participants.driver import WithdrewError

THINKING_IT_OVER = 20.0
"""Mean time between losing patience and ending the session, s."""

UNWELL_EVERY = 36_000.0
"""Mean driving time until a person feels too unwell to continue, s: one in a hundred sessions of
six minutes."""


class Patience:
    """One person's patience in one lap.

    Both ways to end are hazards: that of feeling unwell is constant, that of giving up begins
    when the lap has taken longer than the person's patience.

    Parameters
    ----------
    patience
        The person's patience with a lap, s.
    rng
        This lap's random numbers for it.
    """

    def __init__(self, patience: float, rng: np.random.Generator) -> None:
        self._gives_up = patience + THINKING_IT_OVER * float(rng.exponential())
        self._unwell = UNWELL_EVERY * float(rng.exponential())

    def check(self, t: float) -> None:
        """Continue, or leave.

        Parameters
        ----------
        t
            Seconds since the lap started.

        Raises
        ------
        WithdrewError
            With the reason in the participant's words.
        """
        if t >= self._unwell:
            raise WithdrewError("I do not feel well")
        if t >= self._gives_up:
            raise WithdrewError("this takes too long")
