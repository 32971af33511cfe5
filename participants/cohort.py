"""The people of a study."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import lru_cache

import numpy as np

from participants.demographics import draw_particulars
from participants.impairments.assignment import assigned
from participants.population import PEOPLE, TRAITS, Marginal
from participants.traits import ResponseStyle, Traits
from protocols.cohort import Cohort, ImpairmentChoice

SEVERITY = "impairment_severity"
"""Name under which the record keeps an impairment's severity among the traits."""


@dataclass(frozen=True, slots=True)
class Person:
    """A participant, as far as we know them.

    Attributes
    ----------
    traits
        How the person drives; None for a living one.
    style
        How the person answers questionnaires; None for a living one.
    age_years
        Age; None until a living person has told it.
    gender, handedness
        As the record has them; None as for the age.
    impairment
        The protocol's impairment that this person has; None for none.
    """

    traits: Traits | None
    style: ResponseStyle | None
    age_years: int | None
    gender: str | None
    handedness: str | None
    impairment: ImpairmentChoice | None = None

    def particulars(self) -> dict[str, int | str]:
        """Return what the person would enter on a form, by field."""
        known = {
            "age_years": self.age_years,
            "gender": self.gender,
            "handedness": self.handedness,
        }
        return {name: value for name, value in known.items() if value is not None}

    def as_numbers(self) -> dict[str, float]:
        """Return every trait by name, for the record; units are part of the names."""
        severity = {} if self.impairment is None else {SEVERITY: self.impairment.severity}
        known = [asdict(of) for of in (self.traits, self.style) if of is not None]
        return {name: value for of in (*known, severity) for name, value in of.items()}

    def living(self) -> "Person":
        """Return a living person in this one's place: nothing is known but the impairment."""
        return Person(None, None, None, None, None, self.impairment)


def draw_person(cohort: Cohort, rng: np.random.Generator) -> Person:
    """Draw a synthetic participant.

    Parameters
    ----------
    cohort
        The protocol's cohort: ages, shares of genders and handedness, impairments, and traits whose
        distribution differs from the calibrated one.
    rng
        This person's own random numbers.

    Raises
    ------
    InputError
        When the cohort's traits do not exist or cannot have such medians.
    """
    for_traits, for_particulars, for_impairment = rng.spawn(3)
    population = PEOPLE.with_marginals(
        {name: Marginal(given.median, given.spread) for name, given in cohort.traits.items()}
    )
    values = population.values(for_traits.normal(size=len(TRAITS)))
    particulars = draw_particulars(cohort.demographics, for_particulars)
    return Person(
        _traits(values),
        _style(values),
        particulars.age_years,
        particulars.gender,
        particulars.handedness,
        assigned(cohort.impairments, for_impairment),
    )


@lru_cache(maxsize=1)
def typical_traits() -> Traits:
    """Return the traits of the median person."""
    return _traits(PEOPLE.values(np.zeros(len(TRAITS))))


def _traits(values: Mapping[str, float]) -> Traits:
    return Traits(**{field.name: values[field.name] for field in fields(Traits)})


def _style(values: Mapping[str, float]) -> ResponseStyle:
    return ResponseStyle(**{field.name: values[field.name] for field in fields(ResponseStyle)})
