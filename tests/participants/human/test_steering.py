"""What a person wants on a free way: speed, direction, and full deflection where it is due."""

import math
from dataclasses import replace

import numpy as np
import pytest

from lad.command import Command
from participants.cohort import typical_traits
from participants.human.corners import sharp_corners
from participants.human.practice import Skill
from participants.human.steering import Situation, intend
from participants.human.turn_response import TurnResponse
from protocols.course.route import Route

TRAITS = typical_traits()
SKILLED = Skill(way=1.0, corner=1.0, pause=0.0)


@pytest.fixture
def route():
    """Return a way of 5 m east and 3 m south."""
    east = np.column_stack([np.linspace(0, 5, 101), np.zeros(101)])
    south = np.column_stack([np.full(60, 5.0), -0.05 * np.arange(1, 61)])
    return Route(np.vstack([east, south]), (8.0,))


def limited():
    """Return the knowledge of a person whose right turns give 0.3 of what is asked."""
    response = TurnResponse(1.0)
    for _ in range(200):
        response.observe(Command(0.0, -0.5), Command(0.0, -0.15), 0.1, trusted=True)
    return response


def test_straight_ahead_at_the_preferred_speed(route):
    """On a straight, aligned, one drives as one likes, and does not turn."""
    now = Situation(arc=1.0, speed=0.5, error=0.0, corner=sharp_corners(route)[0])
    v, w = intend(TRAITS, SKILLED, TurnResponse(1.0), route, now)
    assert v == pytest.approx(TRAITS.preferred_speed_m_s)
    assert w == 0.0


def test_one_slows_down_for_a_corner_in_time(route):
    """The nearer the corner the slower, down to the corner speed, at a bearable rate."""
    corner = sharp_corners(route)[0]
    arcs = np.linspace(corner.start - 1.0, corner.start, 21)
    speeds = [
        intend(TRAITS, SKILLED, TurnResponse(1.0), route, Situation(a, 0.3, 0.0, corner)).v
        for a in arcs
    ]
    assert (np.diff(speeds) <= 1e-12).all()
    assert speeds[-1] == pytest.approx(TRAITS.corner_speed_m_s, abs=0.1)


def test_far_off_the_direction_one_turns_before_going_on(route):
    """With the way behind one's shoulder the speed is no more than that for corners."""
    now = Situation(arc=1.0, speed=0.2, error=-2.0, corner=None)
    command = intend(TRAITS, SKILLED, TurnResponse(1.0), route, now)
    assert command.v <= TRAITS.corner_speed_m_s
    assert command.w < -0.45


def test_a_limited_person_pushes_the_stick_to_its_end(route):
    """Who has noticed the limitation asks for more than the stick can give, to that side only."""
    traits = replace(TRAITS, limit_push=1.0)
    now = Situation(arc=1.0, speed=0.2, error=-0.3, corner=None)
    assert intend(traits, SKILLED, limited(), route, now).w < -0.5
    other = now._replace(error=0.3)
    free = intend(traits, SKILLED, TurnResponse(1.0), route, other)
    assert intend(traits, SKILLED, limited(), route, other).w == free.w


def test_a_limited_person_is_slower_in_right_bends(route):
    """Knowing that the chair turns slowly, one goes slowly where it must turn."""
    now = Situation(arc=4.8, speed=0.3, error=-0.2, corner=None)
    free = intend(TRAITS, SKILLED, TurnResponse(1.0), route, now)
    assert intend(TRAITS, SKILLED, limited(), route, now).v < free.v


def test_timid_turners_use_a_part_of_the_stick(route):
    """In a sharp corner, and only there, deflection is the person's habit."""
    corner = sharp_corners(route)[0]
    timid = replace(TRAITS, corner_deflection=0.4)
    inside = Situation(0.5 * (corner.start + corner.end), 0.1, -1.5, corner)
    assert intend(timid, SKILLED, TurnResponse(1.0), route, inside).w == pytest.approx(-0.2)
    outside = Situation(1.0, 0.1, -1.5, corner)
    assert intend(timid, SKILLED, TurnResponse(1.0), route, outside).w < -0.45


def test_directions_mirror(route):
    """Left and right are alike for who is not limited."""
    left = Situation(1.0, 0.3, 0.3, None)
    right = Situation(1.0, 0.3, -0.3, None)
    a = intend(TRAITS, SKILLED, TurnResponse(1.0), route, left)
    b = intend(TRAITS, SKILLED, TurnResponse(1.0), route, right)
    assert a.v == b.v
    assert math.isclose(a.w, -b.w)
