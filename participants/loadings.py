"""What moves a synthetic respondent's answers, item by item.

Assumptions of the simulation, not findings: their signs follow from the statements, their
sizes are round numbers in units of the latent answer's noise. Whatever percentage of agreement a
simulated study shows is a consequence of this table.
"""

import math
from collections.abc import Mapping
from typing import Annotated

from pydantic import Field

from participants.options import Options
from participants.survey import LapExperience

Weight = Annotated[float, Field(ge=-10, le=10)]

MOST_COLLISIONS = 5
"""More contacts than these change no answer further."""

MUCH_HELP = 0.25
"""Assistance in this share of the steps or more counts fully."""


class Loadings(Options):
    """How one item's latent answer depends on the experience of the lap.

    Attributes
    ----------
    intercept
        Latent answer to a lap like the respondent's own baseline; 0 is the middle of the scale.
    slowness
        Per unit of the logarithm of lap time over the respondent's own baseline lap time.
    help
        For a lap with full assistance, against a lap without any.
    opposition
        For assistance that always opposed the driver, against assistance that never did.
    interruptions
        Per unit of the logarithm of one plus the number of interventions.
    collisions
        Per contact with an obstacle.
    unfinished
        For a lap that did not reach the finish.
    liking
        Per unit of the respondent's own liking of assistance.
    """

    intercept: Weight = 0.0
    slowness: Weight = 0.0
    help: Weight = 0.0
    opposition: Weight = 0.0
    interruptions: Weight = 0.0
    collisions: Weight = 0.0
    unfinished: Weight = 0.0
    liking: Weight = 0.0

    def latent(self, impression: Mapping[str, float], liking: float) -> float:
        """Return the latent answer without a person's response style and noise."""
        weights: dict[str, float] = self.model_dump()
        felt = sum(weights[name] * value for name, value in impression.items())
        return self.intercept + felt + self.liking * liking


def impression(experience: LapExperience) -> dict[str, float]:
    """Return the experience of a lap in the terms of ``Loadings``.

    Examples
    --------
    >>> lap = LapExperience(
    ...     lap_time=60.0, baseline_time=60.0, assisted_fraction=0.0, interventions=0,
    ...     interference=0.0, collisions=0, completed=True,
    ... )
    >>> sorted(set(impression(lap).values()))
    [0.0]
    """
    baseline = (
        experience.baseline_time if experience.baseline_time is not None else experience.lap_time
    )
    assisted = experience.assisted_fraction
    return {
        "slowness": math.log(experience.lap_time / baseline),
        "help": min(assisted / MUCH_HELP, 1.0),
        "opposition": min(experience.interference / assisted, 1.0) if assisted > 0.0 else 0.0,
        "interruptions": math.log1p(experience.interventions),
        "collisions": float(min(experience.collisions, MOST_COLLISIONS)),
        "unfinished": float(not experience.completed),
    }


DRIVING_ASSISTANCE: Mapping[str, Loadings] = {
    "Q1": Loadings(intercept=1.1, slowness=-2.2, collisions=-0.4, unfinished=-1.0),
    "Q2": Loadings(intercept=-1.2, slowness=2.4, opposition=1.0, collisions=0.4, unfinished=1.0),
    "Q3": Loadings(intercept=0.9, slowness=-1.8, collisions=-0.5, unfinished=-1.5),
    "Q4": Loadings(intercept=-0.4, slowness=2.0, collisions=0.4, unfinished=1.0),
    "Q5": Loadings(intercept=-0.4, help=1.6, slowness=-1.5, opposition=-1.5, liking=1.0),
    "Q6": Loadings(intercept=-1.4, opposition=2.5, interruptions=0.2, collisions=0.3, liking=-0.5),
    "Q7": Loadings(intercept=-0.3, help=2.0, slowness=-2.0, opposition=-0.8, liking=0.5),
    "Q8": Loadings(
        intercept=-0.2, help=1.4, slowness=-1.2, opposition=-1.2, interruptions=-0.2, liking=0.5
    ),
    "Q9": Loadings(intercept=-1.3, opposition=2.0, slowness=0.6, collisions=0.4, liking=-0.5),
    "Q10": Loadings(intercept=0.2, slowness=-1.0, help=-0.6, collisions=-0.3, liking=-0.3),
    "Q11": Loadings(intercept=-0.2, help=1.2, slowness=-1.0, opposition=-1.2, liking=1.0),
}
"""The eleven statements of Soh & Demiris (2013), section V.A."""

_USABLE = Loadings(intercept=0.6, slowness=-1.2, help=0.6, opposition=-1.5, liking=0.6)
_UNUSABLE = Loadings(intercept=-0.6, slowness=1.2, help=-0.4, opposition=1.5, liking=-0.6)

SUS: Mapping[str, Loadings] = {f"S{i}": _USABLE if i % 2 else _UNUSABLE for i in range(1, 11)}
"""The System Usability Scale: every item alike, the even ones turned."""

NASA_TLX: Mapping[str, Loadings] = {
    "mental": Loadings(intercept=-0.4, slowness=1.2, opposition=0.8, collisions=0.2),
    "physical": Loadings(intercept=-1.0, slowness=0.8, opposition=0.4),
    "temporal": Loadings(intercept=-0.6, slowness=0.6, help=-0.2),
    "performance": Loadings(intercept=-0.6, slowness=1.4, collisions=0.5, unfinished=1.5),
    "effort": Loadings(intercept=-0.2, slowness=1.4, help=-0.4, opposition=1.0),
    "frustration": Loadings(intercept=-0.8, slowness=1.6, opposition=1.5, collisions=0.4),
}
"""The six lines of the NASA Task Load Index."""

KNOWN: Mapping[str, Mapping[str, Loadings]] = {
    "driving-assistance": DRIVING_ASSISTANCE,
    "sus": SUS,
    "nasa-tlx": NASA_TLX,
}
"""Loadings by instrument and item."""
