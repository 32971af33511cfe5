"""Why our numbers could differ from the paper's: suppositions, each one a study to run."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from lad.hyperparameters import LADParameters
from protocols.model_choice import ModelChoice
from protocols.wheelchair import LASER_RANGE


@dataclass(frozen=True, slots=True)
class Explanation:
    """A supposition, and what is changed to test it.

    Attributes
    ----------
    name
        Unique; usable as a folder's name.
    supposition
        What would have to be true, in words.
    study
        Which shipped protocol is run with the change.
    demonstrator
        Options of the attentive demonstrator.
    driver
        Options of the driver, besides the protocol's.
    model
        In place of the protocol's.
    laser_m
        The farthest that the model's laser segments say, m.
    """

    name: str
    supposition: str
    study: Literal["rd-laps", "four-lap"] = "rd-laps"
    demonstrator: Mapping[str, Any] = field(default_factory=dict)
    driver: Mapping[str, Any] = field(default_factory=dict)
    model: ModelChoice = field(default_factory=ModelChoice)
    laser_m: float = LASER_RANGE


HAND: Mapping[str, Any] = {
    "onset_sd_m": 0.3,
    "submovements_hz": 2.5,
    "submovement_noise": 0.2,
    "h_lag_s": 0.15,
}
"""A hand that corrects in steps, begins its turns with scatter, and signals a little late."""

EXPLANATIONS: tuple[Explanation, ...] = (
    Explanation("shipped", "nothing: the study as it is"),
    Explanation(
        "onsets",
        "the demonstrator's takeovers scatter as a person's do",
        demonstrator={"onset_sd_m": 0.3, "reaction_s": 0.7, "reaction_spread": 0.5},
    ),
    Explanation("hand", "the demonstrator steers with a human hand", demonstrator=HAND),
    Explanation(
        "scatter",
        "the demonstrator differs from lap to lap in everything",
        demonstrator={**HAND, "touches_per_lap": 1.0, "release_sd": 0.2, "pace_sd": 0.05},
    ),
    Explanation(
        "reach",
        "Table I has squared lengthscales, M = diag(l)^-1: the kernel reaches farther",
        model=ModelChoice(
            parameters=LADParameters(lengthscale_user=0.1**0.5, lengthscale_laser=2.0**0.5)
        ),
    ),
    Explanation("laser", "the model's laser ends at 2 m", laser_m=2.0),
    Explanation(
        "neighbours",
        "the model asks its five nearest neighbours (nobody says that the paper's does)",
        model=ModelChoice(use="neighbours"),
    ),
    Explanation(
        "correction",
        "the model learns a - u instead of a (nobody says that the paper's does)",
        model=ModelChoice(use="lad-correction"),
    ),
    Explanation("people", "nothing: people as they are", "four-lap"),
    Explanation(
        "stick",
        "people give up the stick to a person (.75) and hold it against a machine (0)",
        "four-lap",
        driver={"compliance_to_person": 0.75, "compliance_to_machine": 0.0},
    ),
    Explanation(
        "stick-to-both",
        "people give up the stick to both (.75)",
        "four-lap",
        driver={"compliance_to_person": 0.75, "compliance_to_machine": 0.75},
    ),
)
"""Declared before they were run. ``neighbours`` and ``correction`` are no explanations: they stand
beside Table I on the same laps."""
