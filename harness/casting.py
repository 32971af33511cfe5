"""Who takes part in one session: the person, and whoever else the protocol names."""

from dataclasses import replace
from pathlib import Path

from harness.lap import Cast
from harness.model import make_model
from harness.plan import Plan
from harness.seeds import stream
from participants.cohort import Person
from participants.cohort import draw_person as drawn_from_cohort
from participants.driver import Driver
from participants.registry import make_demonstrator, make_driver, make_impaired, make_respondent
from participants.setup import DemonstratorSetup, DriverSetup, ImpairmentSetup, RespondentSetup
from participants.survey import Question, Respondent
from protocols.instrument import Instrument, Item
from protocols.record.rows import participant_id


def rehearse(plan: Plan) -> None:
    """Make everybody of the first session once, so that a mistake shows before anything runs.

    Raises
    ------
    InputError
        When a driver, demonstrator, model or respondent cannot be made.
    """
    person = draw_person(plan, 1)
    cast(plan, 1, person)
    for impairment in plan.study.protocol.cohort.impairments:
        cast(plan, 1, replace(person, impairment=impairment))
    respondent(plan, 1, person)


def draw_person(plan: Plan, number: int) -> Person:
    """Return the person who is a synthetic participant, the same one in every run."""
    return drawn_from_cohort(plan.study.protocol.cohort, stream(plan.seed, number, "person"))


def cast(plan: Plan, number: int, person: Person) -> Cast:
    """Return who is there in every lap of a participant's session."""
    study, seed = plan.study, plan.seed
    cohort, course = study.protocol.cohort, study.course
    driver = DriverSetup(
        course=course,
        rng=stream(seed, number, "driver"),
        traits=person.traits,
        options=cohort.driver.options,
        folder=study.folder,
    )
    demonstrator = DemonstratorSetup(
        course=course,
        rng=stream(seed, number, "demonstrator"),
        options=cohort.demonstrator.options,
    )
    words = {"participant": participant_id(number), "folder": str(study.folder or Path())}
    return Cast(
        driver=_impaired(plan, number, person, make_driver(cohort.driver.use, driver)),
        demonstrator=make_demonstrator(cohort.demonstrator.use, demonstrator),
        model=make_model(study.protocol.model, words),
    )


def _impaired(plan: Plan, number: int, person: Person, driver: Driver) -> Driver:
    """Return a driver with the person's impairment, if the person has one."""
    impairment = person.impairment
    if impairment is None:
        return driver
    rng = stream(plan.seed, number, "impairment")
    setup = ImpairmentSetup(driver, impairment.severity, rng, impairment.options)
    return make_impaired(impairment.use, setup)


def respondent(plan: Plan, number: int, person: Person) -> Respondent:
    """Return who answers a participant's questionnaires."""
    study = plan.study
    asked = (pair for lap in range(len(study.protocol.laps)) for pair in study.questions(lap))
    setup = RespondentSetup(
        questions=tuple(dict.fromkeys(question(*pair) for pair in asked)),
        rng=stream(plan.seed, number, "respondent"),
        style=person.style,
        options=study.protocol.cohort.respondent.options,
    )
    return make_respondent(study.protocol.cohort.respondent.use, setup)


def question(instrument: Instrument, item: Item) -> Question:
    """Return an item as a respondent gets to know it."""
    return Question(instrument=instrument.name, item=item.id, points=instrument.points)
