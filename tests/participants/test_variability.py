"""A demonstrator's variability: nothing at 0, what each field says otherwise."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import Command
from participants.variability import TOUCH_S, USUAL, Variability
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

NONE = dict.fromkeys(
    ("onset_sd_m", "submovements_hz", "submovement_noise", "touches_per_lap", "release_sd",
     "pace_sd"), 0.0,
)  # fmt: skip


def made(seed=0, lap_m=20.0, **fields):
    """Return one lap's variability."""
    return Variability(NONE | fields, lap_m, np.random.default_rng(seed))


def test_zero_makes_no_draw():
    """Without variability the random numbers are not touched: bytes of old studies stay."""
    rng = np.random.default_rng(0)
    still = Variability(NONE, 20.0, rng)
    assert still.intervention() is USUAL
    assert still.in_steps(0.1, Command(0.2, -0.5)) == Command(0.2, -0.5)
    assert not still.touches(0.1, 1.0)
    assert rng.random() == np.random.default_rng(0).random()


def test_interventions_scatter_as_asked():
    """Standard deviations of onset, release and pace are those of the fields."""
    one = made(onset_sd_m=0.3, release_sd=0.2, pace_sd=0.05)
    drawn = [one.intervention() for _ in range(2000)]
    assert np.std([d.onset_m for d in drawn]) == pytest.approx(0.3, rel=0.1)
    assert np.std([d.release for d in drawn]) == pytest.approx(0.2, rel=0.1)
    assert np.std([d.pace for d in drawn]) == pytest.approx(0.05, rel=0.1)
    assert min(d.release for d in drawn) >= 0.0


@given(st.floats(1.0, 5.0), st.integers(0, 1000))
def test_submovements_hold_and_stay_on_the_stick(rate, seed):
    """The hand changes what it does at most so often, and never beyond the stick's ends."""
    one = made(seed, submovements_hz=rate, submovement_noise=0.5)
    said = [one.in_steps(0.1 * i, Command(0.3, -0.01 * i)) for i in range(100)]
    changes = sum(a != b for a, b in pairwise(said))
    assert changes <= 9.9 * rate + 1
    assert all(abs(c.v) <= MAX_SPEED and abs(c.w) <= MAX_TURN_RATE for c in said)


def test_touches_come_as_often_as_asked_and_are_short():
    """Over many laps the mean number is that of the field; each lasts TOUCH_S."""
    counts, lengths = [], []
    for seed in range(150):
        one = made(seed, touches_per_lap=3.0)
        on = np.array([one.touches(0.1 * i, 0.05 * i) for i in range(400)])
        begun = np.flatnonzero(np.diff(on.astype(int)) == 1)
        counts.append(len(begun))
        lengths.append(on.sum() * 0.1)
    assert 2.2 < np.mean(counts) < 3.2
    assert np.sum(lengths) / np.sum(counts) == pytest.approx(TOUCH_S, rel=0.3)
