"""How traits are distributed over people.

Every trait is a standard normal latent variable mapped into the trait's range: a value halfway
through the range on the logit scale for the median person, spread on that scale. The latent
variables are correlated between people: a person who reacts late also tends to drive slowly.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from participants.traits import ResponseStyle, Trait, Traits, declared
from protocols.files.errors import InputError

TRAITS: Mapping[str, Trait] = {**declared(Traits), **declared(ResponseStyle)}
"""Every trait, by name."""


@dataclass(frozen=True, slots=True)
class Marginal:
    """The distribution of one trait: logit-normal over the trait's range.

    Attributes
    ----------
    median
        The median person's value, in the trait's unit; strictly within its range.
    spread
        Standard deviation on the logit scale; 0 when all people are alike.
    """

    median: float
    spread: float

    def value(self, trait: Trait, z: float) -> float:
        """Return the trait of a person whose latent variable is ``z``.

        Examples
        --------
        >>> Marginal(median=0.25, spread=1.0).value(Trait(0.0, 1.0, ""), 0.0)
        0.25
        """
        share = (self.median - trait.low) / (trait.high - trait.low)
        logit = math.log(share / (1.0 - share)) + self.spread * z
        return trait.low + (trait.high - trait.low) / (1.0 + math.exp(-logit))


@dataclass(frozen=True)
class Population:
    """A distribution of people.

    Attributes
    ----------
    marginals
        One for every trait.
    correlations
        Of the latent variables, by pairs of names; pairs that are not named do not correlate.

    Raises
    ------
    InputError
        When a trait is missing or unknown, a median lies outside the range, or the correlations
        contradict each other.
    """

    marginals: Mapping[str, Marginal]
    correlations: Mapping[tuple[str, str], float]

    def __post_init__(self) -> None:
        wrong = set(self.marginals) ^ set(TRAITS)
        if wrong:
            raise InputError(
                f"population: {', '.join(sorted(wrong))}: missing or unknown; "
                f"allowed: exactly {', '.join(TRAITS)}"
            )
        for name, marginal in self.marginals.items():
            trait = TRAITS[name]
            if not (trait.low < marginal.median < trait.high and marginal.spread >= 0.0):
                raise InputError(
                    f"population: {name}: median {marginal.median:g}, spread {marginal.spread:g}; "
                    f"allowed: a median within {trait.low:g} to {trait.high:g}, "
                    "a spread of 0 or more"
                )
        _ = self.cholesky

    @cached_property
    def cholesky(self) -> NDArray[np.float64]:
        """Lower triangle L with L L^T the latent correlations, in the order of ``TRAITS``."""
        names = list(TRAITS)
        matrix = np.eye(len(names))
        for (one, other), value in self.correlations.items():
            i, j = names.index(one), names.index(other)
            matrix[i, j] = matrix[j, i] = value
        try:
            return np.linalg.cholesky(matrix).astype(np.float64)
        except np.linalg.LinAlgError:
            raise InputError(
                "population: the correlations contradict each other; "
                "allowed: a positive definite matrix"
            ) from None

    def with_marginals(self, others: Mapping[str, Marginal]) -> "Population":
        """Return a population in which some traits have another distribution.

        Raises
        ------
        InputError
            When a trait does not exist, or a median lies outside its range.
        """
        return replace(self, marginals={**self.marginals, **others}) if others else self

    def values(self, latent: NDArray[np.float64]) -> dict[str, float]:
        """Return the traits of a person.

        Parameters
        ----------
        latent
            Shape (number of traits,): independent standard normal numbers; zeros make the median
            person.
        """
        z = self.cholesky @ latent
        return {
            name: self.marginals[name].value(trait, float(z[i]))
            for i, (name, trait) in enumerate(TRAITS.items())
        }


PEOPLE = Population(
    marginals={
        "preferred_speed_m_s": Marginal(0.55, 0.8),
        "lookahead_s": Marginal(2.0, 0.4),
        "reaction_delay_s": Marginal(0.25, 0.4),
        "stick_lag_s": Marginal(0.12, 0.4),
        "steering_gain_per_s": Marginal(1.4, 0.35),
        "motor_noise": Marginal(0.06, 0.4),
        "corner_speed_m_s": Marginal(0.18, 0.8),
        "corner_deflection": Marginal(0.9, 1.0),
        "corner_pause_s": Marginal(1.0, 0.7),
        "clearance_m": Marginal(0.15, 0.4),
        "lane_offset_m": Marginal(0.0, 0.4),
        "inexperience": Marginal(0.465, 1.4477),
        "corner_share": Marginal(0.6, 0.8),
        "practice_exponent": Marginal(0.5, 0.5),
        "compliance": Marginal(0.25, 0.8),
        "adaptation_per_s": Marginal(0.8, 0.5),
        "limit_push": Marginal(0.75, 1.0),
        "limit_pause_s": Marginal(1.2702, 2.0082),
        "patience_s": Marginal(400.0, 0.6),
        "acquiescence": Marginal(0.2, 0.3),
        "extremity": Marginal(1.0, 0.35),
        "liking": Marginal(0.0, 0.4),
        "missing_share": Marginal(0.002, 1.0),
    },
    correlations={
        ("preferred_speed_m_s", "reaction_delay_s"): -0.3,
        ("preferred_speed_m_s", "corner_speed_m_s"): 0.5,
        ("preferred_speed_m_s", "clearance_m"): -0.4,
        ("preferred_speed_m_s", "inexperience"): -0.4,
        ("reaction_delay_s", "stick_lag_s"): 0.3,
        ("reaction_delay_s", "steering_gain_per_s"): -0.4,
        ("motor_noise", "inexperience"): 0.3,
        ("corner_speed_m_s", "inexperience"): -0.3,
        ("clearance_m", "inexperience"): 0.3,
        ("limit_push", "inexperience"): -0.5,
        ("limit_pause_s", "inexperience"): 0.7,
        ("limit_pause_s", "limit_push"): -0.4,
        ("limit_pause_s", "corner_deflection"): -0.3,
        ("limit_push", "corner_deflection"): 0.3,
        ("corner_deflection", "inexperience"): -0.4,
        ("compliance", "liking"): 0.3,
    },
)
"""The people a synthetic cohort is drawn from.

Medians and spreads of inexperience and of the pause when limited are calibrated
(``bench/calibrate_cohort.py``); those of the practice exponent and of the corners' share are
priors. docs/cohort.md lists the source of every other number, and which are assumptions.
"""
