"""Tremor is rhythmic, as large and as fast as declared, and the driver beneath stays the same."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal

from lad.command import STILL, Command
from participants.impairments.tremor import HIGHEST, LOWEST, Tremor, amplitude, tremor
from participants.setup import ImpairmentSetup
from protocols.files.errors import InputError
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE


@dataclass(frozen=True)
class Moment:
    """All a tremor needs to know of a sight."""

    t: float


class Steady:
    """A driver who always answers the same, and draws from its own numbers."""

    def __init__(self, command):
        self.command, self.drawn = command, []

    def start_lap(self, lap, rng):
        self.drawn.append(rng.random())

    def act(self, sight):
        return self.command


def stick(severity, frequency, period, *, seconds=60.0, command=STILL, seed=0):
    """Return the impaired commands of one lap, shape (n, 2), as shares of full deflection."""
    shaky = Tremor(Steady(command), severity, frequency, np.random.default_rng(seed))
    shaky.start_lap(0, np.random.default_rng(1))
    steps = [shaky.act(Moment(i * period)) for i in range(round(seconds / period))]
    return np.array(steps) / (MAX_SPEED, MAX_TURN_RATE)


@pytest.mark.parametrize("frequency", [3.0, 5.5, 8.0, 12.0])
def test_the_spectrum_peaks_at_the_frequency(frequency):
    """Half of the power and more lies within 1 Hz of it: rhythmic, not noise."""
    swing = stick(0.5, frequency, period=0.02) @ np.ones(2)
    frequencies, power = signal.welch(swing, fs=50.0, nperseg=256)
    near = np.abs(frequencies - frequency) <= 1.0
    assert abs(frequencies[power.argmax()] - frequency) <= 0.5
    assert power[near].sum() > 0.5 * power.sum()


@pytest.mark.parametrize("severity", [0.25, 0.5, 0.75])
def test_the_swing_is_as_large_as_the_rating_says(severity):
    """Along its line in the stick's plane a slow tremor reaches its amplitude."""
    swing = stick(severity, 3.0, period=0.02)
    reached = np.hypot(*swing.T).max()
    assert reached == pytest.approx(amplitude(severity), rel=0.03)
    assert np.linalg.svd(swing, compute_uv=False)[1] == pytest.approx(0.0, abs=1e-9)


def test_a_rating_point_is_a_factor_of_about_three():
    """Elble et al. (2006): amplitudes of neighbouring ratings are about 10 to the 0.5 apart."""
    ratios = [amplitude((n + 1) / 4) / amplitude(n / 4) for n in (2, 3)]
    assert ratios == pytest.approx([10**0.5] * 2, rel=0.1)


def test_a_step_gets_the_mean_of_the_stick():
    """At 10 Hz control, a tremor of 10 Hz all but vanishes and one of 3 Hz stays."""
    # The first command of a lap has no step behind it to be a mean of.
    slow, fast = (stick(0.75, f, period=0.1)[1:].std() for f in (3.0, 10.0))
    assert fast < 0.1 * slow


@given(st.floats(-0.7, 0.7), st.floats(-0.5, 0.5), st.floats(0.0, 1.0), st.integers(0, 50))
def test_the_stick_stays_within_its_range(v, w, severity, seed):
    """However severe, nothing beyond full deflection is asked of the chair."""
    swing = stick(severity, None, 0.1, seconds=2.0, command=Command(v, w), seed=seed)
    assert (np.abs(swing) <= 1.0 + 1e-12).all()


def test_severity_zero_changes_nothing():
    """A rating of 0 is no tremor."""
    command = Command(0.4, -0.2)
    swing = stick(0.0, 5.0, 0.1, seconds=1.0, command=command)
    assert swing == pytest.approx(np.tile((0.4 / MAX_SPEED, -0.2 / MAX_TURN_RATE), (10, 1)))


def test_each_person_has_a_frequency_of_their_own():
    """Without one in the protocol it is drawn from the whole range; with one it is that."""
    drawn = [Tremor(Steady(STILL), 0.5, None, np.random.default_rng(i)) for i in range(200)]
    frequencies = np.array([person._frequency for person in drawn])
    assert LOWEST <= frequencies.min() < LOWEST + 0.5
    assert HIGHEST - 0.5 < frequencies.max() <= HIGHEST


def test_the_driver_draws_what_it_would_draw_without():
    """The tremor has random numbers of its own: it moves the stick, not the driver's luck."""
    healthy, shaken = Steady(STILL), Steady(STILL)
    healthy.start_lap(0, np.random.default_rng(3))
    Tremor(shaken, 0.5, 5.0, np.random.default_rng(9)).start_lap(0, np.random.default_rng(3))
    assert healthy.drawn == shaken.drawn


def test_the_hand_trembles_while_the_driver_says_nothing_new():
    """The last intention stands, and trembles."""
    driver = Steady(Command(0.5, 0.0))
    shaky = Tremor(driver, 0.75, 3.0, np.random.default_rng(0))
    shaky.start_lap(0, np.random.default_rng(0))
    shaky.act(Moment(0.0))
    driver.command = None
    later = [shaky.act(Moment(0.1 * i)).v for i in range(1, 30)]
    assert np.mean(later) == pytest.approx(0.5, abs=0.05)
    assert np.std(later) > 0.01


def test_the_same_numbers_make_the_same_tremor_and_laps_differ():
    """A tremor is a function of its generator; it does not begin each lap in the same phase."""
    assert np.array_equal(stick(0.5, 4.0, 0.1, seconds=5.0), stick(0.5, 4.0, 0.1, seconds=5.0))
    shaky = Tremor(Steady(STILL), 0.5, 4.0, np.random.default_rng(0))
    begun = []
    for lap in range(2):
        shaky.start_lap(lap, np.random.default_rng(0))
        begun.append(shaky.act(Moment(0.0)))
    assert begun[0] != begun[1]


def test_a_frequency_outside_the_range_is_refused():
    """3 to 12 Hz; the message names the option."""
    setup = ImpairmentSetup(Steady(STILL), 0.5, np.random.default_rng(0), {"frequency_hz": 20})
    with pytest.raises(InputError, match=r"impairment 'tremor': option 'frequency_hz'"):
        tremor(setup)
