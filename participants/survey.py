"""What a survey asks, what it asks about, and the seam every respondent fits."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from protocols.instrument import AnswerKind

Answer = int | float | str | None
"""A point of a scale, a number, text; None where a question was left out."""


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
    text
        The wording, as a person reads it.
    anchors
        Labels of the scale's points, from 1 upwards.
    answer
        How it is answered: by a point of the scale, a number, or free text.
    lowest, highest
        Of a number, both included; None for no bound.
    step
        Of a number: answers are whole steps from the lowest one; None for any number between.
    ends
        What stands at the two ends of a number's scale; None for nothing.
    expected
        Of an attention check: the answer that whoever reads it gives; None for a question.
    """

    instrument: str
    item: str
    points: int = 5
    text: str = ""
    anchors: tuple[str, ...] = ()
    answer: AnswerKind = "point"
    lowest: float | None = None
    highest: float | None = None
    step: float | None = None
    ends: tuple[str, str] | None = None
    expected: float | None = None


@dataclass(frozen=True, slots=True)
class LapExperience:
    """A lap as its driver experienced it.

    Attributes
    ----------
    lap_time
        Seconds from start to finish, or to the end of an unfinished lap.
    baseline_time
        The same person's own baseline lap in seconds; None when there was none before.
    assisted_fraction
        Share of steps in which the assistant's command counted, in [0, 1].
    interventions
        Number of unbroken stretches of assistance.
    interference
        Share of steps in which the assistant opposed what the driver wanted, in [0, 1].
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
    """Fills in the questionnaires."""

    def answer(
        self, questions: Sequence[Question], experience: LapExperience, rng: np.random.Generator
    ) -> tuple[Answer, ...]:
        """Answer the questions about one lap.

        Parameters
        ----------
        questions
            What is asked, in the order asked.
        experience
            The lap as its driver experienced it.
        rng
            This survey's own random numbers.

        Returns
        -------
        tuple
            One answer per question, of the question's kind; None where it was left out.
        """


def response_times_of(respondent: Any) -> tuple[float | None, ...] | None:
    """Return how long each of a respondent's last answers took, s; None where that is not known.

    A living one has ``response_times``; simulated ones take no time.

    Parameters
    ----------
    respondent
        Who has answered, living or simulated.

    Examples
    --------
    >>> response_times_of(object()) is None  # a simulated one
    True
    """
    times = getattr(respondent, "response_times", None)
    return None if times is None else times()
