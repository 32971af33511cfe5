"""What a part is shown, as a recording that can be played to another part."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lad.command import Command
from participants.sight import Sight
from participants.survey import LapExperience, Question

Demonstrated = tuple[bool, Command | None]
"""What there is to learn in a step: whether the demonstrator helped, and with which command."""


@dataclass(frozen=True, slots=True)
class Moment:
    """One control step of a lap, as each role may see it.

    Attributes
    ----------
    sight
        What drivers and demonstrators see.
    x
        Shape (19,): the inputs of assistants and demonstrators.
    demonstrated
        What a model is taught after the step; None in a lap that teaches nothing.
    """

    sight: Sight
    x: NDArray[np.float64]
    demonstrated: Demonstrated | None = None


@dataclass(frozen=True, slots=True)
class Survey:
    """One questionnaire, as a respondent gets it.

    Attributes
    ----------
    questions, experience, rng
        As ``Respondent.answer`` takes them.
    """

    questions: tuple[Question, ...]
    experience: LapExperience
    rng: np.random.Generator


Shown = Moment | Survey
Laps = Sequence[Sequence[Shown]]
"""Per lap, what is shown in it; a questionnaire counts as a lap with one thing to see."""
