"""The search returns the best of all admissible velocities within the window."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lad.command import STILL, Command
from participants.dwa import DynamicWindow, choose
from participants.planning.field import scan_field
from participants.planning.sweep import sweep
from protocols.wheelchair import ACCELERATION, MAX_SPEED, MAX_TURN_RATE, TURN_ACCELERATION

SETTINGS = DynamicWindow()
BEARINGS = np.radians(np.linspace(-120, 120, 60))


def window(velocity, settings):
    """Return the grid of velocities that can be reached and are allowed."""
    dv, dw = ACCELERATION * settings.interval, TURN_ACCELERATION * settings.interval
    vs = np.linspace(max(velocity.v - dv, 0.0), min(velocity.v + dv, MAX_SPEED), settings.speeds)
    low, high = max(velocity.w - dw, -MAX_TURN_RATE), min(velocity.w + dw, MAX_TURN_RATE)
    return itertools.product(vs, np.linspace(low, high, settings.turns))


def score(field, v, w, target, s):
    """Return Fox's objective of one pair, computed one by one; minus infinity: not admissible."""
    free = sweep(field, Command(v, w), s.horizon).time
    if free < s.horizon and (v > 2 * ACCELERATION * free or abs(w) > 2 * TURN_ACCELERATION * free):
        return -math.inf
    x, y, turn = 0.0, 0.0, w * s.prediction
    if abs(w) < 1e-6:
        x = v * s.prediction
    else:
        x, y = v / w * math.sin(turn), v / w * (1 - math.cos(turn))
    off = abs(math.remainder(math.atan2(target[1] - y, target[0] - x) - turn, math.tau)) / math.pi
    return s.heading * (1 - off) + s.clearance * free / s.horizon + s.velocity * v / MAX_SPEED


@settings(deadline=None, max_examples=25)
@given(
    ranges=st.lists(st.floats(0.3, 4.5), min_size=60, max_size=60),
    v=st.floats(0.0, 0.7),
    w=st.floats(-0.5, 0.5),
    bearing=st.floats(-3.0, 3.0),
)
def test_the_choice_is_the_best_of_all_pairs(ranges, v, w, bearing):
    """Looking at the promising pairs first finds what looking at all of them finds."""
    field = scan_field(np.array(ranges), BEARINGS, 0.6, 4.0)
    target = (0.9 * math.cos(bearing), 0.9 * math.sin(bearing))
    best = max(score(field, a, b, target, SETTINGS) for a, b in window(Command(v, w), SETTINGS))
    found = choose(field, Command(v, w), target, SETTINGS)
    assert found.score == pytest.approx(best, abs=1e-9)
    if math.isfinite(best):
        assert score(field, *found.command, target, SETTINGS) == pytest.approx(best, abs=1e-9)
    else:
        assert found.command == STILL


def test_about_four_hundred_pairs_are_tried():
    """The window's resolution is that of the issue it answers."""
    assert SETTINGS.speeds * SETTINGS.turns == 400


def test_full_speed_ahead_on_a_free_floor():
    """With the target straight ahead and far, the chair speeds up as fast as the window lets."""
    free = scan_field(np.full(60, 4.0), BEARINGS, 0.6, 4.0)
    found = choose(free, Command(0.3, 0.0), (5.0, 0.0), SETTINGS)
    assert found.command.v == pytest.approx(0.3 + ACCELERATION * SETTINGS.interval)
    assert abs(found.command.w) < 0.02


def test_it_turns_on_the_spot_towards_a_target_behind():
    """A target to the right rear is turned to, without driving away from it."""
    free = scan_field(np.full(60, 4.0), BEARINGS, 0.6, 4.0)
    found = choose(free, STILL, (-0.7, -0.5), SETTINGS)
    assert found.command.v < 0.05
    assert found.command.w < -0.3


def test_it_brakes_for_a_wall():
    """A wall that can no longer be avoided at this speed leaves only slower arcs."""
    wall = np.where(np.abs(BEARINGS) < 1.2, 0.35 / np.cos(np.clip(BEARINGS, -1.2, 1.2)), 4.0)
    field = scan_field(wall, BEARINGS, 0.6, 4.0)
    found = choose(field, Command(0.3, 0.0), (5.0, 0.0), SETTINGS)
    assert found.command.v < 0.3
