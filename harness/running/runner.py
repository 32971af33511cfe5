"""Run a study: the missing sessions, then the tables. The runner alone writes."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from harness.running.open_workers import open_workers
from harness.running.sessions import run_sessions, try_parts
from harness.running.workers import Died, Failed, Finished, Workers
from harness.running.writer import AT_ONCE, Writer
from harness.session.study_run import StudyRun, portable
from protocols.model_choice import borrows_from_previous
from protocols.record.header import StudyHeader
from protocols.record.rows import participant_id
from protocols.record.store import (
    build_tables,
    clear_failure,
    failures,
    finished_sessions,
    locked,
    model_before,
    open_folder,
    raised,
    refuse_another_study,
    write_death,
    write_failure,
    write_given_up,
)

Tell = Callable[[int, int], None]
"""Called with the number of sessions that have ended, and the number planned."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a run ended.

    Attributes
    ----------
    planned
        Participants the study has.
    found
        Sessions that were there already.
    finished
        Sessions this run finished.
    failed
        Participants whose session raised, in this run or, left alone, in an earlier one, or was
        given up because its processes died.
    """

    planned: int
    found: int
    finished: int
    failed: tuple[str, ...]


def run_study(
    run: StudyRun,
    out: Path,
    jobs: int,
    tell: Tell | None = None,
    *,
    scheduler: str | None = None,
    retry_failed: bool = False,
) -> Outcome:
    """Run a study, or what is missing of it.

    Parameters
    ----------
    run
        The study and its seed.
    out
        The study directory; made when it does not exist. Finished sessions in it are kept.
    jobs
        Number of processes, 1 or more.
    tell
        Called when a session has ended.
    scheduler
        Address of a Dask scheduler; its workers run the sessions, and only this process writes.
    retry_failed
        Whether sessions that raised in an earlier run are run again.

    Raises
    ------
    InputError
        When a part that the protocol names cannot be made, or ``out`` holds something else or
        another study; nothing is changed then.
    OSError
        When something cannot be written, or there is no worker; what was finished is kept.

    Examples
    --------
    >>> import tempfile
    >>> from protocols.load import resolve_study
    >>> from protocols.record.check import check_study
    >>> from protocols.record.reader import open_study
    >>> work = tempfile.TemporaryDirectory()
    >>> protocol, out = Path(work.name, "brief.yaml"), Path(work.name, "study")
    >>> _ = protocol.write_text(
    ...     "{schema: 1, name: brief, title: Two seconds, conditions: {free: {}}, "
    ...     "laps: [{condition: free, time_limit_s: 2}], cohort: {participants: 1}}"
    ... )
    >>> outcome = run_study(StudyRun(resolve_study(str(protocol)), seed=0), out, jobs=1)
    >>> outcome.failed, check_study(out), open_study(out).laps.num_rows
    ((), (), 1)
    >>> work.cleanup()
    """
    run = portable(run)
    header = refuse_another_study(out, run.study, run.seed)
    if header and not _missing(_named(run, header), out, retry_failed=retry_failed):
        return _complete(run, out)
    with open_workers(jobs, scheduler) as workers:
        try_parts(workers, run)
        with _opened(run, out) as named:
            missing = _missing(named, out, retry_failed=retry_failed)
            before = len(_planned(run)) - len(missing)
            counted = (lambda ended: tell(before + ended, len(_planned(run)))) if tell else None
            # A session that lends its model to the next is on the disk before that begins.
            at_once = 1 if borrows_from_previous(run.study.protocol.models) else AT_ONCE
            sessions = _sessions(workers, named, missing, out)
            finished = _write(out, sessions, counted, at_once)
            build_tables(out, named.digest)
            return _outcome(named, out, finished)


def _sessions(
    workers: Workers, run: StudyRun, missing: list[int], out: Path
) -> Iterator[tuple[int, Finished | Failed | Died]]:
    """Run the missing sessions: one after the other where one needs the model of another.

    The one before must be on disk before the next begins, so this must be read as it is written.
    """
    if not borrows_from_previous(run.study.protocol.models):
        yield from run_sessions(workers, run, missing)
        return
    for number in sorted(missing):
        lent = replace(run, previous=model_before(out, number))
        yield from run_sessions(workers, lent, [number])


def _complete(run: StudyRun, out: Path) -> Outcome:
    """Bring the tables of a study up to date when no session is missing."""
    with _opened(run, out) as named:
        build_tables(out, named.digest)
        return _outcome(named, out, 0)


@contextmanager
def _opened(run: StudyRun, out: Path) -> Iterator[StudyRun]:
    """Lock the study directory, and tidy it up, while a run writes into it."""
    with locked(out):
        yield _named(run, open_folder(out, run.study, run.seed))


def _named(run: StudyRun, header: StudyHeader) -> StudyRun:
    """Return the run with the digest that the directory's sessions give their study."""
    return replace(run, digest=header.digest)


def _planned(run: StudyRun) -> range:
    return range(1, run.study.protocol.cohort.participants + 1)


def _missing(run: StudyRun, out: Path, *, retry_failed: bool) -> list[int]:
    """Return the participants who have not finished; failed ones only when they are retried.

    A session whose processes died counts as missing: memory was short, or a machine was removed.
    """
    settled = set(finished_sessions(out, run.digest))
    if not retry_failed:
        settled.update(raised(out))
    return [number for number in _planned(run) if participant_id(number) not in settled]


def _write(
    out: Path,
    sessions: Iterable[tuple[int, Finished | Failed | Died]],
    tell: Callable[[int], None] | None,
    at_once: int = AT_ONCE,
) -> int:
    """Write each session as it comes in; return how many finished."""
    finished = ended = 0
    tell = tell or (lambda _: None)
    tell(0)
    with Writer(out, at_once) as writer:
        for number, session in sessions:
            name = participant_id(number)
            if isinstance(session, Died) and session.retried:
                write_death(out, name, session.reason)
                continue
            clear_failure(out, name)
            if isinstance(session, Finished):
                for _ in writer.write(name, session):
                    finished, ended = finished + 1, ended + 1
                    tell(ended)
                continue
            if isinstance(session, Failed):
                write_failure(out, name, session.trace)
            else:
                write_given_up(out, name, session.reason)
            ended += 1
            tell(ended)
        for _ in writer.wait():
            finished, ended = finished + 1, ended + 1
            tell(ended)
    return finished


def _outcome(run: StudyRun, out: Path, finished: int) -> Outcome:
    planned = [participant_id(number) for number in _planned(run)]
    there = set(finished_sessions(out, run.digest))
    failed = tuple(name for name in failures(out) if name in planned and name not in there)
    return Outcome(len(planned), len(there.intersection(planned)) - finished, finished, failed)
