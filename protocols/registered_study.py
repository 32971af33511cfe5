"""A study that follows a registration: refused if it is another, compared, and kept with it."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from protocols.course.schema import Course
from protocols.files.errors import InputError
from protocols.instrument import Instrument
from protocols.record.atomic import write_whole
from protocols.record.identity import identity_differences
from protocols.registration import REGISTRATION, Registration, plan_of, read_registration
from protocols.resolved import ResolvedStudy


def plan_study(registration: Registration, number: int) -> ResolvedStudy:
    """Return the study as one of a registration's plans has it.

    Parameters
    ----------
    registration
        The plan that came first, and its amendments.
    number
        0 for the first plan, else the amendment of that number.

    Examples
    --------
    >>> import tempfile
    >>> from protocols.registration import write_registration
    >>> from protocols.load import resolve_study
    >>> study = resolve_study("four-lap")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = write_registration(study, Path(folder))
    ...     plan = read_registration(Path(folder))
    >>> plan_study(plan, 0).protocol.cohort.participants
    12
    """
    content = registration.plans[number]["study"]
    protocol = registration.protocols[number]
    return ResolvedStudy(
        protocol.model_copy(update={"registration": registration.digest}),
        Course.model_validate_json(json.dumps(content["course"])),
        tuple(Instrument.model_validate_json(json.dumps(i)) for i in content["instruments"]),
        {
            name: Course.model_validate_json(json.dumps(course))
            for name, course in content.get("group_courses", {}).items()
        },
    )


def registered(study: ResolvedStudy, registration: Registration) -> ResolvedStudy:
    """Return a study as one that follows a registration.

    Parameters
    ----------
    study
        The study as it is going to be run.
    registration
        The plan that it follows.

    Raises
    ------
    InputError
        When the registration is of another plan: in one line, the first difference.

    Examples
    --------
    >>> import tempfile
    >>> from protocols.registration import write_registration
    >>> from protocols.load import resolve_study
    >>> study = resolve_study("four-lap")
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = write_registration(study, Path(folder))
    ...     plan = read_registration(Path(folder))
    >>> registered(study, plan).protocol.registration == plan.digest
    True
    >>> registered(resolve_study("four-lap", participants=24), plan)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    protocols.files.errors.InputError: ...: registers another plan: participants: ...
    """
    faults = tuple(plan_differences(study, registration))
    if faults:
        more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
        raise InputError(
            f"{registration.folder}: registers another plan: {faults[0]}{more}; allowed: the plan "
            "as registered, or an amendment with its reason (lad-study preregister --amend)"
        )
    protocol = study.protocol.model_copy(update={"registration": registration.digest})
    return replace(study, protocol=protocol)


def plan_differences(study: ResolvedStudy, registration: Registration) -> Iterator[str]:
    """Yield in words how a study differs from the plan that holds; fewer participants do not.

    Parameters
    ----------
    study
        The study as it is going to be run.
    registration
        The plan to compare with: its last amendment.

    Examples
    --------
    >>> from protocols.load import resolve_study
    >>> study = resolve_study("four-lap")
    >>> plan = Registration(Path("plan"), (), (plan_of(study),), (study.protocol,))
    >>> list(plan_differences(resolve_study("four-lap", participants=6), plan))
    []
    >>> list(plan_differences(resolve_study("four-lap", participants=24), plan))
    ['participants: the study stops at 12, 24 wanted']
    """
    mine = plan_of(study)
    yield from identity_differences(registration.plan["study"], mine["study"])
    if mine["participants"] > registration.participants:
        yield (
            f"participants: the study stops at {registration.participants}, "
            f"{mine['participants']} wanted"
        )


def copy_registration(registration: Registration, study_folder: Path) -> None:
    """Put a registration into the directory of the study that follows it, byte for byte.

    Parameters
    ----------
    registration
        As it was read and verified.
    study_folder
        The study directory.

    Examples
    --------
    >>> import tempfile
    >>> from protocols.registration import write_registration
    >>> from protocols.load import resolve_study
    >>> with tempfile.TemporaryDirectory() as place:
    ...     _ = write_registration(resolve_study("four-lap"), Path(place, "plan"))
    ...     copy_registration(read_registration(Path(place, "plan")), Path(place, "study"))
    ...     read_registration(Path(place, "study", REGISTRATION)).participants
    12
    """
    for source in sorted(registration.folder.rglob("*")):
        if source.is_file():
            target = study_folder / REGISTRATION / source.relative_to(registration.folder)
            target.parent.mkdir(parents=True, exist_ok=True)
            write_whole(target, source.read_bytes())


def registration_faults(folder: Path, study: ResolvedStudy) -> Iterator[str]:
    """Yield what is wrong with the registration that a study directory holds, if it follows one.

    Parameters
    ----------
    folder
        The study directory.
    study
        What its ``study.yaml`` says.

    Examples
    --------
    >>> from protocols.load import resolve_study
    >>> list(registration_faults(Path("study"), resolve_study("four-lap")))  # it follows none
    []
    """
    digest = study.protocol.registration
    if digest is None:
        return
    try:
        registration = read_registration(folder / REGISTRATION)
    except InputError as error:
        yield str(error)
        return
    if registration.digest != digest:
        yield f"{folder / REGISTRATION}: is not the registration that the study follows"
        return
    for difference in plan_differences(study, registration):
        yield f"{folder / REGISTRATION}: the study differs from the plan: {difference}"
