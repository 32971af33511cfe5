"""A live study: who takes part next, which sessions are under way, and what is kept of them."""

import contextlib
import itertools
import json
import os
import secrets
import shutil
import sqlite3
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

from harness.live.tokens import ROLES, Tokens
from harness.live.visit import Visit
from harness.live.visitors import visitors_of
from harness.running.sessions import world_of
from harness.session.study_run import StudyRun, portable
from harness.world.world import World
from protocols.allocation import Allocation, Enrolled, State, next_allocation
from protocols.files.errors import InputError
from protocols.record.atomic import write_whole
from protocols.record.enrolment import (
    WITHDRAWN,
    enrolled,
    purged,
    read_allocations,
    state_of,
    write_allocations,
)
from protocols.record.folder import REPORT
from protocols.record.header import StudyHeader
from protocols.record.journal import JOURNALS, journal_path
from protocols.record.rows import participant_id, participant_number
from protocols.record.session import SessionRecord, encode
from protocols.record.sessions import SESSIONS, SET_ASIDE
from protocols.record.store import (
    build_tables,
    clear_failure,
    open_folder,
    whole_sessions,
    write_failure,
    write_session,
)

IDENTITIES = "identities.sqlite"
"""In the private folder beside a study: platforms' ids; it is there only where there are any."""
REVOKED = "revoked.json"
"""There, too: the names of links that open nothing any more."""


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a live study is.

    Attributes
    ----------
    planned
        Participants wanted whose sessions can be used.
    people
        Everyone enrolled so far, and what became of them.
    active
        Participants whose session is under way in this process.
    """

    planned: int
    people: tuple[Enrolled, ...]
    active: tuple[str, ...]

    @property
    def finished(self) -> tuple[str, ...]:
        """Participants whose session can be used."""
        return tuple(person.participant for person in self.people if person.state == "usable")


class LiveStudy:
    """Runs the visits of one study; at most ``seats`` at a time.

    Parameters
    ----------
    run
        The study and its seed.
    folder
        The study directory; this process holds its lock.
    seats
        How many sessions may be under way at a time.
    lockstep
        As for ``Visit``.
    on_change
        Called, on any thread, when a session begins or ends.
    """

    def __init__(
        self,
        run: StudyRun,
        folder: Path,
        seats: int = 1,
        *,
        lockstep: bool = False,
        on_change: Callable[[], None] = lambda: None,
    ) -> None:
        self.folder, self.seats = folder, seats
        run = portable(run)
        header: StudyHeader = open_folder(folder, run.study, run.seed, "live")
        self.run = replace(run, digest=header.digest)
        (folder / JOURNALS).mkdir(exist_ok=True)
        self.private = private_folder(folder)
        self.tokens = Tokens(_secret(self.private), _revoked(self.private))
        self._lockstep, self._on_change = lockstep, on_change
        self._lock = threading.RLock()
        self.visits: dict[str, Visit] = {}
        begun = [path.stem for path in (folder / JOURNALS).glob("*.jsonl")]
        whole = whole_sessions(folder, header.digest)
        self._people = {e.participant: e for e in enrolled(folder, {*begun, *whole})}
        self.allocations = read_allocations(folder)
        self._make_world = _one_world_at_a_time()

    @property
    def planned(self) -> int:
        """Participants wanted."""
        return self.run.study.protocol.cohort.participants

    def progress(self) -> Progress:
        """Return how far the study is."""
        with self._lock:
            people = tuple(self._people.values())
        active = tuple(name for name, visit in tuple(self.visits.items()) if not visit.over)
        return Progress(self.planned, people, active)

    @property
    def over(self) -> bool:
        """Whether every participant wanted has taken part, and no one is under way."""
        progress = self.progress()
        if visitors_of(self.run).participant:
            return not progress.active and len(progress.finished) >= self.planned
        return not progress.active and len(progress.people) >= self.planned

    def resume(self) -> None:
        """Go on with every session that an earlier process left unfinished."""
        for name in sorted(purged(self.folder)):
            if self._of(name):  # the program was stopped while it deleted
                self.purge(name)
                build_tables(self.folder, self.run.digest)
        for person in self.progress().people:
            begun = journal_path(self.folder, person.participant).is_file()
            if begun and person.state == "under way":
                self._begin(participant_number(person.participant), person.slot)

    def enrol(self) -> Visit | None:
        """Begin the next participant's session; None when there is no seat or no one is wanted.

        The slot, and with it order and group, is decided here and not before. The slots of living
        people who withdrew or were excluded are given again.
        """
        with self._lock:
            given = self.next_allocation()
            if given is None or len(self.progress().active) >= self.seats:
                return None
            name = self.next_participant()
            self.allocations[name] = given
            write_allocations(self.folder, self.allocations)
            self._people[name] = Enrolled(name, given.slot, "under way")
            visit = self._begin(participant_number(name), given.slot)
        visit.event("program", "allocated", f"slot {given.slot}: {given.reason}")
        return visit

    def next_participant(self) -> str:
        """Return the id of whoever is enrolled next."""
        ids = (participant_id(n) for n in itertools.count(1))
        return next(name for name in ids if name not in self._people)

    def next_allocation(self) -> Allocation | None:
        """Return the slot of whoever is enrolled next; None when no one more is wanted."""
        people = self.progress().people
        left = ("withdrawn", "excluded") if visitors_of(self.run).participant else ()
        if sum(person.state not in left for person in people) >= self.planned:
            return None
        return next_allocation(people)

    def without_participants(self) -> None:
        """Begin sessions whose participants are simulated: no link has to be opened for them."""
        if not visitors_of(self.run).participant:
            while self.enrol() is not None:
                pass

    def identify(self, participant: str, ids: Mapping[str, str]) -> None:
        """Keep a recruitment platform's ids apart from the study."""
        wanted = self.run.study.protocol.live.id_parameters
        kept = {name: value for name, value in ids.items() if name in wanted}
        if kept:
            with (
                contextlib.closing(sqlite3.connect(self.private / IDENTITIES)) as database,
                database,
            ):
                database.execute("create table if not exists ids (participant, name, value)")
                rows = [(participant, name, value) for name, value in kept.items()]
                database.executemany("insert into ids values (?, ?, ?)", rows)

    def revoke(self, *nonces: str) -> None:
        """Have tokens allow nothing any more, after a restart too."""
        for nonce in nonces:
            self.tokens.revoke(nonce)
        content = json.dumps(self.tokens.revoked).encode()
        write_whole(self.private / REVOKED, content)

    def new_links(self) -> None:
        """Have the links that were printed so far open nothing any more."""
        standing = [self.tokens.read(self.tokens.link(role)) for role in ROLES.values()]
        self.revoke(*(grant.nonce for grant in standing if grant is not None))

    def purge(self, participant: str) -> None:
        """Delete every byte of a participant's data; a file with the number and date stays.

        A report that was made before has them in its tables and figures: it is deleted, too.
        """
        with self._lock:
            (self.folder / WITHDRAWN).mkdir(exist_ok=True)
            text = {"participant": participant, "purged": datetime.now(UTC).date().isoformat()}
            write_whole(self.folder / WITHDRAWN / f"{participant}.json", json.dumps(text).encode())
            # Files last: what is left of them makes a program that was stopped here purge again.
            self._forget(participant)
            self.revoke(seat_nonce(participant))
            shutil.rmtree(self.folder / REPORT, ignore_errors=True)
            for path in self._of(participant):
                shutil.rmtree(path) if path.is_dir() else path.unlink()
            clear_failure(self.folder, participant)
            if participant in self._people:
                person = self._people[participant]
                self._people[participant] = replace(person, state="withdrawn")
            build_tables(self.folder, self.run.digest)

    def _of(self, participant: str) -> list[Path]:
        """Return the files and folders that hold something of a participant."""
        own = [
            self.folder / SESSIONS / participant,
            journal_path(self.folder, participant),
            *(self.folder / SET_ASIDE).glob(f"{participant}-*"),
        ]
        return [path for path in own if path.exists()]

    def _forget(self, participant: str) -> None:
        path = self.private / IDENTITIES
        if path.exists():
            with contextlib.closing(sqlite3.connect(path)) as database, database:
                database.execute("pragma secure_delete = on")  # else the bytes stay in the file
                database.execute("delete from ids where participant = ?", (participant,))

    def close(self) -> None:
        """Hold every session that is under way: the same command resumes it from its journal."""
        for visit in self.visits.values():
            if not visit.over:
                visit.pause("program", "the program was stopped")

    def _begin(self, number: int, slot: int) -> Visit:
        name = participant_id(number)
        visit = Visit(
            replace(self.run, slot=slot), number, journal_path(self.folder, name), self._make_world,
            finish=self._finished, fail=self._failed, lockstep=self._lockstep,
        )  # fmt: skip
        self.visits[name] = visit
        visit.start()
        self._on_change()
        return visit

    def _finished(self, visit: Visit, record: SessionRecord) -> None:
        row, ends = record.participant, [lap.row.end_reason for lap in record.laps]
        gone = "withdrew" in ends or visit.participant.withdrawal() is not None
        state: State = "withdrawn"
        with self._lock:
            if not row.consented or (gone and self.purges):
                self.purge(visit.name)
            else:
                files = encode(record, self.run.digest)
                write_session(self.folder, visit.name, files, keep_damaged=True)
                build_tables(self.folder, self.run.digest)
                state = state_of(row.laps_planned, ends, excluded=row.excluded)
            self._people[visit.name] = replace(self._people[visit.name], state=state)
        self._on_change()

    @property
    def purges(self) -> bool:
        """Whether the data of a participant who stops are deleted."""
        return self.run.study.protocol.live.withdrawal == "purge"

    def _failed(self, visit: Visit, trace: str) -> None:
        write_failure(self.folder, visit.name, trace)
        self._on_change()


def seat_nonce(participant: str) -> str:
    """Return the name of the token by which a participant's browser finds its seat again."""
    return f"seat-{participant}"


def private_folder(folder: Path) -> Path:
    """Return the folder beside a study directory that is not part of it; only the owner reads it.

    Raises
    ------
    InputError
        When it cannot be made.
    """
    private = folder.with_name(f"{folder.name}.private")
    try:
        private.mkdir(mode=0o700, exist_ok=True)
    except OSError as error:
        raise InputError(f"{private}: cannot be made: {error.strerror}") from None
    return private


def _secret(private: Path) -> bytes:
    """Return the secret that links are signed with; the same after a restart."""
    path = private / "links.key"
    if not path.exists():
        descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(secrets.token_bytes(32))
    return path.read_bytes()


def _revoked(private: Path) -> tuple[str, ...]:
    """Return the names of the tokens that an earlier process revoked."""
    path = private / REVOKED
    if not path.exists():
        return ()
    try:
        return tuple(map(str, json.loads(path.read_bytes())))
    except (ValueError, TypeError):
        raise InputError(
            f"{path}: damaged; allowed: a list of names in JSON, or no such file and --new-links"
        ) from None


def _one_world_at_a_time() -> Callable[[StudyRun], World]:
    """Return a function that makes a world of its own for each session, of its study's course."""
    making = threading.Lock()

    def make(run: StudyRun) -> World:
        with making:  # PyBullet's loading of files is not meant for several threads
            return world_of(run, shared=False)

    return make
