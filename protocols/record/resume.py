"""The command that resumes the run of a study directory."""

import shlex
from dataclasses import replace
from pathlib import Path

from protocols.files.errors import InputError
from protocols.load import load_protocol, resolve_study, shipped_protocols
from protocols.record.header import StudyHeader
from protocols.record.identity import study_digest

_FILE = "PROTOCOL"
"""In place of a protocol file: a study directory holds its contents, not its path."""


def resume_command(folder: Path, header: StudyHeader) -> str:
    """Return the command that resumes a study that is run here.

    A protocol that does not ship, or a shipped one that was changed, is called ``PROTOCOL``.

    Examples
    --------
    >>> from protocols.record.header import header_of
    >>> resume_command(Path("pilot"), header_of(resolve_study("four-lap", participants=3), 7))
    'lad-study run four-lap --participants 3 --seed 7 --out pilot'
    """
    words = (
        *("lad-study", "live" if header.origin == "live" else "run", *_protocol(header)),
        *("--participants", str(header.protocol.cohort.participants)),
        *("--seed", str(header.seed)),
        *("--out", str(folder)),
    )
    if header.protocol.registration is not None:
        words = (*words, "--registration", str(folder / "registration"))
    return shlex.join(words)


def _protocol(header: StudyHeader) -> tuple[str, ...]:
    """Return how to ask for the study, as far as it ships."""
    name, course = header.protocol.name, header.course.name
    if name not in shipped_protocols() or header.seed is None:
        return (_FILE,)
    try:
        shipped = resolve_study(name, course=course)
    except InputError:  # a course that does not ship
        return (_FILE,)
    registration = header.protocol.registration
    protocol = shipped.protocol.model_copy(update={"registration": registration})
    shipped = replace(shipped, protocol=protocol)
    if study_digest(shipped, header.seed) != header.digest:
        return (_FILE,)
    own = load_protocol(name).course == course
    return (name,) if own else (name, "--course", course)
