"""What takes part in one session: the person, and every part that the protocol names."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from harness.session.lap import LapParts
from harness.session.model import make_model
from harness.session.seeds import generator
from harness.session.study_run import StudyRun, of_one
from lad.assistant import Assistant
from participants.cohort import Person
from participants.cohort import draw_person as drawn_from_cohort
from participants.demonstrator import Demonstrator
from participants.driver import Driver
from participants.pages import PageReader, SimulatedReader
from participants.registry import make_demonstrator, make_driver, make_impaired, make_respondent
from participants.setup import DemonstratorSetup, DriverSetup, ImpairmentSetup, RespondentSetup
from participants.survey import Question, Respondent
from protocols.groups import Group
from protocols.instrument import Instrument, Item
from protocols.order import laps_of
from protocols.record.rows import participant_id


@dataclass(frozen=True, slots=True)
class SessionParts:
    """What a session is given from outside.

    Attributes
    ----------
    person
        Who the participant is.
    lap
        Driver, demonstrator and model.
    respondent
        Answers the questionnaires; None for a study without one.
    reader
        Reads the pages beside laps and questionnaires.
    models
        Models that others have taught, by the protocol's names for them.
    """

    person: Person
    lap: LapParts
    respondent: Respondent | None
    reader: PageReader
    models: Mapping[str, Assistant] = field(default_factory=dict)


def make_every_part(run: StudyRun) -> None:
    """Make each part of the first session once, so that a mistake shows before anything runs.

    Raises
    ------
    InputError
        When a driver, demonstrator, model or respondent cannot be made.
    """
    person = draw_person(run, 1)
    make_parts(run, 1, person)
    for group in run.study.protocol.groups.values():
        _make_model_of(run, group)
    for impairment in run.study.protocol.cohort.impairments:
        make_parts(run, 1, replace(person, impairment=impairment))


def _make_model_of(run: StudyRun, group: Group) -> None:
    """Make what is different for a group, as in ``make_parts``."""
    protocol = run.study.protocol
    changes: dict[str, object] = {"model": group.model or protocol.model, "groups": {}}
    if group.demonstrator is not None:
        update = {"demonstrator": group.demonstrator}
        changes["cohort"] = protocol.cohort.model_copy(update=update)
    study = replace(run.study, protocol=protocol.model_copy(update=changes))
    make_parts(replace(run, study=study), 1)


def draw_person(run: StudyRun, number: int) -> Person:
    """Return the person who is a synthetic participant, the same one in every run."""
    return drawn_from_cohort(run.study.protocol.cohort, generator(run.seed, number, "person"))


def make_parts(run: StudyRun, number: int, person: Person | None = None) -> SessionParts:
    """Return what takes part in a participant's session.

    Parameters
    ----------
    run, number
        The study and the participant, counted from 1.
    person
        Who it is; None for the synthetic person that the seed draws.

    Raises
    ------
    InputError
        When a part that the protocol names cannot be made.
    """
    run = of_one(run, number)
    whose = draw_person(run, number) if person is None else person
    return SessionParts(
        person=whose,
        lap=LapParts(
            driver=_driver(run, number, whose),
            demonstrator=_demonstrator(run, number),
            model=_model(run, number),
        ),
        respondent=_respondent(run, number, whose),
        reader=SimulatedReader(whose.particulars()),
    )


def _driver(run: StudyRun, number: int, person: Person) -> Driver:
    """Return the driver, with the person's impairment around it if the person has one."""
    choice = run.study.protocol.cohort.driver
    setup = DriverSetup(
        course=run.study.course,
        rng=generator(run.seed, number, "driver"),
        traits=person.traits,
        options=choice.options,
        folder=run.study.folder,
    )
    driver, impairment = make_driver(choice.use, setup), person.impairment
    if impairment is None:
        return driver
    rng = generator(run.seed, number, "impairment")
    around = ImpairmentSetup(driver, impairment.severity, rng, impairment.options)
    return make_impaired(impairment.use, around)


def _demonstrator(run: StudyRun, number: int) -> Demonstrator | None:
    choice = run.study.protocol.cohort.demonstrator
    if choice is None:
        return None
    rng = generator(run.seed, number, "demonstrator")
    return make_demonstrator(choice.use, DemonstratorSetup(run.study.course, rng, choice.options))


def _model(run: StudyRun, number: int) -> Assistant:
    folder = str(run.study.folder or Path())
    words = {"participant": participant_id(number), "folder": folder}
    return make_model(run.study.protocol.model, words)


def _respondent(run: StudyRun, number: int, person: Person) -> Respondent | None:
    study, choice = run.study, run.study.protocol.cohort.respondent
    if choice is None:
        return None
    laps = laps_of(study.protocol, number, run.seed)
    asked = [pair for planned in laps for pair in study.questions(planned)]
    asked += study.session_questions
    setup = RespondentSetup(
        questions=tuple(dict.fromkeys(question(*pair) for pair in asked)),
        rng=generator(run.seed, number, "respondent"),
        style=person.style,
        options=choice.options,
    )
    return make_respondent(choice.use, setup)


def question(instrument: Instrument, item: Item) -> Question:
    """Return an item as a respondent gets to know it."""
    return Question(
        instrument=instrument.name,
        item=item.id,
        points=instrument.points,
        text=item.text,
        anchors=instrument.anchors,
        answer=item.answer,
        lowest=item.lowest,
        highest=item.highest,
        step=item.step,
        ends=item.ends,
    )
