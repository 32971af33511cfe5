"""Rebuild sessions from journals: a killed process loses nothing that a person did."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from harness.running.sessions import world_of
from harness.session.borrowed import borrowed_models
from harness.session.replay import replay
from harness.session.study_run import StudyRun, of_one
from protocols.files.errors import InputError
from protocols.record.enrolment import slot_of
from protocols.record.header import read_header
from protocols.record.journal import JOURNALS, read_journal
from protocols.record.rows import participant_number
from protocols.record.session import encode
from protocols.record.store import (
    build_tables,
    locked,
    model_before,
    whole_sessions,
    write_session,
)
from protocols.resolved import ResolvedStudy


@dataclass(frozen=True, slots=True)
class Recovery:
    """What became of a study's journals.

    Attributes
    ----------
    whole
        Participants whose session was whole already.
    recovered
        Participants whose session was rebuilt from its journal.
    faults
        Why others could not be rebuilt, one line each.
    """

    whole: tuple[str, ...]
    recovered: tuple[str, ...]
    faults: tuple[str, ...]


def recover_sessions(
    folder: Path, with_code: Callable[[ResolvedStudy], ResolvedStudy] | None = None
) -> Recovery:
    """Make each session that has a journal, and is missing or damaged, from its journal.

    A damaged session is moved to ``set-aside``, never deleted; a journal stays where it is. An
    unfinished journal gives the session up to its end, its last lap as interrupted.

    Parameters
    ----------
    folder
        The study directory.
    with_code
        Gives the recorded study its own parts' code, where it has any and it may be run.

    Raises
    ------
    InputError
        When the folder is no study directory, or another process writes into it.
    """
    header = read_header(folder)
    study = header.study if with_code is None else with_code(header.study)
    run = StudyRun(study, header.seed or 0, header.digest)
    recovered, faults = [], []
    with locked(folder):
        whole = set(whole_sessions(folder, header.digest))
        names = sorted(path.stem for path in (folder / JOURNALS).glob("*.jsonl"))
        for name in names:
            if name in whole:
                continue
            try:
                _recover(folder, run, name)
                recovered.append(name)
            except InputError as error:
                faults.append(str(error))
        build_tables(folder, header.digest)
    return Recovery(tuple(n for n in names if n in whole), tuple(recovered), tuple(faults))


def _recover(folder: Path, run: StudyRun, name: str) -> None:
    number = participant_number(name)
    journal = read_journal(folder / JOURNALS / f"{name}.jsonl")
    if not number:
        raise InputError(f"{journal.path}: no participant is called {name!r}; allowed: P0001, ...")
    run = replace(run, slot=slot_of(folder, name))
    lent = replace(run, previous=model_before(folder, number))
    models = borrowed_models(lent, number, world_of(run))  # a pilot drives the study's own course
    record = replay(journal, run, number, world_of(of_one(run, number)), models)
    write_session(folder, name, encode(record, run.digest), keep_damaged=True)
