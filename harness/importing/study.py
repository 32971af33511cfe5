"""Recordings become a study directory that `report` reads."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from harness.importing.mapping import BagMapping, Person
from harness.importing.session import read_session
from protocols.files.errors import InputError
from protocols.importing.mapping_file import read_mapping
from protocols.load import resolve_study
from protocols.record.atomic import write_whole
from protocols.record.codebook import CODEBOOK_FILE, codebook_json
from protocols.record.folder import locked
from protocols.record.header import StudyHeader, write_header
from protocols.record.rows import participant_id
from protocols.record.session import encode
from protocols.record.store import build_tables, write_session


@dataclass(frozen=True, slots=True)
class ImportedStudy:
    """What became of recordings.

    Attributes
    ----------
    sessions, laps, finished
        How many sessions and laps there are, and how many laps reached the last gate.
    troubles
        What is to be known about the recordings, in words.
    """

    sessions: int
    laps: int
    finished: int
    troubles: tuple[str, ...]


def import_bags(
    bags: Sequence[Path], mapping_path: Path, out: Path, tell: Callable[[str], None]
) -> ImportedStudy:
    """Write a study directory from recordings, one session each.

    Parameters
    ----------
    bags
        The recordings.
    mapping_path
        What is what in them (``mapping.BagMapping``).
    out
        Folder to make.
    tell
        Told what is being done.

    Raises
    ------
    InputError
        When something cannot be read or does not fit; nothing is written then.
    """
    mapping, document = read_mapping(mapping_path, BagMapping)
    if out.exists() and any(out.iterdir()):
        raise InputError(f"{out}: is there already; allowed: a new folder")
    people = _people(bags, mapping, str(document.source))
    base = mapping_path.parent / mapping.protocol
    protocol = str(base) if base.is_file() else mapping.protocol
    study = resolve_study(protocol, course=mapping.course, participants=len(bags))
    sessions = []
    for bag, person in zip(bags, people, strict=True):
        tell(f"Reading {bag.name}")
        sessions.append(read_session(bag, mapping, person, study))
    header = StudyHeader(
        origin="elsewhere",
        protocol=study.protocol,
        instruments=study.instruments,
        course=study.course,
    )
    with locked(out):
        write_header(out, header)
        for session in sessions:
            write_session(out, session.record.participant.participant, encode(session.record))
        write_whole(out / CODEBOOK_FILE, codebook_json().encode())
        build_tables(out)
    rows = [lap.row for session in sessions for lap in session.record.laps]
    return ImportedStudy(
        len(sessions),
        len(rows),
        sum(row.completed for row in rows),
        tuple(trouble for session in sessions for trouble in session.troubles),
    )


def _people(bags: Sequence[Path], mapping: BagMapping, source: str) -> list[Person]:
    """Return who is in each recording."""
    names = {bag.stem for bag in bags}
    for name in sorted(set(mapping.people) - names):
        raise InputError(
            f"{source}: people.{name}: no recording is called so; "
            f"allowed: {', '.join(sorted(names))}"
        )
    people = [
        mapping.people.get(bag.stem) or Person(participant=participant_id(i))
        for i, bag in enumerate(bags, start=1)
    ]
    ids = [person.participant for person in people]
    again = next((name for i, name in enumerate(ids) if name in ids[:i]), None)
    if again is not None:
        raise InputError(f"{source}: people: two recordings are of {again}; allowed: one each")
    return people
