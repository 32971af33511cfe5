"""The driver's and the assistant's commands become one."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness.session.arbitration import augment, blend, blend_learnt, takeover
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from protocols.files.errors import InputError
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


@given(user=commands, mean=commands, p=st.floats(0.0, 1.0))
def test_a_blend_lies_between_the_two_commands(user, mean, p):
    """At p(h) = 0 the user's, at 1 the assistant's, and on the line between them otherwise."""
    mixed = blend(user, Assistance(helping=p >= 0.5, p_help=p, mean=mean))
    for low, high, found in zip(user, mean, mixed, strict=True):
        assert min(low, high) - 1e-12 <= found <= max(low, high) + 1e-12
        assert abs(found - (low + p * (high - low))) < 1e-12


@given(user=commands, helper=commands)
def test_who_says_no_probability_has_all_of_a_blend(user, helper):
    """A demonstrator's help counts whole, and nothing of it counts when there is none."""
    assert blend(user, Assistance(helping=True, command=helper)) == helper
    assert blend(user, NO_ASSISTANCE) == user


@given(user=commands, mean=commands, p=st.floats(0.0, 1.0), share=st.floats(0.0, 1.0))
def test_a_learnt_level_mixes_as_a_probability_does(user, mean, p, share):
    """The same mixture, with the share that was learnt in place of p(h)."""
    said = Assistance(helping=p >= 0.5, p_help=p, mean=mean, share=share)
    assert blend_learnt(user, said) == blend(user, said._replace(p_help=share))


def test_a_learnt_level_that_is_not_there_is_refused():
    """Never another share in its place; a demonstrator needs none."""
    with pytest.raises(InputError, match="this model learns no level; allowed: lad-level"):
        blend_learnt(Command(0, 0), Assistance(helping=True, p_help=0.7, mean=Command(0.2, 0)))
    helper = Command(0.2, -0.5)
    assert blend_learnt(Command(0, 0), Assistance(helping=True, command=helper)) == helper
