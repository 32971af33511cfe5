"""The hand follows late, trembles in proportion, smoothly, and not at the stick's end."""

import numpy as np
import pytest

from lad.command import STILL, Command
from participants.human.stick import Stick
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE


def hold(intention, noise, seconds=200.0, seed=0):
    """Return the commands of a hand that holds one intention, shape (n, 2)."""
    lever = Stick(0.15, noise, np.random.default_rng(seed))
    return np.array([lever.move(intention, 0.1) for _ in range(int(seconds * 10))])


def test_a_steady_hand_follows_exponentially():
    """Without noise the stick covers 1 - 1/e of the way in one time constant."""
    lever = Stick(0.2, 0.0, np.random.default_rng(0))
    for _ in range(2):
        command = lever.move(Command(0.5, 0.0), 0.1)
    assert command.v == pytest.approx(0.5 * (1 - np.exp(-1)))


@pytest.mark.parametrize("v", [0.2, 0.4])
def test_noise_grows_with_the_signal(v):
    """The standard deviation is about the given share of the deflection, at any deflection."""
    held = hold(Command(v, 0.0), 0.1, 2000.0)[20:, 0]
    assert held.mean() == pytest.approx(v, rel=0.03)
    # The stick's lag takes a part of the noise away.
    assert 0.07 * v < held.std() < 0.1 * v


def test_noise_drifts_and_does_not_jump():
    """From step to step the command changes by far less than it varies."""
    held = hold(Command(0.4, 0.2), 0.1, 1000.0)[20:]
    assert (np.diff(held, axis=0).std(axis=0) < 0.4 * held.std(axis=0)).all()


def test_a_stick_at_its_end_does_not_tremble():
    """Pushed beyond its end, the stick stays there: exactly full deflection."""
    held = hold(Command(0.0, -1.0), 0.1)[20:, 1]
    assert (held == -MAX_TURN_RATE).all()


def test_nothing_asked_nothing_given():
    """A hand at rest gives exactly nothing."""
    assert (hold(STILL, 0.3) == 0.0).all()


def test_no_command_beyond_the_chair():
    """Whatever is wanted, the stick ends where it ends."""
    held = hold(Command(9.0, 9.0), 0.5)
    assert held[:, 0].max() <= MAX_SPEED
    assert held[:, 1].max() <= MAX_TURN_RATE


def test_the_same_numbers_make_the_same_hand():
    """A hand is its random numbers."""
    assert (hold(Command(0.3, 0.1), 0.1, seed=3) == hold(Command(0.3, 0.1), 0.1, seed=3)).all()
    assert (hold(Command(0.3, 0.1), 0.1, seed=3) != hold(Command(0.3, 0.1), 0.1, seed=4)).any()
