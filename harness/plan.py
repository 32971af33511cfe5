"""A study to run."""

from dataclasses import dataclass, replace
from pathlib import Path

from protocols.resolved import ResolvedStudy


@dataclass(frozen=True, slots=True)
class Plan:
    """Everything a session depends on, besides the participant's number."""

    study: ResolvedStudy
    seed: int


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
