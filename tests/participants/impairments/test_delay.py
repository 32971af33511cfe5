"""A delayed hand does what was meant, later, in the same order."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import STILL, Command
from participants.impairments.delay import LONGEST_S, Delay, delay
from participants.setup import ImpairmentSetup


class Counting:
    """A driver who says something new in every step, or nothing in some."""

    def __init__(self, silent=()):
        self.silent, self.step = silent, -1

    def start_lap(self, lap, rng):
        self.step = -1

    def act(self, sight):
        self.step += 1
        return None if self.step in self.silent else Command(0.01 * self.step, 0.0)


def drive(driver, steps):
    """Return the commands at ten steps a second."""
    return [driver.act(SimpleNamespace(t=0.1 * i)) for i in range(steps)]


@given(st.integers(0, 12))
def test_commands_arrive_that_many_steps_later(late):
    """The stick rests first; then what was meant, shifted."""
    found = drive(Delay(Counting(), 0.1 * late), 20)
    assert found[:late] == [STILL] * late
    assert [c.v for c in found[late:]] == pytest.approx([0.01 * i for i in range(20 - late)])


def test_silence_holds_the_last_command():
    """Where nothing new was said, what has arrived stands."""
    found = drive(Delay(Counting(silent={3, 4}), 0.2), 8)
    assert [round(c.v, 3) for c in found] == [0, 0, 0, 0.01, 0.02, 0.02, 0.02, 0.05]


def test_a_new_lap_begins_at_rest():
    """Nothing of the last lap is still on its way."""
    driver = Delay(Counting(), 0.3)
    drive(driver, 10)
    driver.start_lap(1, np.random.default_rng(0))
    assert drive(driver, 3) == [STILL] * 3


def test_the_severity_is_the_delay_unless_one_is_given():
    """Severity 1 is LONGEST_S."""
    late = {}
    for name, options in (("severity", {}), ("given", {"delay_s": 0.2})):
        made = delay(ImpairmentSetup(Counting(), 0.5, np.random.default_rng(0), options))
        late[name] = [c.v > 0 for c in drive(made, 12)].index(True)
    assert late == {"severity": int(0.5 * LONGEST_S / 0.1) + 1, "given": 3}
