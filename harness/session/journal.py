"""Writes what is applied in a session before it acts, so that a killed session can resume."""

import os
import threading
from collections import deque
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Protocol

from harness.session.clock import Timing
from lad.assistant import Assistance
from lad.command import Command
from participants.survey import Answer
from protocols.files.errors import InputError
from protocols.record.atomic import naming, sync_folder
from protocols.record.journal import (
    Entry,
    JournalHeader,
    RecordedJournal,
    drop_torn_line,
    entry_line,
    read_journal,
    refuse_other_journal,
)


class Journal(Protocol):
    """Receives what is applied, in the order in which it is applied."""

    def stage(self, index: int, kind: str, lap: int | None) -> None:
        """Note that a stage begins."""

    def tick(
        self,
        command: Command | None,
        demonstrator: Assistance | None,
        timing: Timing | None,
        telemetry: Mapping[str, Any],
    ) -> None:
        """Note what people gave in one control step, and how it reached us."""

    def broken_off(self, reason: str, note: str | None) -> None:
        """Note that a lap ends before its time."""

    def answers(
        self, answers: Sequence[Answer], seconds: Sequence[float | None] | None = None
    ) -> None:
        """Note the answers to one questionnaire, and how long each took where that is known."""

    def page(self, kind: str, entered: Mapping[str, Answer]) -> None:
        """Note what was entered on a page."""

    def repeated(self) -> None:
        """Note that the lap is driven once more."""


class FileJournal:
    """A journal in a file that is only ever appended to.

    With entries of an earlier process, it first checks that the session repeats them, line by line;
    only then does it append. So a replayed session is proved equal to the one that was killed.

    Parameters
    ----------
    path
        The file; its folder exists.
    header
        Which session it is.

    Attributes
    ----------
    left
        Entries of an earlier process that the session has not come to yet.

    Raises
    ------
    InputError
        When the file is another session's journal, or damaged before its last line.
    """

    def __init__(self, path: Path, header: JournalHeader) -> None:
        self._path = path
        self._writing = threading.Lock()
        self.left: deque[Entry] = deque()
        recorded = _recorded(path)
        if recorded is not None:
            refuse_other_journal(recorded, header)
            drop_torn_line(recorded)
            self.left.extend(entry for entry in recorded.entries if "event" not in entry)
        # Unbuffered: a line that was written survives the process, whatever kills it.
        with naming(path):
            self._file = path.open("ab", buffering=0)
        if recorded is None:
            self._file.write(entry_line(header.line()))
            sync_folder(path.parent)

    def close(self) -> None:
        """Wait until every line is on the disk, and close the file."""
        self.sync()
        self._file.close()

    def sync(self) -> None:
        """Wait until every line is on the disk: survives the machine, not only the process."""
        os.fsync(self._file.fileno())

    def stage(self, index: int, kind: str, lap: int | None) -> None:
        """Note that a stage begins."""
        self._note({"stage": [index, kind, lap]})

    def tick(
        self,
        command: Command | None,
        demonstrator: Assistance | None,
        timing: Timing | None,
        telemetry: Mapping[str, Any] = MappingProxyType({}),
    ) -> None:
        """Note what people gave in one control step."""
        self._note({"tick": tick_entry(command, demonstrator, timing, telemetry)})

    def broken_off(self, reason: str, note: str | None) -> None:
        """Note that a lap ends before its time."""
        self._note({"end": [reason, note]})

    def answers(
        self, answers: Sequence[Answer], seconds: Sequence[float | None] | None = None
    ) -> None:
        """Note the answers to one questionnaire, and how long each took where that is known."""
        times = {} if seconds is None else {"seconds": list(seconds)}
        self._note({"answers": list(answers), **times})

    def page(self, kind: str, entered: Mapping[str, Answer]) -> None:
        """Note what was entered on a page."""
        self._note({"page": [kind, dict(entered)]})

    def repeated(self) -> None:
        """Note that the lap is driven once more."""
        self._note({"repeat": True})

    def event(self, event: Mapping[str, Any]) -> None:
        """Note what happens beside what is applied; any thread may call this."""
        self._append(entry_line({"event": dict(event)}))

    def _append(self, line: bytes) -> None:
        with self._writing, naming(self._path):
            self._file.write(line)

    def _note(self, entry: Entry) -> None:
        line = entry_line(entry)
        if not self.left:
            self._append(line)
            return
        before = self.left.popleft()
        if entry_line(before) != line:
            raise InputError(
                f"{self._path}: the replayed session differs from the journal: "
                f"{entry_line(before).decode().strip()} there, {line.decode().strip()} now"
            )


def tick_entry(
    command: Command | None,
    demonstrator: Assistance | None,
    timing: Timing | None,
    telemetry: Mapping[str, Any] = MappingProxyType({}),
) -> dict[str, Any]:
    """Return a control step's entry: ``u`` the driver's command, ``d`` the demonstrator, ``t``.

    ``u`` is [v, w]; without it the driver gave no new command. ``d`` is [0] or, where the
    demonstrator helps, [1, v, w] or [1] without a command; without ``d`` there is no
    demonstrator. ``t`` is [late, shift, paused], s; without it time is simulated. ``x`` is what
    living people's links say, by column.
    """
    entry: dict[str, Any] = {}
    if command is not None:
        entry["u"] = _pair(command)
    if demonstrator is not None:
        given = demonstrator.command if demonstrator.helping else None
        entry["d"] = [int(demonstrator.helping), *(_pair(given) if given is not None else ())]
    if timing is not None:
        entry["t"] = [timing.late_s, timing.shift_s, timing.paused_s]
    if telemetry:
        entry["x"] = dict(telemetry)
    return entry


def _pair(command: Command) -> list[float]:
    return [float(command.v), float(command.w)]


def _recorded(path: Path) -> RecordedJournal | None:
    if not path.exists() or not path.read_bytes().count(b"\n"):
        path.unlink(missing_ok=True)  # not even its first line was written
        return None
    return read_journal(path)
