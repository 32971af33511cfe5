"""Traits of a population: in range, around their medians, correlated as declared."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from participants.population import PEOPLE, TRAITS, Marginal, Population
from protocols.files.errors import InputError

N = len(TRAITS)


@pytest.fixture(scope="module")
def many():
    """Draw the traits of 4,000 people."""
    rng = np.random.default_rng(0)
    people = [PEOPLE.values(rng.normal(size=N)) for _ in range(4000)]
    return {name: np.array([person[name] for person in people]) for name in TRAITS}


@given(st.lists(st.floats(-8.0, 8.0), min_size=N, max_size=N))
def test_nobody_is_outside_a_range(latent):
    """However unusual a person, every trait is one a person can have."""
    for name, value in PEOPLE.values(np.array(latent)).items():
        assert TRAITS[name].low <= value <= TRAITS[name].high


def test_the_median_person_has_the_medians():
    """Zeros make the medians that are declared."""
    for name, value in PEOPLE.values(np.zeros(N)).items():
        assert value == pytest.approx(PEOPLE.marginals[name].median)


def test_half_of_the_people_are_below_the_median(many):
    """The squeezing keeps medians."""
    for name, values in many.items():
        below = np.mean(values < PEOPLE.marginals[name].median)
        assert below == pytest.approx(0.5, abs=0.035)


def test_people_are_correlated_as_declared(many):
    """Rank correlations are those of the declared latent normal ones (Pearson, 1907)."""
    for (one, other), rho in PEOPLE.correlations.items():
        expected = 6 / np.pi * np.arcsin(rho / 2)
        found = stats.spearmanr(many[one], many[other]).statistic
        assert found == pytest.approx(expected, abs=0.06)


def test_without_spread_all_are_alike():
    """A population can fix a trait for all people."""
    fixed = {**PEOPLE.marginals, "practice_exponent": Marginal(0.3, 0.0)}
    values = Population(fixed, PEOPLE.correlations).values(np.full(N, 2.0))
    assert values["practice_exponent"] == pytest.approx(0.3)


def test_contradicting_correlations_are_refused():
    """A cannot go with B and C while these go against each other."""
    names = list(TRAITS)[:3]
    pairs = {(names[0], names[1]): 0.9, (names[0], names[2]): 0.9, (names[1], names[2]): -0.9}
    with pytest.raises(InputError, match="contradict each other"):
        replace(PEOPLE, correlations=pairs)


def test_a_missing_trait_and_an_impossible_median_are_refused():
    """A population is complete, and its medians are values a person can have."""
    some = dict(PEOPLE.marginals)
    some.pop("compliance")
    with pytest.raises(InputError, match="compliance: missing or unknown"):
        replace(PEOPLE, marginals=some)
    with pytest.raises(InputError, match="preferred_speed_m_s: median 3"):
        replace(PEOPLE, marginals={**PEOPLE.marginals, "preferred_speed_m_s": Marginal(3.0, 1.0)})
