"""How far a study is, read from its directory while a run may be writing into it."""

import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import pyarrow.parquet as pq

from protocols.files.errors import InputError
from protocols.record.folder import lock_taken_at
from protocols.record.header import read_header
from protocols.record.journal import JOURNALS, read_journal
from protocols.record.logs import failures
from protocols.record.session import LAPS_FILE
from protocols.record.sessions import SESSIONS, finished_sessions


@dataclass(frozen=True, slots=True)
class Standing:
    """How far a study is.

    Attributes
    ----------
    planned
        Participants the study has; None where that is not known.
    done
        Sessions that are there, whole.
    laps, unfinished
        Laps in them, and those of these that did not reach the last gate.
    failed
        Participants whose last session raised, or was given up.
    under_way
        What living participants are doing now, a few words for each open session.
    since_s
        How long ago the run that is writing now began, s; None when no run is writing.
    done_since
        Sessions that were finished in that time.
    """

    planned: int | None
    done: int
    laps: int
    unfinished: int
    failed: tuple[str, ...]
    under_way: tuple[str, ...]
    since_s: float | None
    done_since: int


def standing(folder: Path) -> Standing:
    """Return how far the study in a directory is; nothing in it is changed.

    Raises
    ------
    InputError
        When it is no study directory, or its study was recorded by another program.
    """
    header = read_header(folder)
    if header.origin == "elsewhere":
        raise InputError(f"{folder}: its study was recorded elsewhere; nothing is run in it")
    begun = lock_taken_at(folder)
    names = finished_sessions(folder, header.digest)
    laps = [_laps(folder / SESSIONS / name) for name in names]
    ended = [_modified(folder / SESSIONS / name) for name in names]
    return Standing(
        planned=header.planned_participants,
        done=len(names),
        laps=sum(driven for driven, _ in laps),
        unfinished=sum(driven - finished for driven, finished in laps),
        failed=tuple(name for name in failures(folder) if name not in names),
        under_way=tuple(_under_way(folder, set(names))),
        since_s=None if begun is None else max(time.time() - begun, 0.0),
        done_since=0 if begun is None else sum(at >= begun for at in ended),
    )


@lru_cache(maxsize=20_000)
def _laps(session: Path) -> tuple[int, int]:
    """Return how many laps a whole session has, and how many of them were finished."""
    try:
        completed = pq.read_table(session / LAPS_FILE, columns=["completed"])["completed"]
    except OSError:  # replaced at this moment
        return 0, 0
    return len(completed), sum(bool(one) for one in completed.to_pylist())


def _modified(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def _under_way(folder: Path, done: set[str]) -> Iterator[str]:
    """Yield what open sessions of living people are at; simulated ones keep no journal."""
    for path in sorted((folder / JOURNALS).glob("*.jsonl")):
        if path.stem in done:
            continue
        with suppress(InputError):  # not a whole line yet
            stages = [e["stage"] for e in read_journal(path).entries if "stage" in e]
            if stages:
                _, kind, lap = stages[-1]
                yield f"{path.stem}: {kind}" + ("" if lap is None else f" {lap}")
