"""Weakness scales what the hand does, and nothing else."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import Command
from participants.impairments.weakness import LEAST, Weakness


class Steady:
    """A driver who always answers the same."""

    def __init__(self, command):
        self.command, self.laps = command, []

    def start_lap(self, lap, rng):
        self.laps.append(lap)

    def act(self, sight):
        return self.command


@given(st.floats(-0.7, 0.7), st.floats(-0.5, 0.5), st.floats(0.0, 1.0))
def test_both_directions_are_scaled_alike(v, w, severity):
    """The stick's direction stays, its deflection shrinks in proportion to the severity."""
    share = 1.0 - severity * (1.0 - LEAST)
    assert Weakness(Steady(Command(v, w)), severity).act(None) == Command(share * v, share * w)


def test_severity_goes_from_nothing_to_a_remainder():
    """At 0 the driver is as before; at 1 a tenth is left, so laps can still end."""
    whole = Command(0.7, -0.5)
    assert Weakness(Steady(whole), 0.0).act(None) == whole
    assert Weakness(Steady(whole), 1.0).act(None) == pytest.approx((0.07, -0.05))


def test_silence_stays_silence_and_laps_are_passed_on():
    """A driver with nothing new to say says nothing; it hears of every lap."""
    driver = Steady(None)
    impaired = Weakness(driver, 0.5)
    impaired.start_lap(3, np.random.default_rng(0))
    assert impaired.act(None) is None
    assert driver.laps == [3]
