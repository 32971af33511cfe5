"""A bias pulls to one side, by its severity, and leaves a stick at rest alone."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import STILL, Command
from participants.impairments.bias import WORST, Bias, bias
from participants.setup import ImpairmentSetup
from protocols.wheelchair import MAX_TURN_RATE


class Steady:
    """A driver who always answers the same."""

    def __init__(self, command):
        self.command = command

    def start_lap(self, lap, rng):
        self.lap = lap

    def act(self, sight):
        return self.command


def made(command, severity, seed=0, **options):
    """Return a biased steady driver."""
    return bias(ImpairmentSetup(Steady(command), severity, np.random.default_rng(seed), options))


def test_the_side_that_is_asked_for_and_the_size_of_the_severity():
    """Left is positive; severity 1 is WORST of full deflection."""
    assert made(Command(0.7, 0.0), 1.0, side="left").act(None).w == WORST * MAX_TURN_RATE
    assert made(Command(0.7, 0.0), 0.5, side="right").act(None).w == -0.5 * WORST * MAX_TURN_RATE


def test_people_have_sides_of_their_own():
    """Without a side asked for, both occur, each person keeping one."""
    found = {float(np.sign(made(Command(0.7, 0.0), 1.0, s).act(None).w)) for s in range(12)}
    assert found == {-1.0, 1.0}


@given(st.floats(-0.7, 0.7), st.floats(-0.5, 0.5), st.floats(-0.2, 0.2))
def test_speed_is_kept_and_the_stick_has_an_end(v, w, pull):
    """Only turning is changed, and never beyond full deflection."""
    found = Bias(Steady(Command(v, w)), pull).act(None)
    assert found.v == v
    assert abs(found.w) <= MAX_TURN_RATE


def test_nothing_said_and_nothing_pushed_stay_so():
    """A stick at rest is not pulled; silence is silence."""
    assert Bias(Steady(STILL), 0.2).act(None) == STILL
    assert Bias(Steady(None), 0.2).act(None) is None


def test_a_drift_grows_with_speed():
    """With drift 1 half the speed has half the pull."""
    assert Bias(Steady(Command(0.35, 0.0)), 0.2, 1.0).act(None).w == pytest.approx(0.1)
