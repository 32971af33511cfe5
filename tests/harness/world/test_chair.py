"""The velocity controller."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness.world.chair import VelocityController
from lad.command import STILL, Command
from protocols.wheelchair import ACCELERATION, MAX_SPEED, MAX_TURN_RATE, TURN_ACCELERATION

finite = st.floats(-10, 10)
commands = st.builds(
    Command, st.floats(-MAX_SPEED, MAX_SPEED), st.floats(-MAX_TURN_RATE, MAX_TURN_RATE)
)


@given(commands, commands, st.floats(1e-3, 0.5))
def test_acceleration_is_limited_both_ways(start, target, dt):
    """Within a time neither velocity changes by more than its limit, and never past the target."""
    controller = VelocityController()
    controller.reset(start)
    controller.approach(target, dt)
    v, w = controller.velocity
    assert abs(v - start.v) <= ACCELERATION * dt + 1e-12
    assert abs(w - start.w) <= TURN_ACCELERATION * dt + 1e-12
    assert min(start.v, target.v) <= v <= max(start.v, target.v)
    assert min(start.w, target.w) <= w <= max(start.w, target.w)


def test_top_speed_is_reached_in_its_time():
    """From rest to 0.7 m/s takes 0.7 / 0.7 = 1 s, and then nothing changes any more."""
    controller = VelocityController()
    target = Command(MAX_SPEED, 0.0)
    ticks = 0
    while controller.approach(target, 0.0125):
        ticks += 1
    assert ticks == pytest.approx(MAX_SPEED / ACCELERATION / 0.0125, abs=1)
    assert controller.velocity == target


def test_reset_stands_still():
    """A new lap begins at rest."""
    controller = VelocityController()
    controller.approach(Command(0.5, 0.5), 0.1)
    controller.reset()
    assert controller.velocity == STILL
