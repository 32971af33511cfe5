"""Stopping at a corner to find out why the chair turns less than asked."""

from participants.human.corners import Corner
from participants.human.turn_response import TurnResponse

BELIEVED = 0.8
"""A person does not hesitate who believes that the chair turns this share of what is asked."""

FULL = 0.3
"""At this share, that of the paper's limitation, or less, the person stops for the whole time."""


class Hesitation:
    """How long a person still hesitates at a corner; each time is shorter than the one before.

    The power law of practice again (Newell & Rosenbloom, 1981), counted in corners at which the
    chair did not obey.

    Parameters
    ----------
    pause
        How long the person stops the first time, s.
    exponent
        The person's practice exponent.
    response
        What the person believes about the chair.
    """

    def __init__(self, pause: float, exponent: float, response: TurnResponse) -> None:
        self._pause, self._exponent, self._response = pause, exponent, response
        self._met = 0
        self._here: dict[Corner, int] = {}

    def start_lap(self) -> None:
        """Start a lap: every corner is ahead again; what was learnt stays."""
        self._here = {}

    def due(self, corner: Corner) -> float:
        """Return the whole time the person stops at a corner, as estimated now, s."""
        share = (BELIEVED - self._response.share_for(corner.turn)) / (BELIEVED - FULL)
        if share <= 0.0:
            return 0.0
        if corner not in self._here:
            self._met += 1
            self._here[corner] = self._met
        fades: float = self._here[corner] ** -self._exponent
        return self._pause * min(share, 1.0) * fades
