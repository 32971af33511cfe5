"""A session from its journal: people give again what they gave, as far as the journal goes."""

from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from harness.session.clock import Clock, LapStoppedError, Timing
from harness.session.lap import LapParts
from harness.session.parts import SessionParts, draw_person, session_model
from harness.session.session import Session
from harness.session.study_run import StudyRun, of_one
from harness.world.world import World
from lad.assistant import NO_ASSISTANCE, Assistance, Assistant
from lad.command import Command
from participants.demonstrator import Demonstrator
from participants.driver import Driver, WithdrewError
from participants.pages import Page, PageReader
from participants.sight import Sight
from participants.survey import Answer, LapExperience, Question, Respondent, response_times_of
from participants.telemetry import telemetry_of
from protocols.files.errors import InputError
from protocols.record.journal import Entry, RecordedJournal, journal_header, refuse_other_journal
from protocols.record.rows import EventRow, participant_id
from protocols.record.session import SessionRecord

ENDS_HERE = "the journal ends here"


class Entries(Protocol):
    """What is left of a journal."""

    @property
    def left(self) -> deque[Entry]:
        """Entries that the session has not come to yet; the part that applies one removes it."""


class UnfitEntryError(Exception):
    """The journal's next entry is not what the session comes to."""


def replay(
    journal: RecordedJournal,
    run: StudyRun,
    number: int,
    world: World,
    models: Mapping[str, Assistant] = MappingProxyType({}),
) -> SessionRecord:
    """Return the record of a session from what was applied in it.

    An unfinished journal gives the record up to its end: the lap under way ends as interrupted,
    and nothing follows it. Only the model answers again; people's inputs come from the journal.

    Parameters
    ----------
    journal
        As it was read.
    run, number
        The study and the participant it is of.
    world
        Of the study's course.
    models
        Those that others have taught, by the protocol's names for them.

    Raises
    ------
    InputError
        When the journal is another session's, does not fit the session's stages, or the study's
        model cannot be made.
    """
    refuse_other_journal(journal, journal_header(run.study, run.seed, participant_id(number)))
    entries = ReadEntries(journal.entries)
    parts = replace(parts_to_replay(entries, run, number, journal.header.kind), models=models)
    session = Session(
        run, number, world, parts,
        clock=ReplayedClock(entries, None), journal=entries,
        repeats=lambda _: is_next(entries, "repeat"),
    )  # fmt: skip
    try:
        return replace(session.run(), events=events_of(journal))
    except UnfitEntryError as error:
        line = len(journal.entries) - len(entries.left) + 2
        raise InputError(f"{journal.path}:{line}: {error}") from None


def parts_to_replay(entries: "Entries", run: StudyRun, number: int, kind: str) -> SessionParts:
    """Return parts that take everything from a journal but the model's answers."""
    run = of_one(run, number)
    cohort, person = run.study.protocol.cohort, draw_person(run, number)
    demonstrator = None if cohort.demonstrator is None else ReplayedDemonstrator(entries, None)
    return SessionParts(
        person=person.living() if kind == "live" else person,
        lap=LapParts(ReplayedDriver(entries, kind, None), demonstrator, session_model(run, number)),
        respondent=None if cohort.respondent is None else ReplayedRespondent(entries, None),
        reader=ReplayedReader(entries, None),
        demonstrators={
            name: ReplayedDemonstrator(entries, None) for name in run.study.protocol.demonstrators
        },
    )


def events_of(journal: RecordedJournal) -> tuple[EventRow, ...]:
    """Return the events that a journal holds."""
    found = (entry["event"] for entry in journal.entries if "event" in entry)
    return tuple(EventRow(participant=journal.header.participant, **event) for event in found)


class ReadEntries:
    """A journal's entries; as the journal of a session, it takes as read what it is told."""

    def __init__(self, entries: Iterable[Entry]) -> None:
        self.left = deque(entry for entry in entries if "event" not in entry)

    def stage(self, index: int, kind: str, lap: int | None) -> None:
        """Take a stage's entry."""
        if next_entry(self, "stage") != [index, kind, lap]:
            raise UnfitEntryError(
                f"the session comes to stage {index} ({kind}), the journal to {self.left[0]}"
            )
        self._take()

    def tick(self, *_: object) -> None:
        """Take a step's entry."""
        self._take()

    def broken_off(self, *_: object) -> None:
        """Take the entry of a lap's end."""
        self._take()

    def answers(self, *_: object) -> None:
        """Take a questionnaire's entry."""
        self._take()

    def page(self, *_: object) -> None:
        """Take a page's entry."""
        self._take()

    def repeated(self) -> None:
        """Take the entry of a repeated lap."""
        self._take()

    def _take(self) -> None:
        if self.left:
            self.left.popleft()


def next_entry(entries: Entries, key: str) -> Any:
    """Return the next entry's value, and leave the entry there.

    Raises
    ------
    LapStoppedError
        When there is none.
    UnfitEntryError
        When it is of another kind.
    """
    if not entries.left:
        raise LapStoppedError("interrupted", ENDS_HERE)
    if key not in entries.left[0]:
        found = ", ".join(entries.left[0])
        raise UnfitEntryError(f"the session comes to {key!r}, the journal to {found!r}")
    return entries.left[0][key]


def is_next(entries: Entries, key: str) -> bool:
    """Tell whether the journal's next entry is of a kind."""
    return bool(entries.left) and key in entries.left[0]


class ReplayedDriver:
    """A driver from the journal, then the driver itself.

    Parameters
    ----------
    entries
        What is left of the journal.
    kind
        What the driver is.
    then
        Drives on when the journal is at its end; None for nothing to follow.
    """

    def __init__(self, entries: Entries, kind: str, then: Driver | None) -> None:
        self._entries, self._then = entries, then
        self.kind = kind

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        """Get ready; a person is asked only for a lap that the journal does not know."""
        if self._then is not None and not self._entries.left:
            self._then.start_lap(lap, rng)

    def act(self, sight: Sight) -> Command | None:
        """Return the command that was given."""
        if self._then is not None and not self._entries.left:
            return self._then.act(sight)
        if is_next(self._entries, "end"):
            reason, note = next_entry(self._entries, "end")
            if reason == "withdrew":
                raise WithdrewError(note or "")
            raise LapStoppedError(reason, note)
        given = next_entry(self._entries, "tick").get("u")
        return None if given is None else Command(*given)

    def telemetry(self) -> Mapping[str, Any]:
        """Return what the links said: the driver's and the demonstrator's are one entry."""
        if self._entries.left:
            told: Mapping[str, Any] = self._entries.left[0].get("tick", {}).get("x", {})
            return told
        link = telemetry_of(self._then)
        return {} if link is None else link()


class ReplayedDemonstrator:
    """A demonstrator from the journal, then the demonstrator itself; as for the driver."""

    def __init__(self, entries: Entries, then: Demonstrator | None) -> None:
        self._entries, self._then = entries, then

    def start_lap(self) -> None:
        """Watch a new lap."""
        if self._then is not None:
            self._then.start_lap()

    def look(self, sight: Sight) -> None:
        """See the room."""
        if self._then is not None:
            self._then.look(sight)

    def assist(self, x: NDArray[np.float64]) -> Assistance:
        """Return the help that was given."""
        if self._then is not None and not self._entries.left:
            return self._then.assist(x)
        helping, *command = next_entry(self._entries, "tick").get("d", [0])
        if not helping:
            return NO_ASSISTANCE
        return Assistance(helping=True, command=Command(*command) if command else None)

    def telemetry(self) -> Mapping[str, Any]:
        """Return what the link says; while replaying, the driver's entry has it."""
        link = None if self._entries.left else telemetry_of(self._then)
        return {} if link is None else link()


class ReplayedClock:
    """The clock's readings from the journal, then the clock itself.

    Parameters
    ----------
    entries
        What is left of the journal.
    then
        Goes on from where the journal ends; None for nothing to follow.
    before
        Called once before it goes on in the middle of a lap: people come back to it.
    """

    def __init__(
        self,
        entries: Entries,
        then: Clock | None,
        before: Callable[[], None] = lambda: None,
    ) -> None:
        self._entries, self._then, self._before = entries, then, before
        self._replaying = True

    def start(self, t: float = 0.0) -> Timing | None:
        """Return the first step's timing."""
        if self._then is not None and not self._entries.left:
            self._replaying = False
            return self._then.start(t)
        return self._told()

    def wait_until(self, t: float) -> Timing | None:
        """Return the next step's timing."""
        if self._then is None or self._entries.left:
            return self._told()
        if self._replaying:
            self._replaying = False
            self._before()
            return self._then.start(t)
        return self._then.wait_until(t)

    def _told(self) -> Timing | None:
        is_tick = is_next(self._entries, "tick")
        given = next_entry(self._entries, "tick").get("t") if is_tick else None
        return None if given is None else Timing(*given)


class ReplayedRespondent:
    """Answers from the journal, then the respondent itself."""

    def __init__(self, entries: Entries, then: Respondent | None) -> None:
        self._entries, self._then = entries, then

    def answer(
        self, questions: Sequence[Question], experience: LapExperience, rng: np.random.Generator
    ) -> tuple[Answer, ...]:
        """Return the answers that were given."""
        if self._then is not None and not self._entries.left:
            return self._then.answer(questions, experience, rng)
        given = tuple(next_entry(self._entries, "answers"))
        if len(given) != len(questions):
            raise UnfitEntryError(f"{len(given)} answers to {len(questions)} questions")
        return given

    def response_times(self) -> tuple[float | None, ...] | None:
        """Return how long each of these answers took; None where that is not known."""
        if is_next(self._entries, "answers"):
            seconds = self._entries.left[0].get("seconds")
            return None if seconds is None else tuple(seconds)
        return response_times_of(self._then)


class ReplayedReader:
    """Pages from the journal, then the reader itself."""

    def __init__(self, entries: Entries, then: PageReader | None) -> None:
        self._entries, self._then = entries, then

    def read(self, page: Page) -> Mapping[str, Answer]:
        """Return what was entered."""
        if self._then is not None and not self._entries.left:
            return self._then.read(page)
        kind, entered = next_entry(self._entries, "page")
        if kind != page.kind:
            raise UnfitEntryError(f"the session comes to page {page.kind}, the journal to {kind}")
        return dict(entered)
