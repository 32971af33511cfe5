"""What the factories of drivers, demonstrators and respondents get."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from participants.driver import Driver
from participants.live.seat import Seat
from participants.survey import Question
from participants.traits import ResponseStyle, Traits
from protocols.course.schema import Course


@dataclass(frozen=True, slots=True)
class DriverSetup:
    """What a driver is made from.

    Attributes
    ----------
    course
        The course it is going to drive.
    rng
        The driver's own random numbers for the whole session; each lap brings its own.
    traits
        How the person drives; None for drivers that are not people.
    options
        The protocol's options for this driver, as written in the file.
    folder
        Where relative paths in the options start; None for the working directory.
    seat
        Where a living driver sits; None for a simulated one.
    """

    course: Course
    rng: np.random.Generator
    traits: Traits | None = None
    options: Mapping[str, Any] = field(default_factory=dict)
    folder: Path | None = None
    seat: Seat | None = None


@dataclass(frozen=True, slots=True)
class ImpairmentSetup:
    """What an impairment is made from.

    Attributes
    ----------
    driver
        The driver whose commands it changes.
    severity
        From none, 0, to severe, 1.
    rng
        The impairment's own random numbers for the whole session; it derives those of each lap.
    options
        The protocol's options for this impairment, as written in the file.
    """

    driver: Driver
    severity: float
    rng: np.random.Generator
    options: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class DemonstratorSetup:
    """What a demonstrator is made from.

    Attributes
    ----------
    course
        The course it watches over.
    rng
        The demonstrator's own random numbers; it derives those of each lap from them.
    options
        The protocol's options for this demonstrator, as written in the file.
    seat
        Where a living demonstrator sits; None for a simulated one.
    """

    course: Course
    rng: np.random.Generator
    options: Mapping[str, Any] = field(default_factory=dict)
    seat: Seat | None = None


@dataclass(frozen=True, slots=True)
class RespondentSetup:
    """What a survey respondent is made from.

    Attributes
    ----------
    questions
        Every question the study is going to ask, in any lap.
    rng
        The respondent's own random numbers for the whole session; each survey brings its own.
    style
        How this person answers; None for a respondent without habits.
    options
        The protocol's options for respondents, as written in the file.
    seat
        Where a living respondent sits; None for a simulated one.
    """

    questions: tuple[Question, ...]
    rng: np.random.Generator
    style: ResponseStyle | None = None
    options: Mapping[str, Any] = field(default_factory=dict)
    seat: Seat | None = None
