"""Where, and how, a part is checked: the same for every role."""

from dataclasses import dataclass, field

from protocols.course.schema import Course
from protocols.instrument import Instrument
from protocols.load import load_course, load_instrument

PARTICIPANT = 1
"""Checks are sessions of a study's first participant: random numbers are named the same way."""


def _course() -> Course:
    return load_course("lab-office")


def _instrument() -> Instrument:
    return load_instrument("driving-assistance")


@dataclass(frozen=True, slots=True)
class Setting:
    """What the study around a part is like.

    Attributes
    ----------
    course
        The course that is driven; ``lab-office`` by default.
    instrument
        What a respondent is asked; ``driving-assistance`` by default.
    period
        Length of a control step, s.
    seed
        Of every random draw; 0 or more.
    lap_s
        When a lap ends, s; by default the first sharp corner of the default course, and a
        demonstrator's help, lie in it.
    """

    course: Course = field(default_factory=_course)
    instrument: Instrument = field(default_factory=_instrument)
    period: float = 0.1
    seed: int = 0
    lap_s: float = 20.0
