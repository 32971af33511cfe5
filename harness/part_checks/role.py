"""The roles that a protocol names parts for: how a part is made, and how a study asks it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from harness.part_checks.setting import PARTICIPANT, Setting
from harness.part_checks.shown import Moment
from harness.session.parts import question
from harness.session.seeds import generator
from participants.cohort import typical_traits
from participants.registry import make_driver
from participants.setup import DemonstratorSetup, DriverSetup, ImpairmentSetup, RespondentSetup
from participants.survey import Question
from protocols.shipped_parts import DEMONSTRATORS, DRIVERS, IMPAIRMENTS, MODELS, RESPONDENTS

RoleName = Literal["driver", "assistant", "demonstrator", "respondent", "impairment", "world"]

SEVERITY = 0.5
"""Of an impairment that is checked, unless another one is asked for."""


@dataclass(frozen=True, slots=True)
class Role:
    """A role that takes part in laps or questionnaires.

    Attributes
    ----------
    name
        What a part of this role is called.
    shipped
        Factories of the shipped ones, by name.
    signatures
        The methods a study calls, as it calls them.
    make
        Makes a part as a study would, of its factory, options and setting.
    start
        Begins a lap of a part: its position in the session, and the lap's random numbers.
    ask
        Shows the part one thing, and returns its answer.
    """

    name: RoleName
    shipped: Mapping[str, str]
    signatures: Mapping[str, str]
    make: Callable[[Callable[..., Any], dict[str, Any], Setting], Any]
    start: Callable[[Any, int, np.random.Generator], object]
    ask: Callable[[Any, Any], Any]


def driver_setup(options: dict[str, Any], setting: Setting) -> DriverSetup:
    """Return what a driver is made from: the course, and the traits of the median person."""
    rng = generator(setting.seed, PARTICIPANT, "driver")
    return DriverSetup(setting.course, rng, typical_traits(), options)


def impairment_setup(
    options: dict[str, Any], setting: Setting, driver: Any = None, severity: float = SEVERITY
) -> ImpairmentSetup:
    """Return what an impairment is made from; around the autonomous driver unless one is given."""
    if driver is None:
        driver = make_driver("autonomous", driver_setup({}, setting))
    rng = generator(setting.seed, PARTICIPANT, "impairment")
    return ImpairmentSetup(driver, severity, rng, options)


def demonstrator_setup(options: dict[str, Any], setting: Setting) -> DemonstratorSetup:
    """Return what a demonstrator is made from."""
    rng = generator(setting.seed, PARTICIPANT, "demonstrator")
    return DemonstratorSetup(setting.course, rng, options)


def respondent_setup(options: dict[str, Any], setting: Setting) -> RespondentSetup:
    """Return what a respondent is made from."""
    rng = generator(setting.seed, PARTICIPANT, "respondent")
    return RespondentSetup(questions_of(setting), rng, None, options)


def questions_of(setting: Setting) -> tuple[Question, ...]:
    """Return every item of the setting's instrument, as a respondent reads it."""
    return tuple(question(setting.instrument, item) for item in setting.instrument.items)


def _ask_assistant(part: Any, moment: Moment) -> Any:
    answer = part.assist(moment.x)
    if moment.demonstrated is not None and callable(getattr(part, "learn", None)):
        part.learn(*moment.demonstrated)
    return answer


def _ask_demonstrator(part: Any, moment: Moment) -> Any:
    part.look(moment.sight)
    return part.assist(moment.x)


DRIVER = Role(
    name="driver",
    shipped=DRIVERS,
    signatures={"start_lap": "lap, rng", "act": "sight"},
    make=lambda factory, options, setting: factory(driver_setup(options, setting)),
    start=lambda part, lap, rng: part.start_lap(lap, rng),
    ask=lambda part, moment: part.act(moment.sight),
)
IMPAIRMENT = Role(
    name="impairment",
    shipped=IMPAIRMENTS,
    signatures=DRIVER.signatures,
    make=lambda factory, options, setting: factory(impairment_setup(options, setting)),
    start=DRIVER.start,
    ask=DRIVER.ask,
)
ASSISTANT = Role(
    name="assistant",
    shipped=MODELS,
    signatures={"start_lap": "", "assist": "x"},
    make=lambda factory, options, _setting: factory(**options),
    start=lambda part, _lap, _rng: part.start_lap(),
    ask=_ask_assistant,
)
DEMONSTRATOR = Role(
    name="demonstrator",
    shipped=DEMONSTRATORS,
    signatures={"start_lap": "", "look": "sight", "assist": "x"},
    make=lambda factory, options, setting: factory(demonstrator_setup(options, setting)),
    start=ASSISTANT.start,
    ask=_ask_demonstrator,
)
RESPONDENT = Role(
    name="respondent",
    shipped=RESPONDENTS,
    signatures={"answer": "questions, experience, rng"},
    make=lambda factory, options, setting: factory(respondent_setup(options, setting)),
    start=lambda _part, _lap, _rng: None,
    ask=lambda part, survey: part.answer(survey.questions, survey.experience, survey.rng),
)
ROLES: Mapping[RoleName, Role] = {
    role.name: role for role in (DRIVER, ASSISTANT, DEMONSTRATOR, RESPONDENT, IMPAIRMENT)
}
"""Every role that is asked in laps or questionnaires; a world is none of them."""
