"""A live study: who takes part next, which sessions are under way, and what is kept of them."""

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
from typing import Any

from harness.live.tokens import Tokens
from harness.live.visit import Visit, visitors_of
from harness.running.sessions import world_of
from harness.session.study_run import StudyRun, portable
from harness.world.world import World
from protocols.files.errors import InputError
from protocols.record.atomic import write_whole
from protocols.record.header import StudyHeader
from protocols.record.journal import JOURNALS, journal_path
from protocols.record.rows import participant_id
from protocols.record.session import SessionRecord, encode
from protocols.record.sessions import SESSIONS
from protocols.record.store import (
    build_tables,
    open_folder,
    whole_sessions,
    write_failure,
    write_session,
)

WITHDRAWN = "withdrawn"
"""Folder of a study directory with a file for each participant whose data were purged."""


@dataclass(frozen=True, slots=True)
class Progress:
    """How far a live study is.

    Attributes
    ----------
    planned
        Participants wanted.
    finished
        Participants whose session is whole.
    active
        Participants whose session is under way.
    """

    planned: int
    finished: tuple[str, ...]
    active: tuple[str, ...]


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
        for name in run.study.group_courses:
            place = run.study.at(f"groups.{name}.course")
            raise InputError(
                f"{place}living participants all drive one course; allowed: no course in a group"
            )
        self.folder, self.seats = folder, seats
        run = portable(run)
        header: StudyHeader = open_folder(folder, run.study, run.seed, "live")
        self.run = replace(run, digest=header.digest)
        (folder / JOURNALS).mkdir(exist_ok=True)
        self.private = private_folder(folder)
        self.tokens = Tokens(_secret(self.private))
        self._lockstep, self._on_change = lockstep, on_change
        self._lock = threading.Lock()
        self.visits: dict[str, Visit] = {}
        self._make_world = _one_world_at_a_time(self.run)

    @property
    def planned(self) -> int:
        """Participants wanted."""
        return self.run.study.protocol.cohort.participants

    def progress(self) -> Progress:
        """Return how far the study is."""
        finished = whole_sessions(self.folder, self.run.digest)
        active = tuple(name for name, visit in self.visits.items() if not visit.over)
        return Progress(self.planned, finished, active)

    def resume(self) -> None:
        """Go on with every session that an earlier process left unfinished."""
        whole = set(whole_sessions(self.folder, self.run.digest))
        for number in range(1, self.planned + 1):
            name = participant_id(number)
            if journal_path(self.folder, name).is_file() and name not in whole:
                self._begin(number)

    def enrol(self) -> Visit | None:
        """Begin the next participant's session; None when there is no seat or no one is wanted."""
        with self._lock:
            active = [visit for visit in self.visits.values() if not visit.over]
            if len(active) >= self.seats:
                return None
            taken = set(self._taken())
            free = (n for n in range(1, self.planned + 1) if participant_id(n) not in taken)
            number = next(free, None)
            return None if number is None else self._begin(number)

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
            with sqlite3.connect(self.private / "identities.sqlite") as database:
                database.execute("create table if not exists ids (participant, name, value)")
                rows = [(participant, name, value) for name, value in kept.items()]
                database.executemany("insert into ids values (?, ?, ?)", rows)

    def purge(self, participant: str) -> None:
        """Delete every byte of a participant's data; a file with the number and date stays."""
        shutil.rmtree(self.folder / SESSIONS / participant, ignore_errors=True)
        journal_path(self.folder, participant).unlink(missing_ok=True)
        if (self.private / "identities.sqlite").exists():
            with sqlite3.connect(self.private / "identities.sqlite") as database:
                database.execute("delete from ids where participant = ?", (participant,))
        (self.folder / WITHDRAWN).mkdir(exist_ok=True)
        text = {"participant": participant, "purged": datetime.now(UTC).date().isoformat()}
        write_whole(self.folder / WITHDRAWN / f"{participant}.json", json.dumps(text).encode())
        build_tables(self.folder, self.run.digest)

    def close(self) -> None:
        """Hold every session that is under way: the same command resumes it from its journal."""
        for visit in self.visits.values():
            if not visit.over:
                visit.pause("program", "the program was stopped")

    def _taken(self) -> list[str]:
        purged = [p.stem for p in (self.folder / WITHDRAWN).glob("*.json")]
        begun = [p.stem for p in (self.folder / JOURNALS).glob("*.jsonl")]
        return [*purged, *begun, *self.visits]

    def _begin(self, number: int) -> Visit:
        name = participant_id(number)
        visit = Visit(
            self.run, number, journal_path(self.folder, name), self._make_world,
            finish=self._finished, fail=self._failed, lockstep=self._lockstep,
        )  # fmt: skip
        self.visits[name] = visit
        visit.start()
        self._on_change()
        return visit

    def _finished(self, visit: Visit, record: SessionRecord) -> None:
        left = record.participant.laps_driven and record.laps[-1].row.end_reason == "withdrew"
        gone = bool(left or visit.participant.withdrawal())
        if not record.participant.consented or (gone and self._purges):
            self.purge(visit.name)
        else:
            with self._lock:
                files = encode(record, self.run.digest)
                write_session(self.folder, visit.name, files, keep_damaged=True)
                build_tables(self.folder, self.run.digest)
        self._on_change()

    @property
    def _purges(self) -> bool:
        return self.run.study.protocol.live.withdrawal == "purge"

    def _failed(self, visit: Visit, trace: str) -> None:
        write_failure(self.folder, visit.name, trace)
        self._on_change()


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


def _one_world_at_a_time(run: StudyRun) -> Callable[[], World]:
    """Return a function that makes a world of its own for each session."""
    making = threading.Lock()

    def make() -> World:
        with making:  # PyBullet's loading of files is not meant for several threads
            return world_of(run, shared=False)

    return make


def as_console(study: LiveStudy) -> dict[str, Any]:
    """Return what the experimenter's console shows."""
    progress = study.progress()
    return {
        "type": "console",
        "planned": progress.planned,
        "finished": list(progress.finished),
        "sessions": [visit.snapshot() for visit in study.visits.values()],
    }
