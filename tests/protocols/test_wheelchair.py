"""What the chair accepts."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import Command
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE, within_limits

finite = st.floats(-10, 10)


@given(finite, finite)
def test_no_command_exceeds_the_top_speeds(v, w):
    """What is too fast is clipped, what is not is left alone."""
    limited = within_limits(Command(v, w))
    assert abs(limited.v) <= MAX_SPEED
    assert abs(limited.w) <= MAX_TURN_RATE
    assert limited.v == v or abs(v) > MAX_SPEED
    assert limited.w == w or abs(w) > MAX_TURN_RATE


@pytest.mark.parametrize("bad", [math.nan, math.inf, -math.inf])
def test_a_command_must_be_finite(bad):
    """A driver's NaN does not reach the wheels."""
    with pytest.raises(ValueError, match="finite"):
        within_limits(Command(bad, 0.0))
    with pytest.raises(ValueError, match="finite"):
        within_limits(Command(0.0, bad))
