"""A study to run."""

from dataclasses import dataclass, replace
from pathlib import Path

from participants.registry import portable_driver_options
from protocols.order import group_of, of_participant
from protocols.resolved import ResolvedStudy


@dataclass(frozen=True, slots=True)
class StudyRun:
    """Everything that a session depends on, except the participant's number.

    Attributes
    ----------
    study
        Protocol, course and questionnaires.
    seed
        Of every random draw; 0 or more.
    digest
        By which sessions say what study they belong to; None when they are not kept. It is the
        study directory's own, which an earlier version may have computed.
    previous
        The model that the participant before has left, where a condition borrows it; None for none.
    slot
        Position in the sequence of orders and groups that was given at enrolment; None for the
        participant's number.
    """

    study: ResolvedStudy
    seed: int
    digest: str | None = None
    previous: bytes | None = None
    slot: int | None = None

    def slot_of(self, number: int) -> int:
        """Return a participant's position in the sequence of orders and groups."""
        return number if self.slot is None else self.slot


def of_one(run: StudyRun, number: int) -> StudyRun:
    """Return the study as it is for one participant: with what is different for the group.

    Parameters
    ----------
    run
        The study, for all participants.
    number
        The participant's number, from 1.

    Examples
    --------
    >>> from protocols.load import resolve_study
    >>> run = StudyRun(resolve_study("four-lap"), seed=0)
    >>> of_one(run, 1) == run  # no groups in it
    True
    """
    slot = run.slot_of(number)
    protocol = of_participant(run.study.protocol, slot, run.seed)
    group = group_of(run.study.protocol, slot, run.seed)
    course = run.study.course if group is None else run.study.group_courses.get(group)
    return replace(
        run, study=replace(run.study, protocol=protocol, course=course or run.study.course)
    )


def portable(run: StudyRun) -> StudyRun:
    """Return the run in a form that does not depend on where it is carried out.

    Files that the driver's options name are read here and now: sessions may run on machines that
    do not have them.

    Parameters
    ----------
    run
        The study as it was loaded.

    Raises
    ------
    InputError
        When such a file cannot be used.

    Examples
    --------
    >>> from protocols.load import resolve_study
    >>> run = StudyRun(resolve_study("four-lap"), seed=0)
    >>> portable(run).study.protocol == run.study.protocol  # its driver's options name no file
    True
    """
    study = run.study
    folder = (study.folder or Path()).resolve()
    driver = study.protocol.cohort.driver
    options = portable_driver_options(driver.use, driver.options, folder)
    if options != driver.options:
        driver = driver.model_copy(update={"options": options})
    cohort = study.protocol.cohort.model_copy(update={"driver": driver})
    protocol = study.protocol.model_copy(update={"cohort": cohort})
    return replace(run, study=replace(study, protocol=protocol, folder=folder))
