"""Read a study directory: one of ours, or one that was recorded elsewhere in our schema."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc

from protocols.course.schema import Course
from protocols.files.errors import InputError
from protocols.files.suggestion import listed
from protocols.instrument import Instrument
from protocols.record.atomic import is_partial
from protocols.record.elsewhere.conform import Conformed, conform
from protocols.record.elsewhere.rules import STEPS
from protocols.record.elsewhere.step_tables import ForeignSteps, LapSteps
from protocols.record.header import StudyHeader, read_header
from protocols.record.logs import failures
from protocols.record.merge import LAPS_TABLE, PARTICIPANTS_TABLE, SURVEYS_TABLE
from protocols.record.parquet import read_parquet
from protocols.record.session import EVENTS_FILE, MODEL_FILE, steps_file
from protocols.record.sessions import (
    SESSIONS,
    finished_sessions,
    read_manifest,
    session_folders,
)
from protocols.record.study_tables import StudyTables
from protocols.record.tables import EVENT_SCHEMA
from protocols.study import StudyProtocol


@dataclass(frozen=True)
class Study:
    """A recorded study. Nothing is read before it is asked for; nothing is ever written.

    Attributes
    ----------
    folder
        The study directory.
    header
        The contents of ``study.yaml``: protocol, course, instruments, seed, versions.
    """

    folder: Path
    header: StudyHeader

    @property
    def protocol(self) -> StudyProtocol:
        """The protocol as it was resolved."""
        return self.header.protocol

    @property
    def course(self) -> Course:
        """The course that was driven; a group may have driven another one."""
        return self.header.course

    @property
    def courses(self) -> tuple[Course, ...]:
        """The courses that were driven, each once: the study's, and those of groups."""
        named = {one.name: one for one in (self.course, *self.header.group_courses.values())}
        return tuple(named.values())

    @property
    def course_names(self) -> str:
        """The names of the courses that were driven, in words."""
        return " and ".join(course.name for course in self.courses)

    def course_of(self, participant: str) -> Course:
        """Return the course that a participant drove: a group may have another one."""
        if not self.header.group_courses:
            return self.course
        people = self.participants
        of = dict(zip(people["participant"].to_pylist(), people["group"].to_pylist(), strict=True))
        return self.header.group_courses.get(of.get(participant) or "", self.course)

    @property
    def instruments(self) -> tuple[Instrument, ...]:
        """The instruments that were asked."""
        return self.header.instruments

    @property
    def elsewhere(self) -> bool:
        """Whether other programs recorded the study."""
        return self.header.origin == "elsewhere"

    @property
    def seed(self) -> int | None:
        """The seed; None for a study that was recorded elsewhere."""
        return self.header.seed

    @property
    def participants(self) -> pa.Table:
        """One row per participant (``protocols.record.tables.PARTICIPANT_COLUMNS``)."""
        return self._tables.participants.table

    @property
    def laps(self) -> pa.Table:
        """One row per lap begun (``protocols.record.tables.LAP_COLUMNS``)."""
        return self._tables.laps.table

    @property
    def surveys(self) -> pa.Table:
        """One row per question asked; without rows when nothing was asked."""
        return self._tables.surveys.table

    @property
    def remarks(self) -> tuple[str, ...]:
        """What of the tables was recognised although it is written otherwise, in words."""
        return (*self._tables.remarks, *(self._foreign.remarks if self._foreign else ()))

    @property
    def strays(self) -> tuple[str, ...]:
        """Step tables that no lap refers to, in words; those of our own studies have checksums."""
        return self._foreign.strays if self._foreign else ()

    @cached_property
    def _tables(self) -> StudyTables:
        return StudyTables(self.folder, self.header)

    @cached_property
    def _foreign(self) -> ForeignSteps | None:
        return ForeignSteps(self._tables) if self.elsewhere else None

    @cached_property
    def events(self) -> pa.Table:
        """What happened beside what was applied (``EVENT_COLUMNS``); no row without living people.

        Raises
        ------
        InputError
            When a session's file is damaged (names it).
        """
        paths = [path / EVENTS_FILE for path in session_folders(self.folder)]
        tables = [read_parquet(path, EVENT_SCHEMA.names) for path in paths if path.is_file()]
        return pa.concat_tables(tables) if tables else EVENT_SCHEMA.empty_table()

    def sessions(self) -> tuple[str, ...]:
        """Return the participants with a session folder, sorted."""
        return tuple(path.name for path in session_folders(self.folder))

    def failed(self) -> tuple[str, ...]:
        """Return the participants whose session raised and was not run again, sorted."""
        return tuple(name for name in failures(self.folder) if name not in self.sessions())

    def steps(self, participant: str, lap: int, columns: Sequence[str] | None = None) -> pa.Table:
        """Return a lap's steps (``protocols.record.steps.STEP_COLUMNS``).

        Parameters
        ----------
        participant
            The participant's id, e.g. P0001.
        lap
            Position of the lap in the session, counted from 0.
        columns
            Only these columns, in this order; None for all.

        Raises
        ------
        InputError
            When there is no such participant or lap (lists those there are), or the file is
            damaged (names it).
        """
        if self._foreign:
            table = self.lap_steps(participant, lap).table
        else:
            table = self._recorded_steps(participant, lap, columns).table
        return table if columns is None else table.select(list(columns))

    def lap_steps(self, participant: str, lap: int, *, against_lap: bool = True) -> LapSteps:
        """Return a lap's steps as an analysis can use them, and what was found about them.

        Of a study from elsewhere, times are brought to the lap's start and its clock is held
        against the lap's own times; positions are compared with the course.

        Parameters
        ----------
        participant, lap
            As of ``steps``.
        against_lap
            Whether times are missing that contradict how long the lap took.

        Raises
        ------
        InputError
            As ``steps``.
        """
        steps = self._recorded_steps(participant, lap, None)
        if self._foreign is None:
            return LapSteps(steps.table)
        return self._foreign.used(steps, participant, lap, against_lap=against_lap)

    def has_steps(self, participant: str, lap: int) -> bool:
        """Tell whether a lap's steps were recorded: elsewhere, they may not have been."""
        if self._foreign:
            return self._foreign.path(participant, lap) is not None
        return (self.folder / SESSIONS / participant / steps_file(lap)).is_file()

    def _steps_file(self, lap: int) -> str:
        return steps_file(lap - (self._foreign.shift if self._foreign else 0))

    def _recorded_steps(
        self, participant: str, lap: int, columns: Sequence[str] | None
    ) -> Conformed:
        path = self._session(participant) / self._steps_file(lap)
        if not path.is_file():
            known = [str(n) for n in self._recorded_laps(participant)]
            raise InputError(f"{self.folder}: {participant} has no lap {lap}; {listed(known)}")
        wanted = None if columns is None else [*columns, *STEPS.required]
        return conform(read_parquet(path, wanted), STEPS, path, columns)

    def model_bytes(self, participant: str) -> bytes | None:
        """Return the learned model as saved (npz); None when nothing was learnt."""
        path = self._session(participant) / MODEL_FILE
        return path.read_bytes() if path.is_file() else None

    def versions(self) -> tuple[dict[str, str], ...]:
        """Return every distinct set of package versions that recorded sessions of this study."""
        return tuple(versions for versions, _ in self.sessions_by_versions)

    @cached_property
    def sessions_by_versions(self) -> tuple[tuple[dict[str, str], int], ...]:
        """Every distinct set of package versions, and how many sessions it recorded."""
        manifests = [read_manifest(path) for path in session_folders(self.folder)]
        used = [m.versions for m in manifests if m]
        keys = [tuple(sorted(versions.items())) for versions in used]
        count, distinct = Counter(keys), dict(zip(keys, used, strict=True))
        return tuple((distinct[key], count[key]) for key in sorted(count))

    def _session(self, participant: str) -> Path:
        if self._foreign and participant in self._foreign.folders:
            return self._foreign.folders[participant]
        path = self.folder / SESSIONS / participant
        # Listing thousands of sessions for every lap would cost more than reading it.
        if path.name != participant or is_partial(path) or not path.is_dir():
            if self._foreign and participant in self._tables.people:
                raise InputError(f"{self.folder}: {participant} has no session folder, so no steps")
            hint = listed(self.sessions())
            raise InputError(f"{self.folder}: no participant {participant!r}; {hint}")
        return path

    def _recorded_laps(self, participant: str) -> list[int]:
        names = (path.stem for path in self._session(participant).glob(steps_file("*")))
        laps = (name.rpartition("-")[2] for name in names)
        shift = self._foreign.shift if self._foreign else 0
        return sorted(int(lap) + shift for lap in laps if lap.isdigit())


def off_scale(study: Study) -> Iterator[tuple[int, str]]:
    """Yield the row of every answer that is no point of its instrument's scale, and a message.

    Parameters
    ----------
    study
        Its answers are those of the survey table.
    """
    answers = study.surveys
    given = answers["response"]
    for instrument in study.instruments:
        off = pc.or_(pc.less(given, 1), pc.greater(given, instrument.points))
        wrong = pc.fill_null(pc.and_(pc.equal(answers["instrument"], instrument.name), off), False)
        allowed = f"1 to {instrument.points} ({instrument.name}), or nothing"
        # Not pyarrow's indices_nonzero: on a table without a row, pyarrow 17 ends the process.
        for row in np.flatnonzero(wrong.to_numpy()).tolist():
            where = f"{study.folder / SURVEYS_TABLE}: column response"
            yield row, f"{where}: {given[row].as_py()} in row {row}; allowed: {allowed}"


def open_study(folder: Path | str) -> Study:
    """Open a study directory.

    Parameters
    ----------
    folder
        The study directory; nothing in it is changed, and none of its code runs.

    Raises
    ------
    InputError
        When it is no study directory, has no session yet, has an unusable table, or its tables lack
        sessions that a run which was stopped has finished.

    Examples
    --------
    >>> open_study("nowhere")
    Traceback (most recent call last):
    protocols.files.errors.InputError: nowhere: no such folder
    """
    folder = Path(folder)
    study = Study(folder, read_header(folder))
    has_tables = (folder / PARTICIPANTS_TABLE).exists()
    if not has_tables and not study.sessions():
        raise InputError(f"{folder}: no session in it yet; run the study first")
    for name, rows in ((PARTICIPANTS_TABLE, study.participants), (LAPS_TABLE, study.laps)):
        if not len(rows):
            raise InputError(f"{folder / name}: has no row{_what_to_do(study)}")
    if (
        not study.elsewhere
    ):  # no run here can rebuild those of other programs: their faults are reported
        for _, fault in off_scale(study):
            raise InputError(fault)
    _refuse_stale_tables(study)
    return study


def _what_to_do(study: Study) -> str:
    """Return what to do about a table without a row."""
    if study.elsewhere:
        return "; a report needs at least one participant and one lap"
    n = len(study.sessions())
    if not n:
        return " and there is no session in the study yet; run it first"
    return f", but there are {n} sessions; the same `lad-study run` again rebuilds it"


def _refuse_stale_tables(study: Study) -> None:
    """Refuse tables older than a stopped run's sessions: they would hide those sessions."""
    if study.elsewhere:  # recorded elsewhere: its makers decided who is in the tables
        return
    known = set(study.participants["participant"].to_pylist())
    new = [name for name in finished_sessions(study.folder) if name not in known]
    if new:
        raise InputError(
            f"{study.folder / PARTICIPANTS_TABLE}: lacks {len(new)} finished sessions ({new[0]} "
            "first): a run is not over, or was stopped; the same `lad-study run` again finishes it"
        )
