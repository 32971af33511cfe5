"""What a person has learnt about how far the chair obeys the stick."""

from lad.command import Command

LEAST = 0.1
"""The least share that a person can come to believe."""

NOTICEABLE = 0.15
"""Turn rates below this are too slow to show whether the chair obeys, rad/s."""

STEADY = 0.25
"""The stick is steady while its turn rate stays within this share of the remembered one."""

SETTLING = 0.4
"""Time constant with which a person remembers what the stick has been asking, s."""


class TurnResponse:
    """The turn rate of the chair as a share of the turn rate asked for, to either side.

    A person who is slowed to one side notices within seconds, and keeps the experience: the
    human half of McRuer & Jex's (1967) crossover model, in which people adapt their gain to the
    plant.

    Parameters
    ----------
    rate
        How fast the person learns, 1/s.
    """

    def __init__(self, rate: float) -> None:
        self.right = 1.0
        self.left = 1.0
        self._rate = rate
        self._asked = 0.0

    def share_for(self, w: float) -> float:
        """Return the believed share for a turn rate of this sign, rad/s."""
        return self.right if w < 0 else self.left

    def start_lap(self) -> None:
        """Forget what was asked last; keep what was learnt."""
        self._asked = 0.0

    def observe(self, asked: Command, felt: Command, passed: float, trusted: bool) -> None:
        """Learn from one step.

        Parameters
        ----------
        asked
            What the stick asks for.
        felt
            The chair's velocities, as the person feels them.
        passed
            Seconds since the last call.
        trusted
            Whether it was the stick that moved the chair, and nothing else.
        """
        self._asked += min(passed / SETTLING, 1.0) * (asked.w - self._asked)
        # Only a steady stick shows the chair's response: the chair takes time to follow.
        steady = abs(asked.w - self._asked) < STEADY * abs(self._asked)
        if not (trusted and steady) or abs(self._asked) < NOTICEABLE:
            return
        share = min(max(felt.w / self._asked, LEAST), 1.0)
        learn = min(self._rate * passed, 1.0)
        if self._asked < 0:
            self.right += learn * (share - self.right)
        else:
            self.left += learn * (share - self.left)
