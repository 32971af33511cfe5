"""Stopping at a corner to find out why the chair turns less than asked."""

from participants.human.corners import Corner
from participants.human.turn_response import TurnResponse

BELIEVED = 0.8
"""A chair that is believed to obey this share of a turn, or more, makes nobody wonder."""

FULL = 0.3
"""At this share, that of the paper's limitation, or less, one wonders for the whole time."""


class Hesitation:
    """How long a person still wonders at a corner; each time for less than the time before.

    The power law of practice again (Newell & Rosenbloom, 1981), counted in corners at which the
    chair did not obey.

    Parameters
    ----------
    pause
        How long the person stops the first time, s.
    exponent
        The person's practice exponent.
    authority
        What the person believes about the chair.
    """

    def __init__(self, pause: float, exponent: float, response: TurnResponse) -> None:
        self._pause, self._exponent, self._response = pause, exponent, response
        self._met = 0
        self._here: dict[Corner, int] = {}

    def start_lap(self) -> None:
        """Come to the corners anew; what they taught stays."""
        self._here = {}

    def due(self, corner: Corner) -> float:
        """Return the time one stops at a corner in all, as far as one can tell now, s."""
        share = (BELIEVED - self._response.of(corner.turn)) / (BELIEVED - FULL)
        if share <= 0.0:
            return 0.0
        if corner not in self._here:
            self._met += 1
            self._here[corner] = self._met
        fades: float = self._here[corner] ** -self._exponent
        return self._pause * min(share, 1.0) * fades
