"""A person is drawn whole, from a generator of their own."""

from dataclasses import fields

import numpy as np

from participants.cohort import draw_person, typical_traits
from participants.population import PEOPLE, TRAITS
from participants.traits import Traits
from protocols.cohort import AgeRange, Cohort, Demographics


def test_the_same_numbers_make_the_same_person():
    """A person follows from cohort and generator alone."""
    one, same, other = (draw_person(Cohort(), np.random.default_rng(s)) for s in (1, 1, 2))
    assert one == same
    assert one != other


def test_the_record_holds_every_trait():
    """Driving traits and response style, by their names."""
    numbers = draw_person(Cohort(), np.random.default_rng(0)).as_numbers()
    assert list(numbers) == list(TRAITS)
    assert all(isinstance(value, float) for value in numbers.values())


def test_demographics_do_not_move_traits():
    """Another age range draws other ages, for the same drivers."""
    old = Cohort(
        demographics=Demographics(age_years=AgeRange(lowest=60, highest=90, mean=75, sd=6))
    )
    young_person = draw_person(Cohort(), np.random.default_rng(5))
    old_person = draw_person(old, np.random.default_rng(5))
    assert old_person.traits == young_person.traits
    assert old_person.age_years >= 60 > young_person.age_years


def test_the_typical_person_has_median_traits():
    """Drivers without a person are driven by the median one."""
    traits = typical_traits()
    for field in fields(Traits):
        median = PEOPLE.marginals[field.name].median
        assert abs(getattr(traits, field.name) - median) < 1e-9
