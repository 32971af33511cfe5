"""Ages, genders and hands are drawn from what the protocol says."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from participants.demographics import age_distribution, draw_particulars
from protocols.cohort import AgeRange, Demographics
from protocols.files.errors import InputError


def moments(ages):
    """Return mean and standard deviation of an age distribution, years."""
    years, shares = age_distribution(ages)
    mean = years @ shares
    return mean, np.sqrt((years - mean) ** 2 @ shares)


def test_the_papers_sample():
    """Ages 21 to 38, mean 27, sd 4.91 (section V.B)."""
    years, shares = age_distribution(AgeRange())
    assert (years[0], years[-1]) == (21, 38)
    assert shares.sum() == pytest.approx(1.0)
    assert moments(AgeRange()) == pytest.approx((27.0, 4.91))


@given(st.floats(0.25, 0.75), st.floats(0.05, 0.3))
def test_any_possible_moments_are_met(place, spread):
    """Mean and standard deviation are those asked for, whatever they are."""
    ages = AgeRange(lowest=20, highest=60, mean=20 + 40 * place, sd=40 * spread)
    assert moments(ages) == pytest.approx((ages.mean, ages.sd), rel=1e-6)


def test_impossible_moments_in_whole_years_are_refused():
    """A spread that no mixture of whole years has is an error of the input."""
    with pytest.raises(InputError, match="no distribution over 21 to 22 whole years"):
        age_distribution(AgeRange(lowest=20.5, highest=22.4, mean=21.6, sd=0.05))


def test_shares_come_out_over_many_people():
    """Five of twelve female, one in ten left-handed, categories as in the record."""
    rng = np.random.default_rng(0)
    people = [draw_particulars(Demographics(), rng) for _ in range(4000)]
    assert np.mean([p.gender == "female" for p in people]) == pytest.approx(5 / 12, abs=0.025)
    assert np.mean([p.handedness == "left" for p in people]) == pytest.approx(0.106, abs=0.015)
    assert {p.gender for p in people} == {"female", "male"}
    assert {p.handedness for p in people} == {"left", "right"}
