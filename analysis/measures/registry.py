"""Every measure of a lap: its name, unit, meaning and source, beside the function."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from analysis.measures.agreement import agreement, opposition
from analysis.measures.assistance import assisted_fraction, intervention_duration, interventions
from analysis.measures.clearance import minimum_clearance
from analysis.measures.collisions import collisions, contact_time
from analysis.measures.discrimination import brier_score, when_auc
from analysis.measures.driving_time import driving_time
from analysis.measures.fluency import (
    concurrent_activity,
    functional_delay,
    human_idle,
    robot_idle,
)
from analysis.measures.path_deviation import path_deviation
from analysis.measures.path_length import path_length
from analysis.measures.smoothness import log_dimensionless_jerk, sparc
from analysis.measures.streams import Steps
from analysis.measures.timing import missed_onsets, needless_time, onset_lead


@dataclass(frozen=True, slots=True)
class Measure:
    """A measure, as a table and the codebook name it.

    Attributes
    ----------
    name
        Column name.
    title, unit
        For readers; "" for a number without a unit.
    meaning
        One sentence.
    of
        The function.
    source
        Where it comes from; "" for the obvious.
    """

    name: str
    title: str
    unit: str
    meaning: str
    of: Callable[[Steps], float]
    source: str = ""


_HOFFMAN = "Hoffman (2019)"
_SPARC = "Balasubramanian et al. (2015)"
_JERK = "Balasubramanian et al. (2012)"

MEASURES: tuple[Measure, ...] = (
    Measure("driving_time_s", "Driving time", "s", "From start to the end of the lap.",
            driving_time),
    Measure("path_length_m", "Path length", "m", "Length of the driven path.", path_length),
    Measure("path_deviation_m", "Deviation from the centreline", "m",
            "Mean distance from the centreline, weighted by distance driven.", path_deviation),
    Measure("collisions", "Collisions", "", "Unbroken contacts with obstacles.", collisions),
    Measure("contact_time_s", "Time in contact", "s", "Time in contact with obstacles.",
            contact_time),
    Measure("min_clearance_m", "Minimum clearance", "m",
            "Smallest distance between chair and obstacle.", minimum_clearance),
    Measure("assisted_fraction", "Assisted fraction", "",
            "Share of steps in which an assistant's command counted.", assisted_fraction),
    Measure("interventions", "Interventions", "", "Unbroken stretches of assistance.",
            interventions),
    Measure("intervention_duration_s", "Duration of an intervention", "s",
            "Mean duration of an unbroken stretch of assistance.", intervention_duration),
    Measure("onset_lead_s", "Onset lead", "s",
            "How much earlier help began than the shadow demonstrator's would have.", onset_lead),
    Measure("missed_onsets", "Missed onsets", "",
            "Share of the shadow demonstrator's interventions in which no help came.",
            missed_onsets),
    Measure("needless_time_s", "Needless assistance", "s",
            "Assistance while the shadow demonstrator would not have helped.", needless_time),
    Measure("agreement", "Agreement", "",
            "Mean cosine between the user's and the assistant's command while assisted.",
            agreement),
    Measure("opposition", "Opposition", "",
            "Share of assisted steps with more than 90 degrees between the two commands.",
            opposition),
    Measure("sparc_user", "SPARC, user", "", "Spectral arc length of the user's command.",
            partial(sparc, who="intent"), _SPARC),
    Measure("sparc_executed", "SPARC, executed", "",
            "Spectral arc length of the executed command.", partial(sparc, who="executed"),
            _SPARC),
    Measure("ldlj_user", "Log dimensionless jerk, user", "",
            "Log dimensionless jerk of the user's command.",
            partial(log_dimensionless_jerk, who="intent"), _JERK),
    Measure("ldlj_executed", "Log dimensionless jerk, executed", "",
            "Log dimensionless jerk of the executed command.",
            partial(log_dimensionless_jerk, who="executed"), _JERK),
    Measure("human_idle", "Human idle", "", "Share of the lap in which the stick was at rest.",
            human_idle, _HOFFMAN),
    Measure("robot_idle", "Robot idle", "", "Share of the lap without assistance.", robot_idle,
            _HOFFMAN),
    Measure("concurrent_activity", "Concurrent activity", "",
            "Share of the lap in which user and assistant both acted.", concurrent_activity,
            _HOFFMAN),
    Measure("functional_delay", "Functional delay", "",
            "Delay between the agents' successive actions, as a share of the lap; below 0 where "
            "they overlap.", functional_delay, _HOFFMAN),
    Measure("when_auc", "When-AUC", "",
            "Area under the ROC curve of p(h) against the shadow demonstrator.", when_auc),
    Measure("brier", "Brier score", "",
            "Mean squared error of p(h) against the shadow demonstrator.", brier_score,
            "Brier (1950)"),
)  # fmt: skip


def measure(name: str) -> Measure:
    """Return the measure of this name.

    Parameters
    ----------
    name
        As a column of the table of measures has it.

    Raises
    ------
    KeyError
        When there is none.

    Examples
    --------
    >>> measure("path_length_m").unit
    'm'
    """
    for known in MEASURES:
        if known.name == name:
            return known
    raise KeyError(name)
