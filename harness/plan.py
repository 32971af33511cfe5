"""A study to run."""

from dataclasses import dataclass, replace
from pathlib import Path

from protocols.resolved import ResolvedStudy


@dataclass(frozen=True, slots=True)
class Plan:
    """Everything a session depends on, besides the participant's number.

    Attributes
    ----------
    study
        Protocol, course and questionnaires.
    seed
        From which every draw comes; 0 or more.
    digest
        By which sessions say what study they belong to; None when they are not kept. It is the
        study directory's own, which an earlier version may have computed.
    """

    study: ResolvedStudy
    seed: int
    digest: str | None = None


def portable(plan: Plan) -> Plan:
    """Return the plan in a form that does not depend on where it is carried out.

    A scripted driver's command log is read here and now: sessions may run on machines that do not
    have the file, and the study directory says what was driven even when the file is gone.

    Raises
    ------
    InputError
        When the command log cannot be used.
    """
    study = plan.study
    folder = (study.folder or Path()).resolve()
    driver = study.protocol.cohort.driver
    if driver.use == "scripted" and set(driver.options) == {"file"}:
        from participants.scripted import ScriptedDriver, read_log  # noqa: PLC0415  # seldom wanted

        path = folder / str(driver.options["file"])
        log = read_log(path)
        ScriptedDriver(log, str(path))  # refuses, by the file's name, what it could not replay
        driver = driver.model_copy(update={"options": {"commands": log.tolist()}})
    cohort = study.protocol.cohort.model_copy(update={"driver": driver})
    protocol = study.protocol.model_copy(update={"cohort": cohort})
    return replace(plan, study=replace(study, protocol=protocol, folder=folder))
