"""What a survey asks, what it asks about, and the seam every respondent fits."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np


@dataclass(frozen=True, slots=True)
class Question:
    """One item of an instrument, as far as a respondent needs to know it.

    Attributes
    ----------
    instrument
        The instrument as the protocol names it.
    item
        The item's id, e.g. ``"Q7"``.
    points
        How many points the answering scale has, 2 or more; 1 is the strongest disagreement.
    """

    instrument: str
    item: str
    points: int = 5


@dataclass(frozen=True, slots=True)
class LapExperience:
    """A lap as its driver lived it.

    Attributes
    ----------
    lap_time
        Seconds from start to finish, or to the end of an unfinished lap.
    baseline_time
        The same person's own baseline lap in seconds; None when there was none before.
    assisted_fraction
        Share of steps in which somebody else's command counted, in [0, 1].
    interventions
        Number of unbroken stretches of assistance.
    interference
        Share of steps in which the assistant opposed what the user wanted, in [0, 1].
    collisions
        Number of contacts with obstacles.
    completed
        Whether the lap reached its last gate.
    """

    lap_time: float
    baseline_time: float | None
    assisted_fraction: float
    interventions: int
    interference: float
    collisions: int
    completed: bool


class Respondent(Protocol):
    """Who fills in the questionnaires."""

    def answer(
        self, questions: Sequence[Question], lived: LapExperience, rng: np.random.Generator
    ) -> tuple[int | None, ...]:
        """Answer the questions about one lap.

        Parameters
        ----------
        questions
            What is asked, in the order asked.
        lived
            The lap as it was lived.
        rng
            This survey's own random numbers.

        Returns
        -------
        tuple
            One answer per question, 1 to the scale's points; None where it was left out.
        """
