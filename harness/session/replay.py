"""A session from its journal alone, without its people."""

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.session.clock import LapStoppedError, Timing
from harness.session.lap import LapParts
from harness.session.parts import SessionParts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.world import World
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from participants.driver import Driver, WithdrewError, kind_of
from participants.pages import Page
from participants.sight import Sight
from participants.survey import Answer, LapExperience, Question
from protocols.files.errors import InputError
from protocols.record.journal import Entry, RecordedJournal, journal_header, refuse_other_journal
from protocols.record.rows import participant_id
from protocols.record.session import SessionRecord

ENDS_HERE = "the journal ends here"


def replay(
    journal: RecordedJournal, run: StudyRun, number: int, world: World, parts: SessionParts
) -> SessionRecord:
    """Return the record of a session from what was applied in it.

    An unfinished journal gives the record up to its end: the lap under way ends as interrupted,
    and nothing follows it.

    Parameters
    ----------
    journal
        As it was read.
    run, number
        The study and the participant it is of.
    world
        Of the study's course.
    parts
        Those of the session. Only the model answers again, and the driver's kind is taken from
        them; people's inputs come from the journal.

    Raises
    ------
    InputError
        When the journal is another session's, or does not fit the session's stages.
    """
    refuse_other_journal(journal, journal_header(run.study, run.seed, participant_id(number)))
    entries = Entries(journal.entries)
    demonstrator = None if parts.lap.demonstrator is None else _Demonstrator(entries)
    replayed = SessionParts(
        person=parts.person,
        lap=LapParts(_Driver(entries, parts.lap.driver), demonstrator, parts.lap.model),
        respondent=None if parts.respondent is None else _Respondent(entries),
        reader=_Reader(entries),
        models=parts.models,
    )
    session = Session(run, number, world, replayed, clock=_Clock(entries), journal=entries)
    try:
        return session.run()
    except _UnfitEntryError as error:
        line = len(journal.entries) - len(entries.left) + 2
        raise InputError(f"{journal.path}:{line}: {error}") from None


class _UnfitEntryError(Exception):
    """The journal's next entry is not the one that the session needs."""


class Entries:
    """A journal's entries, read one by one; as the session's journal, it skips each entry."""

    def __init__(self, entries: Iterable[Entry]) -> None:
        self.left = deque(entries)

    def next(self, key: str) -> Any:
        """Return the next entry's value, and leave it there.

        Raises
        ------
        LapStoppedError
            When there is no further entry.
        """
        if not self.left:
            raise LapStoppedError("interrupted", ENDS_HERE)
        if key not in self.left[0]:
            found = ", ".join(self.left[0])
            raise _UnfitEntryError(f"the session comes to {key!r}, the journal to {found!r}")
        return self.left[0][key]

    def has(self, key: str) -> bool:
        """Return whether the next entry is of this kind."""
        return bool(self.left) and key in self.left[0]

    def stage(self, index: int, kind: str, lap: int | None) -> None:
        """Take a stage's entry."""
        if self.next("stage") != [index, kind, lap]:
            raise _UnfitEntryError(
                f"the session comes to stage {index} ({kind}), the journal to {self.next('stage')}"
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

    def _take(self) -> None:
        if self.left:
            self.left.popleft()


class _Driver:
    def __init__(self, entries: Entries, driver: Driver) -> None:
        self._entries = entries
        self.kind = kind_of(driver)

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        pass

    def act(self, sight: Sight) -> Command | None:  # noqa: ARG002  # the seam's
        if self._entries.has("end"):
            reason, note = self._entries.next("end")
            raise (
                WithdrewError(note or "") if reason == "withdrew" else LapStoppedError(reason, note)
            )
        given = self._entries.next("tick").get("u")
        return None if given is None else Command(*given)


class _Demonstrator:
    def __init__(self, entries: Entries) -> None:
        self._entries = entries

    def start_lap(self) -> None:
        pass

    def assist(self, x: NDArray[np.float64]) -> Assistance:  # noqa: ARG002  # the seam's
        helping, *command = self._entries.next("tick").get("d", [0])
        if not helping:
            return NO_ASSISTANCE
        return Assistance(helping=True, command=Command(*command) if command else None)


class _Clock:
    def __init__(self, entries: Entries) -> None:
        self._entries = entries

    def start(self, t: float = 0.0) -> Timing | None:
        return self.wait_until(t)

    def wait_until(self, t: float) -> Timing | None:  # noqa: ARG002  # the seam's
        given = self._entries.next("tick").get("t") if self._entries.has("tick") else None
        return None if given is None else Timing(*given)


class _Respondent:
    def __init__(self, entries: Entries) -> None:
        self._entries = entries

    def answer(
        self,
        questions: Sequence[Question],
        experience: LapExperience,  # noqa: ARG002  # the seam's
        rng: np.random.Generator,  # noqa: ARG002  # the seam's
    ) -> tuple[Answer, ...]:
        given = tuple(self._entries.next("answers"))
        if len(given) != len(questions):
            raise _UnfitEntryError(f"{len(given)} answers to {len(questions)} questions")
        return given


class _Reader:
    def __init__(self, entries: Entries) -> None:
        self._entries = entries

    def read(self, page: Page) -> Mapping[str, Answer]:
        kind, entered = self._entries.next("page")
        if kind != page.kind:
            raise _UnfitEntryError(f"the session comes to page {page.kind}, the journal to {kind}")
        return dict(entered)
