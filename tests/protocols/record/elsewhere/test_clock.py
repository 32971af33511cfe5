"""Clocks of other programs are brought to the lap's start, or named."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from protocols.record.elsewhere.clock import UNITS, lap_clock

T = np.arange(0, 40, 0.1)


@settings(deadline=None)
@given(
    unit=st.sampled_from(sorted(UNITS)),
    start=st.floats(0, 2e9),
    rate=st.sampled_from([1, 5, 10, 30, 100, 200]),
    lasted=st.floats(5, 300),
)
def test_any_unit_and_moment_gives_the_laps_own_time(unit, start, rate, lasted):
    """Where the lap says how long it took, the steps' time from its start comes back."""
    t = np.arange(0, lasted, 1 / rate)
    clock = lap_clock((t + start) / UNITS[unit], (lasted,))
    assert clock.t_s - clock.t_s[0] == pytest.approx(t, abs=1e-5)
    assert clock.t_s[0] == pytest.approx(0, abs=max(0.5, 5 / rate) + 1e-5)
    assert bool(clock.remarks) == (unit != "s" or clock.t_s[0] != t[0] + start)


def test_a_clock_of_our_own_stays_as_it_is():
    """Not a digit changes, and nothing is said."""
    clock = lap_clock(T, (40.0,))
    assert clock.t_s is T
    assert clock.remarks == ()


def test_a_lap_clock_that_begins_late_stays():
    """The first steps were not recorded: the stamps are the lap's own, and nothing is moved."""
    clock = lap_clock(T[70:], (40.0,))
    assert clock.t_s[0] == T[70]
    assert clock.remarks == ()


@pytest.mark.parametrize("factor", [0.5, 2.0, 60.0, 1e-3])
def test_a_clock_that_contradicts_the_lap_is_no_clock(factor):
    """Nothing says whether steps or lap are right: the times are missing, with a word."""
    clock = lap_clock(factor * T, (40.0,))
    assert np.isnan(clock.t_s).all()
    assert "does not last as long as the lap" in clock.remarks[0]


def test_either_of_two_times_may_agree():
    """A lap time and a duration: the steps go on to the end of the lap, finished or not."""
    assert lap_clock(T, (20.0, 40.0)).remarks == ()


@pytest.mark.parametrize(
    ("t", "said"),
    [(1e3 * T, "milliseconds"), (T + 1.7e9, "time of day"), (T + 900, "another moment")],
)
def test_without_a_lap_time_what_is_plausible_counts(t, said):
    """Steps of a tenth of a second, and not of a hundred seconds."""
    clock = lap_clock(t, ())
    assert clock.t_s == pytest.approx(T, abs=1e-5)
    assert said in clock.remarks[0]


@pytest.mark.parametrize("t", [T[:1], 0 * T, T * np.nan, np.array([])])
def test_no_time_at_all_is_left_to_the_measures(t):
    """One step, a clock that stands still, no stamps: nothing to bring anywhere."""
    assert lap_clock(t, (40.0,)).remarks == ()
