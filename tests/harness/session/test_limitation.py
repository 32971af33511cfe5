"""The control limitation slows right turns and nothing else."""

from hypothesis import given
from hypothesis import strategies as st

from harness.session.limitation import right_turn_limit, unlimited
from lad.command import Command
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

speeds = st.floats(-MAX_SPEED, MAX_SPEED)
rights = st.floats(-MAX_TURN_RATE, 0, exclude_max=True)
lefts = st.floats(0, MAX_TURN_RATE)


def test_full_right_deflection_gives_the_limit():
    """Full deflection to the right gives 0.15 rad/s instead of 0.5 (section IV.A)."""
    assert right_turn_limit(0.15)(Command(0.7, -0.5)).w == -0.15


@given(v=speeds, w=rights)
def test_right_turns_are_scaled_and_speed_is_kept(v, w):
    """Any right turn is scaled by the same factor; translation is never touched."""
    limited = right_turn_limit(0.15)(Command(v, w))
    assert limited.v == v
    assert abs(limited.w - 0.3 * w) < 1e-12


@given(v=speeds, w=lefts)
def test_left_turns_and_straights_pass(v, w):
    """Left turns and straight driving are as without the limitation."""
    assert right_turn_limit(0.15)(Command(v, w)) == unlimited(Command(v, w))
