"""Robustness and generalisation: the studies that `lad-study reproduce --full` adds."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from harness.reproduction.studies import STUDIES, Experiment, Progress, run_experiment
from harness.session.model import make_model
from harness.session.study_run import StudyRun
from protocols.condition import Condition
from protocols.course.schema import Course
from protocols.files.errors import InputError
from protocols.laps import PlannedLap
from protocols.load import load_course, resolve_study
from protocols.model_choice import ModelChoice
from protocols.record.session import MODEL_FILE
from protocols.record.sessions import SESSIONS
from protocols.resolved import ResolvedStudy
from protocols.variants import DEFAULT, VARIANTS, Variant

ROBUSTNESS, GENERALISATION = "robustness", "generalisation"
"""Folders of these studies within the studies' folder: one per variant, one per course."""

TEACHING = ("demonstrator", "model after 1", "further demonstration", "further demonstration",
            "model after 3")  # fmt: skip
"""Laps of a variant's study: those of ``rd-laps`` that one and three demonstrations need."""

ELSEWHERE = ("baseline", "limited", "demonstrator", "model")
"""Laps on a course that the model was not taught on."""

COURSES = ("lab-office-mirror", "ward-corridor")
"""Shipped courses that were used for no calibration and no teaching."""


def full_experiments(out: Path, seed: int, course: Course | None = None) -> tuple[Experiment, ...]:
    """Return the studies of a whole reproduction beside the paper's own, in the order to be run.

    Parameters
    ----------
    out
        The reproduction's folder.
    seed
        Of every study; 0 or more.
    course
        A further course to be driven on.

    Raises
    ------
    InputError
        When a variant's model cannot be made (a baseline without scikit-learn), or the further
        course has a shipped one's name.
    """
    for variant in VARIANTS:
        make_model(variant.model)
    laps = resolve_study("rd-laps")
    if course is not None and course.name in (laps.course.name, *COURSES):
        raise InputError(f"course {course.name}: a shipped course has this name; give it another")
    courses = [load_course(name) for name in COURSES] + ([] if course is None else [course])
    return (
        *(_experiment(out, seed, ROBUSTNESS, v.name, _taught(laps, v)) for v in VARIANTS),
        *(
            _experiment(out, seed, GENERALISATION, c.name, _elsewhere(laps, c, out))
            for c in courses
        ),
    )


def run_full(
    planned: Sequence[Experiment], jobs: int, progress: Progress, say: Callable[[str], None]
) -> tuple[str, ...]:
    """Run what is missing of these studies; return a line for each in which sessions failed.

    Parameters
    ----------
    planned
        As ``full_experiments`` returns them.
    jobs
        Number of processes, 1 or more.
    progress
        Shows how far a study is.
    say
        Called with how long the rest will take, estimated from the first study.

    Raises
    ------
    InputError
        When a folder holds another study.
    OSError
        When something cannot be written; what was finished is kept.
    """
    begun = time.perf_counter()
    lines = [run_experiment(planned[0], jobs, progress)]
    left = [e for e in planned[1:] if not (e.folder / SESSIONS).is_dir()]
    minutes = (time.perf_counter() - begun) * len(left) / 60
    if minutes > 1:
        say(f"{len(left)} more studies: about {minutes:.0f} minutes")
    lines += [run_experiment(experiment, jobs, progress) for experiment in planned[1:]]
    return tuple(line for line in lines if line)


def _experiment(out: Path, seed: int, kind: str, name: str, study: ResolvedStudy) -> Experiment:
    return Experiment(StudyRun(study, seed), out / STUDIES / kind / name)


def _taught(laps: ResolvedStudy, variant: Variant) -> ResolvedStudy:
    """Return the study of lap times with another model and only the laps it needs."""
    conditions = {name: laps.protocol.conditions[name] for name in dict.fromkeys(TEACHING)}
    protocol = laps.protocol.model_copy(
        update={
            "name": f"{ROBUSTNESS} {variant.name}",
            "title": f"Robustness: {variant.group}, {variant.label}",
            "description": "Lap times after one and three demonstrations.",
            "replicates": None,
            "conditions": conditions,
            "laps": tuple(PlannedLap(condition=name) for name in TEACHING),
            "model": variant.model,
            "analyses": (),
        }
    )
    return replace(laps, protocol=protocol)


def _elsewhere(laps: ResolvedStudy, course: Course, out: Path) -> ResolvedStudy:
    """Return a study in which each replicate drives another course with the model it taught."""
    path = f"{{folder}}/{ROBUSTNESS}/{DEFAULT.name}/{SESSIONS}/{{participant}}/{MODEL_FILE}"
    limited = laps.protocol.conditions["limited"]
    conditions = {
        "baseline": Condition(),
        "limited": limited,
        "demonstrator": limited.model_copy(update={"assistant": "demonstrator"}),
        "model": limited.model_copy(update={"assistant": "model"}),
    }
    protocol = laps.protocol.model_copy(
        update={
            "name": f"{GENERALISATION} {course.name}"[:80],
            "title": f"Generalisation: taught on {laps.course.name}, driven on {course.name}",
            "description": "Each replicate drives with the model that three demonstrations of the "
            "default model's robustness study have taught it.",
            "course": course.name,
            "replicates": None,
            "conditions": conditions,
            "laps": tuple(PlannedLap(condition=name) for name in ELSEWHERE),
            "model": ModelChoice(use="lad.trained:load", options={"path": path}),
            "analyses": (),
        }
    )
    return replace(laps, protocol=protocol, course=course, folder=out / STUDIES)
