"""Bursts: none at severity 0, within the stick's range, as often as asked, reproducible."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import Command
from participants.impairments.spasticity import Spasticity, spasticity
from participants.setup import ImpairmentSetup
from protocols.files.errors import InputError
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE


class Steady:
    """A driver who always answers the same."""

    def start_lap(self, lap, rng):
        self.lap = lap

    def act(self, sight):
        return Command(0.4, -0.2)


def lap(impaired, steps=600):
    """Return the commands of a lap at ten steps a second."""
    impaired.start_lap(0, np.random.default_rng(0))
    return np.array([impaired.act(SimpleNamespace(t=0.1 * i)) for i in range(steps)])


def made(severity, seed=0, **options):
    """Return an impaired steady driver."""
    rng = np.random.default_rng(seed)
    return spasticity(ImpairmentSetup(Steady(), severity, rng, options))


def test_severity_zero_changes_nothing():
    """Without severity every command is the driver's."""
    assert (lap(made(0.0)) == (0.4, -0.2)).all()


@given(st.floats(0.1, 1.0), st.integers(0, 1000))
def test_commands_stay_on_the_stick(severity, seed):
    """No burst pushes beyond the stick's ends."""
    found = np.abs(lap(made(severity, seed, bursts_per_s=2.0), 60))
    assert (found <= (MAX_SPEED, MAX_TURN_RATE)).all()


def test_bursts_come_as_often_as_asked_and_pass():
    """At one in ten seconds the hand is mostly the driver's; at two in a second hardly ever."""
    off = [
        np.mean(
            np.abs(lap(Spasticity(Steady(), 1.0, r, np.random.default_rng(1)))[:, 0] - 0.4) > 0.02
        )
        for r in (0.1, 2.0)
    ]
    assert 0.02 < off[0] < 0.4
    assert off[1] > 0.6


def test_laps_differ_and_sessions_repeat():
    """Each lap has bursts of its own; the same numbers give the same session."""
    one, other = made(0.8, 3), made(0.8, 3)
    first, second = lap(one), lap(one)
    assert not np.array_equal(first, second)
    assert np.array_equal(first, lap(other))


def test_options_are_checked():
    """A negative rate is refused in one line."""
    with pytest.raises(InputError, match="bursts_per_s"):
        made(0.5, bursts_per_s=-1)
