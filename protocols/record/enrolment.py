"""Who has been enrolled in a live study, with which slot and why; written as it is decided.

A study directory without ``allocations.json`` enrolled nobody one by one: participant n has slot n.
"""

import json
from collections.abc import Iterable, Sequence
from pathlib import Path

from protocols.allocation import Allocation, Enrolled, State
from protocols.files.errors import InputError
from protocols.record.atomic import write_whole
from protocols.record.merge import session_rows
from protocols.record.rows import ENDS_SESSION, participant_number
from protocols.record.session import LAPS_FILE, PARTICIPANT_FILE
from protocols.record.sessions import SESSIONS, is_whole
from protocols.record.tables import LAP_COLUMNS, PARTICIPANT_COLUMNS

ALLOCATIONS = "allocations.json"
"""File of a study directory with every allocation, in the order in which they were made."""

WITHDRAWN = "withdrawn"
"""Folder of a study directory with a file for each participant whose data were purged."""


def read_allocations(folder: Path) -> dict[str, Allocation]:
    """Return the allocations of a study directory by participant; empty where none was made.

    Raises
    ------
    InputError
        When the file is damaged.
    """
    path = folder / ALLOCATIONS
    if not path.is_file():
        return {}
    try:
        rows = json.loads(path.read_bytes())
        return {
            str(row["participant"]): Allocation(int(row["slot"]), str(row["reason"]))
            for row in rows
        }
    except (OSError, ValueError, KeyError, TypeError):
        raise InputError(f"{path}: no list of allocations; it is damaged") from None


def write_allocations(folder: Path, given: dict[str, Allocation]) -> None:
    """Keep the allocations of a study, the newest last."""
    rows = [{"participant": p, "slot": a.slot, "reason": a.reason} for p, a in given.items()]
    write_whole(folder / ALLOCATIONS, (json.dumps(rows, indent=1) + "\n").encode())


def slot_of(folder: Path, participant: str) -> int:
    """Return a participant's slot: the one that was given, else the participant's number.

    Raises
    ------
    InputError
        When the list of allocations is damaged.
    """
    given = read_allocations(folder).get(participant)
    return participant_number(participant) if given is None else given.slot


def purged(folder: Path) -> set[str]:
    """Return the participants whose data were purged."""
    return {path.stem for path in (folder / WITHDRAWN).glob("*.json")}


def enrolled(folder: Path, begun: Iterable[str]) -> tuple[Enrolled, ...]:
    """Return everyone who has been enrolled in a study, and what became of them.

    Parameters
    ----------
    folder
        The study directory.
    begun
        Participants whose sessions have begun.
    """
    given, gone = read_allocations(folder), purged(folder)
    people = sorted({*given, *gone, *begun})
    return tuple(
        Enrolled(
            person,
            given[person].slot if person in given else participant_number(person),
            "withdrawn" if person in gone else _state(folder / SESSIONS / person),
        )
        for person in people
    )


def _state(session: Path) -> State:
    """Return what a session is good for, by its rows."""
    if not is_whole(session):
        return "under way"
    (row,) = session_rows(session / PARTICIPANT_FILE, PARTICIPANT_COLUMNS).to_pylist()
    if row["consented"] is False:
        return "withdrawn"
    ends = session_rows(session / LAPS_FILE, LAP_COLUMNS)["end_reason"].to_pylist()
    return state_of(row["laps_planned"], ends, excluded=row["excluded"])


def state_of(laps_planned: int, ends: Sequence[str], *, excluded: bool) -> State:
    """Return whether a session that is over can be used: its slot is given again if not.

    Parameters
    ----------
    laps_planned
        How many laps the participant was to drive.
    ends
        Why each lap that was driven ended.
    excluded
        Whether the protocol's rules exclude the participant.

    Examples
    --------
    >>> state_of(4, ["finished", "withdrew"], excluded=False)
    'withdrawn'
    """
    if len(ends) < laps_planned or ENDS_SESSION.intersection(ends):
        return "withdrawn"
    return "excluded" if excluded else "usable"
