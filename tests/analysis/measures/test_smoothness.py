"""Spectral arc length and log dimensionless jerk."""

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from analysis.measures.smoothness import log_dimensionless_jerk, sparc, spectral_arc_length
from analysis.measures.streams import Steps
from protocols.wheelchair import MAX_SPEED


def bell(n=101):
    """Return a minimum-jerk speed profile of one second."""
    t = np.linspace(0, 1, n)
    return 30 * t**2 - 60 * t**3 + 30 * t**4


def command(v, period=0.01):
    """Return steps of a translational command, in shares of full deflection."""
    v = np.asarray(v) * MAX_SPEED
    t = np.arange(len(v)) * period
    return Steps(pa.table({"t_s": t, "intent_v": v, "intent_w": np.zeros(len(v))}))


def reference_sparc(speed, fs, padlevel=4, fc=10.0, amp_th=0.05):
    """Return SPARC straight from its published definition, by a different route."""
    nfft = int(2 ** (np.ceil(np.log2(len(speed))) + padlevel))
    frequency = np.arange(0, fs, fs / nfft)
    magnitude = np.abs(np.fft.fft(speed, nfft))
    magnitude = magnitude / magnitude.max()
    below = [i for i in range(nfft) if frequency[i] <= min(fc, fs / 2)]
    above = [i for i in below if magnitude[i] >= amp_th]
    chosen = range(above[0], above[-1] + 1)
    f = [frequency[i] for i in chosen]
    m = [magnitude[i] for i in chosen]
    arc = 0.0
    for i in range(1, len(f)):
        arc += np.sqrt(((f[i] - f[i - 1]) / (f[-1] - f[0])) ** 2 + (m[i] - m[i - 1]) ** 2)
    return -arc


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10_000), st.sampled_from([10.0, 50.0, 100.0]))
def test_sparc_agrees_with_its_definition(seed, rate):
    """Our vectorised SPARC equals the sum as published, for random speed profiles."""
    rng = np.random.default_rng(seed)
    speed = np.abs(np.cumsum(rng.normal(size=rng.integers(20, 300))))
    assert spectral_arc_length(speed, rate) == pytest.approx(reference_sparc(speed, rate))


def test_sparc_of_one_smooth_movement_is_the_published_value():
    """A minimum-jerk movement scores about -1.41 (Balasubramanian et al., 2015)."""
    assert sparc(command(bell()), "intent") == pytest.approx(-1.41, abs=0.01)


def test_interrupting_a_movement_makes_it_less_smooth():
    """Two half movements with a stop between score worse than one, by both measures."""
    whole, halves = command(bell()), command(np.concatenate([bell(51), bell(50)]))
    assert sparc(halves, "intent") < sparc(whole, "intent")
    assert log_dimensionless_jerk(halves, "intent") < log_dimensionless_jerk(whole, "intent")


@pytest.mark.parametrize("factor", [0.1, 0.5])
def test_smoothness_ignores_the_size_of_a_movement(factor):
    """Both are dimensionless: a smaller movement of the same shape is as smooth."""
    small, large = command(factor * bell()), command(bell())
    assert sparc(small, "intent") == pytest.approx(sparc(large, "intent"))
    assert log_dimensionless_jerk(small, "intent") == pytest.approx(
        log_dimensionless_jerk(large, "intent")
    )


def test_jerk_of_a_minimum_jerk_movement_is_the_closed_form():
    """Speed 30 t^2 - 60 t^3 + 30 t^4 has integral jerk^2 = 720 and peak 1.875: ln by hand."""
    expected = -np.log(720 / 1.875**2)
    fine = command(bell(20_001), period=1 / 20_000)
    assert log_dimensionless_jerk(fine, "intent") == pytest.approx(expected, abs=1e-3)


def test_a_command_that_never_changes_has_no_jerk():
    """The logarithm of zero jerk is missing, not infinite."""
    assert np.isnan(log_dimensionless_jerk(command(np.ones(50)), "intent"))


def test_without_times_there_is_no_spectrum():
    """Times that are not numbers make the spectral arc length missing, not an error."""
    table = command(bell()).table
    steps = Steps(table.set_column(0, "t_s", pa.array(np.full(len(table), np.nan))))
    assert np.isnan(sparc(steps, "intent"))
    assert np.isnan(log_dimensionless_jerk(steps, "intent"))
