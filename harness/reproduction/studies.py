"""Run the paper's experiments, each as the shipped study it is, into one folder."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

from harness.running.runner import Tell, run_study
from harness.session.study_run import StudyRun
from protocols.files.errors import InputError
from protocols.load import resolve_study
from protocols.record.atomic import is_partial, remove_partials
from protocols.record.folder import refuse_another_study
from protocols.record.header import STUDY_FILE
from protocols.record.logs import failure_reason

STUDIES = "studies"
"""The folder of a reproduction that holds its study directories, each by its protocol's name."""

EXPERIMENTS = ("rd-laps", "rd-accuracy", "four-lap")
"""Sections IV.E, IV.D and V of the paper."""

Progress = Callable[[str], AbstractContextManager[Tell]]
"""Shows, under a study's name, how many of its sessions have ended."""


@dataclass(frozen=True, slots=True)
class Experiment:
    """A study of a reproduction, and where it is recorded."""

    run: StudyRun
    folder: Path


def experiments(
    out: Path, seed: int, protocols: Sequence[str] = EXPERIMENTS
) -> tuple[Experiment, ...]:
    """Return the studies of a reproduction.

    Parameters
    ----------
    out
        The reproduction's folder.
    seed
        Of every study; 0 or more.
    protocols
        Shipped protocols, or files.

    Raises
    ------
    InputError
        When a protocol cannot be used.
    """
    runs = (StudyRun(resolve_study(name), seed) for name in protocols)
    return tuple(Experiment(run, out / STUDIES / run.study.protocol.name) for run in runs)


def run_experiments(
    out: Path, planned: Sequence[Experiment], jobs: int, progress: Progress
) -> tuple[str, ...]:
    """Run what is missing of every study; sessions that failed before are run again.

    Parameters
    ----------
    out
        The reproduction's folder; made when it does not exist.
    planned
        Its studies.
    jobs
        Number of processes, 1 or more.
    progress
        Shows how far a study is.

    Returns
    -------
    tuple of str
        A line for each study in which sessions failed.

    Raises
    ------
    InputError
        When ``out`` holds something else, or studies of another seed; nothing is touched then.
    OSError
        When something cannot be written; what was finished is kept.
    """
    refuse_other_folder(out, planned)
    if out.is_dir():
        remove_partials(out)
    lines = [run_experiment(experiment, jobs, progress) for experiment in planned]
    return tuple(line for line in lines if line)


def run_experiment(experiment: Experiment, jobs: int, progress: Progress) -> str | None:
    """Run what is missing of a study; return a line about it when sessions failed.

    Raises
    ------
    InputError
        When its folder holds something else.
    OSError
        When something cannot be written; what was finished is kept.
    """
    with progress(experiment.run.study.protocol.name) as tell:
        outcome = run_study(experiment.run, experiment.folder, jobs, tell, retry_failed=True)
    if not outcome.failed:
        return None
    reason = failure_reason(experiment.folder, outcome.failed[0])
    return (
        f"{experiment.folder}: {len(outcome.failed)} of {outcome.planned} sessions failed "
        f"({outcome.failed[0]}: {reason}); the same command runs them again"
    )


def refuse_other_folder(out: Path, planned: Sequence[Experiment]) -> None:
    """Refuse a folder that is neither empty nor this reproduction's; write nothing.

    Raises
    ------
    InputError
        When it is a file, holds something else, or holds studies that are not the planned ones.
    """
    if out.exists() and not out.is_dir():
        raise InputError(f"{out}: is a file; allowed: a new folder, or this reproduction's")
    for experiment in planned:
        refuse_another_study(experiment.folder, experiment.run.study, experiment.run.seed)
    if (planned[0].folder / STUDY_FILE).exists():
        return
    for place, allowed in ((out, {STUDIES}), (out / STUDIES, {planned[0].folder.name})):
        strangers = sorted(p.name for p in _entries(place) if p.name not in allowed)
        if strangers:
            raise InputError(
                f"{place}: holds something else ({strangers[0]}); "
                "allowed: a new or empty folder, or this reproduction's"
            )


def _entries(folder: Path) -> list[Path]:
    return [p for p in folder.iterdir() if not is_partial(p)] if folder.is_dir() else []
