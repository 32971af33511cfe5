"""What a lap impresses, and what the statements make of it."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from participants.loadings import DRIVING_ASSISTANCE, KNOWN, impression
from participants.survey import LapExperience
from protocols.load import load_instrument, shipped_instruments

CALM = LapExperience(50.0, 50.0, 0.0, 0, 0.0, 0, completed=True)


def test_a_lap_like_ones_baseline_impresses_nothing():
    """All impressions are differences from the own baseline, without help and harm."""
    assert set(impression(CALM).values()) == {0.0}
    assert set(impression(replace(CALM, baseline_time=None)).values()) == {0.0}


@given(
    st.floats(1.0, 600.0),
    st.floats(0.0, 1.0),
    st.floats(0.0, 1.0),
    st.integers(0, 50),
    st.integers(0, 50),
)
def test_impressions_are_bounded_where_they_are_shares(time, assisted, opposed, stops, hits):
    """Help and opposition stay within 0 and 1, whatever happened."""
    felt = impression(LapExperience(time, 50.0, assisted, stops, opposed, hits, completed=False))
    assert 0.0 <= felt["help"] <= 1.0
    assert 0.0 <= felt["opposition"] <= 1.0
    assert felt["collisions"] <= 5
    assert felt["unfinished"] == 1.0


def test_twice_as_slow_is_as_far_as_half_as_slow():
    """Slowness is a ratio."""
    slow = impression(replace(CALM, lap_time=100.0))["slowness"]
    quick = impression(replace(CALM, lap_time=25.0))["slowness"]
    assert slow == pytest.approx(-quick)


@pytest.mark.parametrize(
    ("worse", "lowers", "raises"),
    [
        ({"lap_time": 100.0}, ("Q1", "Q3", "Q7", "Q11"), ("Q2", "Q4")),
        ({"collisions": 3}, ("Q1", "Q3"), ("Q2", "Q4", "Q9")),
        (
            {"assisted_fraction": 0.3, "interference": 0.3},
            ("Q10",),
            ("Q2", "Q6", "Q9"),
        ),
    ],
)
def test_signs_follow_the_statements(worse, lowers, raises):
    """A worse lap is easier to call difficult and harder to call easy."""
    felt, calm = impression(replace(CALM, **worse)), impression(CALM)
    for item in lowers:
        loadings = DRIVING_ASSISTANCE[item]
        assert loadings.latent(felt, 0.0) < loadings.latent(calm, 0.0)
    for item in raises:
        loadings = DRIVING_ASSISTANCE[item]
        assert loadings.latent(felt, 0.0) > loadings.latent(calm, 0.0)


def test_every_shipped_instrument_is_known():
    """A respondent can answer every item that is shipped."""
    for name in shipped_instruments():
        assert set(KNOWN[name]) == {item.id for item in load_instrument(name).items}
