"""Who has an impairment: by share, and by their own luck alone."""

import numpy as np
import pytest
from pydantic import ValidationError

from participants.cohort import SEVERITY, draw_person
from participants.impairments.assignment import assigned
from protocols.cohort import Cohort, ImpairmentChoice

TREMOR = ImpairmentChoice(use="tremor", share=0.3, severity=0.5)
WEAKNESS = ImpairmentChoice(use="weakness", share=0.2, severity=0.8)


def test_shares_are_probabilities():
    """Of 5,000 people, 30% tremble, 20% are weak and half have nothing."""
    people = [assigned((TREMOR, WEAKNESS), np.random.default_rng([4, i])) for i in range(5000)]
    counts = [people.count(kind) / len(people) for kind in (TREMOR, WEAKNESS, None)]
    assert counts == pytest.approx([0.3, 0.2, 0.5], abs=0.02)


def test_everybody_and_nobody():
    """A share of 1 is all participants, of 0 none."""
    for seed in range(50):
        rng = np.random.default_rng(seed)
        all_of_them = assigned((ImpairmentChoice(use="tremor", share=1.0),), rng)
        assert all_of_them is not None
        assert assigned((ImpairmentChoice(use="tremor", share=0.0),), rng) is None


def test_an_impairment_changes_nobody_otherwise():
    """Who the person is does not depend on what the protocol does to the body."""
    plain, impaired = Cohort(), Cohort(impairments=(TREMOR,))
    for i in range(20):
        one, other = (draw_person(c, np.random.default_rng([1, i])) for c in (plain, impaired))
        assert one.traits == other.traits
        assert one.age_years == other.age_years


def test_the_record_keeps_the_severity():
    """Among the traits, for those who have an impairment."""
    weak = Cohort(impairments=(ImpairmentChoice(use="weakness", severity=0.7),))
    assert draw_person(weak, np.random.default_rng(0)).as_numbers()[SEVERITY] == 0.7
    assert SEVERITY not in draw_person(Cohort(), np.random.default_rng(0)).as_numbers()


def test_nobody_has_two():
    """Shares that add up to more than 1 are refused."""
    with pytest.raises(ValidationError, match=r"add up to 1\.1; allowed: 1 at most"):
        Cohort(impairments=(TREMOR, ImpairmentChoice(use="weakness", share=0.8)))
