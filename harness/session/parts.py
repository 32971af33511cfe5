"""What takes part in one session: the person, and every part that the protocol names."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from harness.session.lap import LapParts
from harness.session.model import make_model
from harness.session.seeds import generator
from harness.session.study_run import StudyRun, of_one
from lad.assistant import Assistant
from participants.cohort import Person
from participants.cohort import draw_person as drawn_from_cohort
from participants.demonstrator import Demonstrator
from participants.driver import Driver
from participants.live.pages import LiveReader
from participants.live.seat import Seat
from participants.pages import PageReader, SimulatedReader
from participants.registry import make_demonstrator, make_driver, make_impaired, make_respondent
from participants.setup import DemonstratorSetup, DriverSetup, ImpairmentSetup, RespondentSetup
from participants.sight import Sight
from participants.survey import Question, Respondent
from protocols.cohort import DemonstratorChoice, ImpairmentChoice
from protocols.files.errors import InputError
from protocols.groups import Group
from protocols.instrument import Instrument, Item
from protocols.order import laps_of
from protocols.record.rows import participant_id
from protocols.shipped_parts import LIVE, Role, shipped_factory


@dataclass(frozen=True, slots=True)
class SessionParts:
    """What a session is given from outside.

    Attributes
    ----------
    person
        The participant.
    lap
        Driver, demonstrator and model.
    respondent
        Answers the questionnaires; None for a study without one.
    reader
        Reads the pages beside laps and questionnaires.
    models
        Models that others have taught, by the protocol's names for them.
    demonstrators
        Further demonstrators, by the protocol's names for them.
    """

    person: Person
    lap: LapParts
    respondent: Respondent | None
    reader: PageReader
    models: Mapping[str, Assistant] = field(default_factory=dict)
    demonstrators: Mapping[str, Demonstrator] = field(default_factory=dict)


def make_every_part(run: StudyRun, *, only_shipped: bool = False) -> None:
    """Make each part of the first session once, so that a mistake shows before anything runs.

    Parameters
    ----------
    run
        The study.
    only_shipped
        Whether to leave out the parts whose code is not ours, and living people.

    Raises
    ------
    InputError
        When a driver, demonstrator, model or respondent cannot be made; with its place in the
        protocol file.
    """
    cohort, protocol = run.study.protocol.cohort, run.study.protocol
    with _placed(run, "cohort.traits"):
        person = draw_person(run, 1)

    def wanted(role: Role, use: str) -> bool:
        return not only_shipped or (use != LIVE and shipped_factory(role, use) is not None)

    driver: Driver = _Nobody()
    if wanted("driver", cohort.driver.use):
        with _placed(run, "cohort.driver.options"):
            driver = _driver_alone(run, 1, person)
    for i, impairment in enumerate(cohort.impairments):
        if wanted("impairment", impairment.use):
            with _placed(run, f"cohort.impairments[{i}]"):
                _impaired(run, 1, impairment, driver)
    if cohort.demonstrator is not None and wanted("demonstrator", cohort.demonstrator.use):
        with _placed(run, "cohort.demonstrator.options"):
            _demonstrator(run, 1)
    _make_further_demonstrators(run, wanted)
    if wanted("model", protocol.model.use):
        with _placed(run, "model"):
            session_model(run, 1)
    if cohort.respondent is not None and wanted("respondent", cohort.respondent.use):
        with _placed(run, "cohort.respondent"):
            _respondent(run, 1, person)
    for name, group in protocol.groups.items():
        _make_parts_of_group(run, name, group, wanted)


def _make_further_demonstrators(run: StudyRun, wanted: Callable[[Role, str], bool]) -> None:
    """Make the demonstrators beside the cohort's."""
    for name, choice in run.study.protocol.demonstrators.items():
        if wanted("demonstrator", choice.use):
            with _placed(run, f"demonstrators.{name}.options"):
                _chosen_demonstrator(run, 1, choice, f"demonstrator {name}")


def _make_parts_of_group(
    run: StudyRun, name: str, group: Group, wanted: Callable[[Role, str], bool]
) -> None:
    """Make what is different for a group."""
    own = _as_group(run, name, group)
    if group.course is not None and wanted("driver", run.study.protocol.cohort.driver.use):
        with _placed(run, f"groups.{name}.course"):
            _driver_alone(own, 1, draw_person(run, 1))
    if group.model is not None and wanted("model", group.model.use):
        with _placed(run, f"groups.{name}.model"):
            session_model(own, 1)
    if group.demonstrator is not None and wanted("demonstrator", group.demonstrator.use):
        with _placed(run, f"groups.{name}.demonstrator"):
            _demonstrator(own, 1)


class _Nobody:
    """Stands where a driver is that is not made."""

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Do nothing."""

    def act(self, sight: Sight) -> None:
        """Give no command."""


@contextmanager
def _placed(run: StudyRun, where: str) -> Iterator[None]:
    """Say of a fault where in the protocol file its cause is."""
    try:
        yield
    except InputError as error:
        place = run.study.at(where)
        raise InputError(*(f"{place}{fault}" for fault in error.faults)) from error


def _as_group(run: StudyRun, name: str, group: Group) -> StudyRun:
    """Return the study with the model, the demonstrator and the course of a group."""
    protocol = run.study.protocol
    changes: dict[str, object] = {"model": group.model or protocol.model, "groups": {}}
    if group.demonstrator is not None:
        update = {"demonstrator": group.demonstrator}
        changes["cohort"] = protocol.cohort.model_copy(update=update)
    course = run.study.group_courses.get(name, run.study.course)
    protocol = protocol.model_copy(update=changes)
    return replace(run, study=replace(run.study, protocol=protocol, course=course))


def draw_person(run: StudyRun, number: int) -> Person:
    """Return a synthetic participant, the same person in every run."""
    return drawn_from_cohort(run.study.protocol.cohort, generator(run.seed, number, "person"))


@dataclass(frozen=True, slots=True)
class Seats:
    """Where living people sit; None where nobody living does."""

    participant: Seat | None = None
    demonstrator: Seat | None = None


NO_SEATS = Seats()


def make_parts(
    run: StudyRun, number: int, person: Person | None = None, seats: Seats = NO_SEATS
) -> SessionParts:
    """Return what takes part in a participant's session.

    Parameters
    ----------
    run, number
        The study and the participant, counted from 1.
    person
        Who it is; None for the synthetic person that the seed draws.
    seats
        Where living people sit.

    Raises
    ------
    InputError
        When a part that the protocol names cannot be made.
    """
    run = of_one(run, number)
    whose = draw_person(run, number) if person is None else person
    if run.study.protocol.cohort.driver.use == LIVE:
        whose = whose.living()
    return SessionParts(
        person=whose,
        lap=LapParts(
            driver=_driver(run, number, whose, seats.participant),
            demonstrator=_demonstrator(run, number, seats.demonstrator),
            model=session_model(run, number),
        ),
        respondent=_respondent(run, number, whose, seats.participant),
        reader=SimulatedReader(whose.particulars())
        if seats.participant is None
        else LiveReader(seats.participant),
        demonstrators={
            name: _chosen_demonstrator(run, number, choice, f"demonstrator {name}")
            for name, choice in run.study.protocol.demonstrators.items()
        },
    )


def _driver(run: StudyRun, number: int, person: Person, seat: Seat | None) -> Driver:
    """Return the driver, with the person's impairment around it if the person has one."""
    driver, impairment = _driver_alone(run, number, person, seat), person.impairment
    return driver if impairment is None else _impaired(run, number, impairment, driver)


def _driver_alone(run: StudyRun, number: int, person: Person, seat: Seat | None = None) -> Driver:
    choice = run.study.protocol.cohort.driver
    setup = DriverSetup(
        course=run.study.course,
        rng=generator(run.seed, number, "driver"),
        traits=person.traits,
        options=choice.options,
        folder=run.study.folder,
        seat=seat,
    )
    return make_driver(choice.use, setup, run.study.code)


def _impaired(run: StudyRun, number: int, impairment: ImpairmentChoice, driver: Driver) -> Driver:
    rng = generator(run.seed, number, "impairment")
    around = ImpairmentSetup(driver, impairment.severity, rng, impairment.options)
    return make_impaired(impairment.use, around, run.study.code)


def _demonstrator(run: StudyRun, number: int, seat: Seat | None = None) -> Demonstrator | None:
    choice = run.study.protocol.cohort.demonstrator
    return None if choice is None else _chosen_demonstrator(run, number, choice, seat=seat)


def _chosen_demonstrator(
    run: StudyRun,
    number: int,
    choice: DemonstratorChoice,
    drawn_as: str = "demonstrator",
    seat: Seat | None = None,
) -> Demonstrator:
    """Return one demonstrator, with random numbers of the name ``drawn_as``."""
    rng = generator(run.seed, number, drawn_as)
    setup = DemonstratorSetup(run.study.course, rng, choice.options, seat)
    return make_demonstrator(choice.use, setup, run.study.code)


def session_model(run: StudyRun, number: int) -> Assistant:
    """Return the model of a participant's session."""
    folder = str(run.study.folder or Path())
    words = {"participant": participant_id(number), "folder": folder}
    return make_model(run.study.protocol.model, words, run.study.code)


def _respondent(
    run: StudyRun, number: int, person: Person, seat: Seat | None = None
) -> Respondent | None:
    study, choice = run.study, run.study.protocol.cohort.respondent
    if choice is None:
        return None
    laps = laps_of(study.protocol, run.slot_of(number), run.seed)
    asked = [pair for planned in laps for pair in study.questions(planned)]
    asked += study.session_questions
    setup = RespondentSetup(
        questions=tuple(dict.fromkeys(question(*pair) for pair in asked)),
        rng=generator(run.seed, number, "respondent"),
        style=person.style,
        options=choice.options,
        seat=seat,
    )
    return make_respondent(choice.use, setup, study.code)


def question(instrument: Instrument, item: Item) -> Question:
    """Return an item as a respondent reads it."""
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
        expected=item.expected,
    )
