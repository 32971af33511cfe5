"""A study under way takes over an amendment of its registration."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from protocols.record.folder import locked
from protocols.record.header import STUDY_FILE, AmendedStudy, StudyHeader, read_header, write_header
from protocols.record.identity import identity_differences, identity_digest
from protocols.record.sessions import finished_sessions
from protocols.registered_study import copy_registration
from protocols.registration import REGISTRATION, Registration, plan_of, read_registration
from protocols.resolved import ResolvedStudy


def amend_study(
    folder: Path, study: ResolvedStudy, seed: int, registration: Registration
) -> tuple[str, ...]:
    """Bring a study directory to the last amendment of the registration that it follows.

    Sessions that are there stay and still belong to the study; its head says which were before the
    amendment. Nothing is written when the directory has taken over every amendment, follows another
    registration or holds another study: a run refuses it then.

    Parameters
    ----------
    folder
        The study directory; need not exist.
    study
        As the amended plan has it.
    seed
        The study's; a directory with another one is left alone.
    registration
        The whole chain, verified.

    Returns
    -------
    tuple of str
        Participants whose sessions were there before; empty when nothing was amended.

    Raises
    ------
    InputError
        When the directory's head cannot be read, or another process writes into it.
    """
    if len(registration.heads) == 1 or not (folder / STUDY_FILE).is_file():
        return ()
    with locked(folder):
        header = read_header(folder)
        if header.protocol.registration != registration.digest or header.seed != seed:
            return ()
        known = _known(folder, header, registration)
        if known is None or known == len(registration.heads):
            return ()
        before = finished_sessions(folder, header.digest)
        amended = (
            AmendedStudy(number=n, sessions=before) for n in range(known, len(registration.heads))
        )
        changed = header.model_copy(
            update={
                "protocol": study.protocol,
                "course": study.course,
                "group_courses": dict(study.group_courses),
                "instruments": study.instruments,
                "amended": (*header.amended, *amended),
            }
        )
        write_header(folder, changed)  # whole or not at all: before the copy, which can be repeated
        copy_registration(registration, folder)
    return before


def _known(folder: Path, header: StudyHeader, registration: Registration) -> int | None:
    """Return how many plans the directory has taken over; None when it holds none of them."""
    if (folder / REGISTRATION).is_dir():
        copied = len(read_registration(folder / REGISTRATION).heads)
        if header.amended:
            return max(copied, 1 + header.amended[-1].number)
        return copied
    mine = plan_of(header.study)["study"]
    same = [
        number
        for number, plan in enumerate(registration.plans, start=1)
        if not identity_differences(plan["study"], mine)
    ]
    return max(same, default=None)


def first_digest(header: StudyHeader, registration: Registration) -> str:
    """Return the digest that an amended study had in the beginning, by its registration."""
    plan = registration.plans[header.amended[0].number - 1]
    content: Mapping[str, Any] = {
        **plan["study"],
        "seed": header.seed,
        "protocol": {**plan["study"]["protocol"], "registration": registration.digest},
    }
    return identity_digest(content)


def plan_number(header: StudyHeader, participant: str) -> int:
    """Return under which plan a participant's session is: 0 for the first, else the amendment."""
    for amended in header.amended:
        if participant in amended.sessions:
            return amended.number - 1
    return header.amended[-1].number if header.amended else 0
