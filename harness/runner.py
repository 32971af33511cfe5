"""Run a study: the missing sessions, then the tables. The runner alone writes."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from harness.casting import rehearse
from harness.crew import Failed, Finished, run_sessions
from harness.plan import Plan
from protocols.record.rows import participant_id
from protocols.record.store import (
    build_tables,
    clear_failure,
    failures,
    finished_sessions,
    held,
    open_folder,
    write_failure,
    write_session,
    write_timing,
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
        Participants whose session raised, in this run or, left alone, in an earlier one.
    """

    planned: int
    found: int
    finished: int
    failed: tuple[str, ...]


def run_study(
    plan: Plan,
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
    plan
        The study and its seed.
    out
        The study directory; made when it does not exist. Finished sessions in it are kept.
    jobs
        Number of processes, 1 or more.
    tell
        Told whenever a session has ended.
    scheduler
        Address of a Dask scheduler whose workers run the sessions; only this process writes.
    retry_failed
        Whether sessions that raised in an earlier run are run again.

    Raises
    ------
    InputError
        When somebody the protocol names cannot be made, or ``out`` holds something else, or
        another study; nothing is touched then.
    """
    rehearse(plan)
    open_folder(out, plan.study, plan.seed)
    with held(out):
        numbers = range(1, plan.study.protocol.cohort.participants + 1)
        found = set(finished_sessions(out))
        given_up = set() if retry_failed else set(failures(out)) - found
        missing = [n for n in numbers if participant_id(n) not in found | given_up]
        sessions = run_sessions(plan, missing, jobs, scheduler)
        finished = _write(out, sessions, _counting(tell, len(missing), len(numbers)))
        build_tables(out)
    planned = {participant_id(n) for n in numbers}
    failed = tuple(name for name in failures(out) if name in planned)
    return Outcome(len(planned), len(found & planned), finished, failed)


def _write(out: Path, sessions: Iterator[Finished | Failed], tell: Callable[[int], None]) -> int:
    """Write each session as it comes in; return how many finished."""
    finished = 0
    tell(0)
    for ended, session in enumerate(sessions, start=1):
        name = participant_id(session.number)
        if isinstance(session, Failed):
            write_failure(out, name, session.trace)
        else:
            write_session(out, name, session.files)
            clear_failure(out, name)
            write_timing(out, name, session.wall_s)
            finished += 1
        tell(ended)
    return finished


def _counting(tell: Tell | None, missing: int, planned: int) -> Callable[[int], None]:
    """Return a function that counts what was there before as ended, too."""
    return (lambda ended: tell(planned - missing + ended, planned)) if tell else lambda _: None
