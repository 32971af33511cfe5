"""People leave: rarely, for a reason, and the sooner the less patient they are."""

import numpy as np
import pytest

from participants.driver import WithdrewError
from participants.human.patience import THINKING_IT_OVER, UNWELL_EVERY, Patience


def left(patience, seed, until=300.0, period=0.5):
    """Return when and why a person left a lap; None when they did not."""
    person = Patience(patience, np.random.default_rng(seed))
    for t in np.arange(0.0, until, period):
        try:
            person.check(t)
        except WithdrewError as why:
            return t, str(why)
    return None


def test_nobody_loses_patience_before_it_is_due():
    """Giving up begins after the patience, and takes its declared time on average."""
    ends = [left(100.0, seed, until=600.0) for seed in range(400)]
    times = [t for t, why in ends if why == "this takes too long"]
    assert min(times) >= 100.0
    assert np.mean(times) - 100.0 == pytest.approx(THINKING_IT_OVER, rel=0.2)


def test_feeling_unwell_is_rare_and_has_no_memory():
    """In laps of five minutes its share is what the constant hazard says, early as late."""
    people, until = 4000, 300.0
    ends = [left(1e9, seed, until=until, period=5.0) for seed in range(people)]
    times = np.array([end[0] for end in ends if end is not None])
    assert {end[1] for end in ends if end is not None} == {"I do not feel well"}
    expected = people * -np.expm1(-until / UNWELL_EVERY)
    assert len(times) == pytest.approx(expected, abs=3 * np.sqrt(expected))
    assert abs((times < until / 2).sum() - len(times) / 2) < 3 * np.sqrt(len(times)) / 2


def test_the_same_numbers_make_the_same_lap():
    """When a person leaves follows from the lap's generator."""
    assert left(50.0, 3) == left(50.0, 3)
