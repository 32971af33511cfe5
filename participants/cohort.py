"""The people of a study."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import lru_cache

import numpy as np

from participants.demographics import draw_particulars
from participants.population import PRIOR, TRAITS, Population
from participants.traits import ResponseStyle, Traits
from protocols.cohort import Cohort


@dataclass(frozen=True, slots=True)
class Person:
    """A synthetic participant.

    Attributes
    ----------
    traits
        How the person drives.
    style
        How the person answers questionnaires.
    age_years
        Age.
    gender, handedness
        As the record has them.
    """

    traits: Traits
    style: ResponseStyle
    age_years: int
    gender: str
    handedness: str

    def as_numbers(self) -> dict[str, float]:
        """Return every trait by name, for the record; units are part of the names."""
        return {**asdict(self.traits), **asdict(self.style)}


def draw_person(cohort: Cohort, rng: np.random.Generator, population: Population = PRIOR) -> Person:
    """Draw a synthetic participant.

    Parameters
    ----------
    cohort
        The protocol's cohort: what ages, and which shares of genders and hands.
    rng
        This person's own random numbers.
    population
        How traits are distributed.
    """
    for_traits, for_particulars = rng.spawn(2)
    values = population.values(for_traits.normal(size=len(TRAITS)))
    particulars = draw_particulars(cohort.demographics, for_particulars)
    return Person(
        _traits(values),
        _style(values),
        particulars.age_years,
        particulars.gender,
        particulars.handedness,
    )


@lru_cache(maxsize=1)
def typical_traits() -> Traits:
    """Return the traits of the median person."""
    return _traits(PRIOR.values(np.zeros(len(TRAITS))))


def _traits(values: Mapping[str, float]) -> Traits:
    return Traits(**{field.name: values[field.name] for field in fields(Traits)})


def _style(values: Mapping[str, float]) -> ResponseStyle:
    return ResponseStyle(**{field.name: values[field.name] for field in fields(ResponseStyle)})
