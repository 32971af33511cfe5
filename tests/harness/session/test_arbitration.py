"""The driver's and the assistant's commands become one."""

from hypothesis import given
from hypothesis import strategies as st

from harness.session.arbitration import augment, takeover
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

commands = st.builds(
    Command, st.floats(-MAX_SPEED, MAX_SPEED), st.floats(-MAX_TURN_RATE, MAX_TURN_RATE)
)


@given(user=commands, helper=commands)
def test_a_takeover_replaces_the_drivers_command(user, helper):
    """During a takeover the assistant's command alone counts (section IV.B)."""
    assert takeover(user, Assistance(helping=True, command=helper)) == helper


@given(user=commands, helper=commands)
def test_without_help_the_driver_drives(user, helper):
    """An assistant that does not help changes nothing, even when it holds a command."""
    for said in (NO_ASSISTANCE, Assistance(helping=False, command=helper)):
        assert takeover(user, said) == user
        assert augment(user, said) == user


@given(user=commands, helper=commands)
def test_augmented_commands_stay_within_the_chairs_limits(user, helper):
    """The sum of two commands never asks for more than the chair can do."""
    both = augment(user, Assistance(helping=True, command=helper))
    assert abs(both.v) <= MAX_SPEED
    assert abs(both.w) <= MAX_TURN_RATE
