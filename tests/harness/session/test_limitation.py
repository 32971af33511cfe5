"""The control limitation slows right turns and nothing else."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness.session.limitation import limitation_of, right_turn_limit, unlimited
from lad.command import Command
from protocols.condition import LimitationSettings
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


def limited(**fields):
    """Return one lap's limitation, at ten steps a second."""
    return limitation_of(LimitationSettings(**fields), 0.1)


@given(v=speeds, w=st.floats(-MAX_TURN_RATE, MAX_TURN_RATE))
def test_left_is_the_mirror_image_of_right(v, w):
    """Mirroring the command, limiting the other side and mirroring back is the same."""
    right = limited(right_turn_rad_s=0.15)(Command(v, w))
    left = limited(left_turn_rad_s=0.15)(Command(v, -w))
    assert (left.v, left.w) == (right.v, -right.w)


@given(v=speeds, w=st.floats(-MAX_TURN_RATE, MAX_TURN_RATE), share=st.floats(0.05, 0.8))
def test_a_dead_zone_keeps_the_ends_and_the_sign(v, w, share):
    """Nothing below the share, full deflection at the end, and never the other way."""
    found = limited(dead_zone=share)(Command(v, w))
    assert abs(found.v) <= abs(v) + 1e-12
    assert found.w * w >= 0.0
    if abs(v) < share * MAX_SPEED:
        assert found.v == 0.0
    assert limited(dead_zone=share)(Command(MAX_SPEED, 0.0)).v == pytest.approx(MAX_SPEED)


def test_a_lag_has_its_time_constant_and_begins_anew_in_each_lap():
    """After lag_s a step in the command has arrived to 1 - 1/e; the next lap starts standing."""
    chair = limited(lag_s=0.5)
    found = [chair(Command(0.7, -0.5)).v for _ in range(5)][-1]
    assert found == pytest.approx(0.7 * (1 - np.exp(-1)))
    assert limited(lag_s=0.5)(Command(0.0, 0.0)) == Command(0.0, 0.0)


def test_several_limitations_act_together():
    """Right, left and speed at once; a field that is not given limits nothing."""
    both = limited(right_turn_rad_s=0.15, left_turn_rad_s=0.2, speed_m_s=0.35)
    assert both(Command(0.7, 0.5)) == Command(0.35, 0.2)
    assert limited(speed_m_s=0.35)(Command(0.7, -0.5)) == Command(0.35, -0.5)
    assert limitation_of(None, 0.1) is unlimited


@pytest.mark.parametrize(
    ("fields", "part"),
    [
        ({"right_turn_rad_s": 0.01, "left_turn_rad_s": 0.01}, "leaves no control"),
        ({"right_turn_rad_s": None}, "limits nothing"),
        ({"speed_m_s": 0.0}, "0.1"),
        ({"dead_zone": 0.9}, "0.8"),
        ({"lag_s": -1}, "greater than or equal to 0"),
    ],
)
def test_impossible_limitations_are_refused(fields, part):
    """A chair that cannot be driven, or a limitation that limits nothing, is a named error."""
    with pytest.raises(ValueError, match=part):
        LimitationSettings(**fields)


def test_an_empty_mapping_is_the_papers():
    """`limitation: {}` meant right turns of 0.15 rad/s, and does."""
    assert LimitationSettings.model_validate({}).right_turn_rad_s == 0.15
