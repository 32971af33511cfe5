"""Why the numbers differ: the studies that `lad-study reproduce --why` adds."""

from dataclasses import replace
from pathlib import Path

from harness.reproduction.full import TEACHING
from harness.reproduction.studies import STUDIES, Experiment
from harness.session.model import make_model
from harness.session.study_run import StudyRun
from protocols.cohort import DemonstratorChoice
from protocols.explanations import EXPLANATIONS, Explanation
from protocols.laps import PlannedLap
from protocols.load import resolve_study
from protocols.resolved import ResolvedStudy

WHY = "why"
"""The folder of these studies within the studies' folder: one per explanation."""


def why_experiments(out: Path, seed: int) -> tuple[Experiment, ...]:
    """Return a study for every declared explanation, all with the same random numbers.

    Parameters
    ----------
    out
        The reproduction's folder.
    seed
        Of every study; 0 or more.

    Raises
    ------
    InputError
        When a model cannot be made (nearest neighbours without scikit-learn).
    """
    for explanation in EXPLANATIONS:
        make_model(explanation.model)
    return tuple(
        Experiment(StudyRun(_study(e), seed), out / STUDIES / WHY / e.name) for e in EXPLANATIONS
    )


def _study(explanation: Explanation) -> ResolvedStudy:
    """Return the shipped study with the explanation's change, and only the laps it needs."""
    study = resolve_study(explanation.study)
    protocol = study.protocol
    cohort, driver = protocol.cohort, protocol.cohort.driver
    options = {**driver.options, **explanation.driver}
    shown = DemonstratorChoice(options=dict(explanation.demonstrator))
    people = {
        "driver": driver.model_copy(update={"options": options}),
        "demonstrator": shown,
        "respondent": None,
    }
    names = dict.fromkeys(TEACHING) if explanation.study == "rd-laps" else protocol.conditions
    order = TEACHING if explanation.study == "rd-laps" else [p.condition for p in protocol.laps]
    practised = {planned.condition for planned in protocol.laps if planned.practice}
    changes = {
        "name": f"{WHY} {explanation.name}",
        "title": f"Why the numbers differ: {explanation.supposition}",
        "description": "One declared explanation, run.",
        "replicates": None,
        "cohort": cohort.model_copy(update=people),
        "conditions": {name: protocol.conditions[name] for name in names},
        "laps": tuple(PlannedLap(condition=n, practice=n in practised) for n in order),
        "model": explanation.model,
        "laser": protocol.laser.model_copy(update={"model_reach_m": explanation.laser_m}),
        "analyses": (),
    }
    return replace(study, protocol=protocol.model_copy(update=changes), instruments=())
