"""A session's journal: what was applied, line by line, as it happened.

One JSON object a line. The first names the participant and the study; each other is of one kind:

- ``stage``: [index, kind, lap] as a stage begins;
- ``tick``: what people gave in one control step, see ``TickEntry``;
- ``end``: [reason, note] where a lap was broken off; ``repeat`` where it is driven once more;
- ``answers``: the answers to one questionnaire, with ``seconds`` beside it where a living person
  took that long for each; ``page``: what was entered on a page;
- ``event``: what happened beside that, see ``protocols.record.rows.EventRow``.

Numbers are written so that they read back exactly.
"""

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from protocols.files.errors import InputError
from protocols.record.identity import identity, identity_differences
from protocols.resolved import ResolvedStudy
from protocols.versions import package_versions

JOURNALS = "journals"
"""Folder of a study directory with the journals; nothing in it is ever cleaned up."""

FORMAT = 1

Entry = Mapping[str, Any]


def journal_path(folder: Path, participant: str) -> Path:
    """Return the path of a participant's journal in a study directory."""
    return folder / JOURNALS / f"{participant}.jsonl"


@dataclass(frozen=True, slots=True)
class JournalHeader:
    """The first line of a journal: which session it is.

    Attributes
    ----------
    participant
        The participant's id, e.g. P0001.
    seed
        The study's.
    identity
        Protocol, course and instruments, as ``protocols.record.identity.identity`` returns them.
    versions
        Versions of the packages that can change a record.
    kind
        What the driver is, as ``participants.kind`` has it.
    """

    participant: str
    seed: int
    identity: Mapping[str, Any]
    versions: Mapping[str, str]
    kind: str = "synthetic"

    def line(self) -> Entry:
        """Return the journal's first line."""
        return {
            "journal": FORMAT,
            "participant": self.participant,
            "seed": self.seed,
            "kind": self.kind,
            "versions": dict(self.versions),
            "identity": dict(self.identity),
        }


def journal_header(
    study: ResolvedStudy, seed: int, participant: str, kind: str = "synthetic"
) -> JournalHeader:
    """Return the head of a journal that is begun here and now."""
    return JournalHeader(participant, seed, identity(study, seed), package_versions(), kind)


@dataclass(frozen=True, slots=True)
class RecordedJournal:
    """A journal that was read.

    Attributes
    ----------
    path
        Its file.
    header
        Its first line.
    entries
        The other whole lines, in order.
    whole_bytes
        Length of the file without a line that was cut short.
    """

    path: Path
    header: JournalHeader
    entries: tuple[Entry, ...]
    whole_bytes: int


def entry_line(entry: Entry) -> bytes:
    """Return an entry as the journal holds it.

    Raises
    ------
    ValueError
        When a number is not finite: the journal could not be read by other programs.
    """
    text = json.dumps(entry, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return f"{text}\n".encode()


def read_journal(path: Path) -> RecordedJournal:
    """Read a journal; a last line that was cut short is left out, and nothing else.

    Raises
    ------
    InputError
        When the file cannot be read, its first line is no journal's of this version, or a line
        inside it is damaged; names the line.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from None
    whole = content.rfind(b"\n") + 1
    lines = content[:whole].splitlines()
    if not lines:
        raise InputError(f"{path}: holds no whole line; the session had not begun")
    first, *others = (_parsed(line, f"{path}:{n}") for n, line in enumerate(lines, start=1))
    return RecordedJournal(path, _header(first, path), tuple(others), whole)


def refuse_other_journal(journal: RecordedJournal, wanted: JournalHeader) -> None:
    """Refuse a journal that this session could not replay exactly.

    Raises
    ------
    InputError
        When it is another participant's, another study's or of other package versions; names the
        differences.
    """
    here = journal.header
    found = []
    if here.participant != wanted.participant:
        found.append(f"participant: {here.participant} there, {wanted.participant} wanted")
    found += identity_differences(here.identity, wanted.identity)
    for name in sorted({*here.versions, *wanted.versions}):
        there, want = here.versions.get(name), wanted.versions.get(name)
        if there != want:
            found.append(f"{name}: version {there or 'none'} there, {want or 'none'} here")
    if found:
        more = f" (and {len(found) - 3} more differences)" if len(found) > 3 else ""
        raise InputError(
            f"{journal.path}: cannot be replayed: {'; '.join(found[:3])}{more}; "
            "allowed: the study and the package versions that recorded it"
        )


def drop_torn_line(journal: RecordedJournal) -> None:
    """Remove the incomplete last line that a killed process has left."""
    if journal.path.stat().st_size != journal.whole_bytes:
        os.truncate(journal.path, journal.whole_bytes)


def _parsed(line: bytes, where: str) -> Entry:
    try:
        entry = json.loads(line)
    except ValueError:
        raise InputError(f"{where}: not a line of a journal; it is damaged") from None
    if not isinstance(entry, dict):
        raise InputError(f"{where}: not a line of a journal; it is damaged")
    return entry


def _header(first: Entry, path: Path) -> JournalHeader:
    if first.get("journal") != FORMAT:
        raise InputError(
            f"{path}:1: journal version {first.get('journal')!r}; this program reads {FORMAT}"
        )
    try:
        return JournalHeader(
            str(first["participant"]),
            int(first["seed"]),
            first["identity"],
            first["versions"],
            str(first["kind"]),
        )
    except (KeyError, TypeError, ValueError):
        raise InputError(f"{path}:1: not the first line of a journal; it is damaged") from None
