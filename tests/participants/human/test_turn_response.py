"""A person learns how far the chair obeys, to each side on its own."""

import pytest

from lad.command import Command
from participants.human.turn_response import LEAST, TurnResponse


def drive(response, asked, share, seconds, *, trusted=True):
    """Ask for a turn rate for a while and get a share of it."""
    for _ in range(int(seconds * 10)):
        response.observe(Command(0.0, asked), Command(0.0, share * asked), 0.1, trusted)


def test_a_limited_side_is_noticed_and_the_other_is_not():
    """After some seconds of right turns at 0.3 of the rate, right is believed to be 0.3."""
    response = TurnResponse(1.0)
    drive(response, -0.5, 0.3, 10.0)
    assert response.share_for(-0.1) == pytest.approx(0.3, abs=0.02)
    assert response.share_for(0.1) == 1.0


def test_slow_learners_take_longer():
    """The rate is a person's own."""
    slow, fast = TurnResponse(0.2), TurnResponse(2.0)
    for response in (slow, fast):
        drive(response, -0.5, 0.3, 2.0)
    assert slow.right > fast.right + 0.2


def test_it_is_relearnt_when_the_limitation_ends():
    """Belief follows experience back up."""
    response = TurnResponse(1.0)
    drive(response, -0.5, 0.3, 10.0)
    drive(response, -0.5, 1.0, 10.0)
    assert response.right == pytest.approx(1.0, abs=0.02)


def test_nothing_is_learnt_while_somebody_else_drives_or_from_faint_turns():
    """What one did not cause, or can hardly feel, teaches nothing."""
    response = TurnResponse(1.0)
    drive(response, -0.5, 0.3, 10.0, trusted=False)
    drive(response, -0.1, 0.3, 10.0)
    assert response.right == 1.0


def test_letting_go_teaches_nothing():
    """A stick that is just being moved is not compared with a chair that has yet to follow."""
    response = TurnResponse(1.0)
    drive(response, -0.5, 1.0, 5.0)
    drive(response, -0.2, 0.5, 0.1)
    assert response.right == pytest.approx(1.0, abs=0.01)


def test_a_blocked_chair_does_not_make_one_give_up():
    """A chair that does not turn at all is not believed to obey less than a little."""
    response = TurnResponse(1.0)
    drive(response, -0.5, 0.0, 60.0)
    assert response.right == pytest.approx(LEAST, abs=0.01)


def test_a_new_lap_keeps_what_was_learnt():
    """Laps end, experience stays."""
    response = TurnResponse(1.0)
    drive(response, -0.5, 0.3, 10.0)
    believed = response.right
    response.start_lap()
    assert response.right == believed
