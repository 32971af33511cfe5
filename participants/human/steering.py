"""What a person wants the chair to do now: direction, speed, and how hard to turn."""

import math
from typing import NamedTuple

from lad.command import Command
from participants.human.corners import Corner
from participants.human.practice import Skill
from participants.human.room import KnownRoom
from participants.human.turn_response import TurnResponse
from participants.traits import Traits
from protocols.course.route import Route
from protocols.pose import Pose
from protocols.wheelchair import MAX_TURN_RATE

NEAREST, FARTHEST = 0.8, 2.0
"""The least and the largest distance at which a person aims, m."""

BRAKING = 0.4
"""How hard people brake for a corner, m/s^2."""

ALIGNED, ASTRAY = 0.25, 0.75
"""Up to the first direction error a person keeps the speed; from the second on only turns, rad."""

RESERVE = 0.9
"""Share of the available turn rate that a person plans to use in a bend."""

FIRM = 0.9
"""A person who wants this share of full deflection or more pushes the stick to its end."""


class Situation(NamedTuple):
    """Where the chair is, and in which direction, relative to the way.

    Attributes
    ----------
    arc
        Arc length on the route, m.
    speed
        The chair's speed, m/s.
    error
        Direction of the aim as seen from the chair, rad, left positive.
    corner
        The sharp corner the chair is in, or the next one; None when there is none ahead.
    """

    arc: float
    speed: float
    error: float
    corner: Corner | None


def aim(room: KnownRoom, pose: Pose, arc: float, distance: float, offset: float) -> float:
    """Return the direction of the point a person aims at, as seen from the chair, rad.

    Parameters
    ----------
    room
        The way, and the obstacles between the chair and a point on it.
    pose
        Where the chair is.
    arc
        Where on the way that is, m.
    distance
        How far ahead the person aims, m; nearer where the straight line is blocked.
    offset
        How far to the left of the way, m.
    """
    for share in (1.0, 0.8, 0.6, 0.4, 0.2):
        x, y, heading = room.route.point(arc + share * distance)
        x, y = x - offset * math.sin(heading), y + offset * math.cos(heading)
        if room.straight(pose, x, y):
            break
    return math.remainder(math.atan2(y - pose.y, x - pose.x) - pose.heading, math.tau)


def aiming_distance(traits: Traits, speed: float) -> float:
    """Return how far ahead a person aims at a speed, m."""
    moving = max(speed, 0.3 * traits.preferred_speed_m_s)
    return min(max(traits.lookahead_s * moving, NEAREST), FARTHEST)


def intend(
    traits: Traits, skilled: Skill, response: TurnResponse, route: Route, now: Situation
) -> Command:
    """Return what a person wants the chair to do on a free way.

    The turn rate may be beyond the chair's: a stick is pushed to its end.
    """
    believed = response.share_for(now.error)
    cruising = traits.preferred_speed_m_s * skilled.way
    turning = min(cruising, traits.corner_speed_m_s * skilled.corner * believed)
    v = min(cruising, _for_bends(response, route, now, turning), _for_corner(now, turning))
    straying = (abs(now.error) - ALIGNED) / (ASTRAY - ALIGNED)
    v = v + (min(v, turning) - v) * min(max(straying, 0.0), 1.0)
    # A person who knows that the chair turns less than asked asks for more, each to some degree.
    push = believed**-traits.limit_push
    w = traits.steering_gain_per_s * now.error * push
    in_corner = now.corner is not None and now.arc >= now.corner.start
    deflection = traits.corner_deflection * skilled.corner if in_corner else 1.0
    hardest = MAX_TURN_RATE * (2.0 if deflection * push >= FIRM else deflection * push)
    return Command(v, min(max(w, -hardest), hardest))


def _for_bends(response: TurnResponse, route: Route, now: Situation, slowest: float) -> float:
    """Return the speed at which the chair still turns with the way ahead, m/s."""
    ahead = max(1.5 * now.speed, 0.8)
    bend = route.turn(now.arc, now.arc + ahead) / ahead
    if abs(bend) < 1e-6:
        return math.inf
    return max(RESERVE * MAX_TURN_RATE * response.share_for(bend) / abs(bend), slowest)


def _for_corner(now: Situation, turning: float) -> float:
    """Return the speed from which the chair can still slow down for the corner ahead, m/s."""
    if now.corner is None or now.arc >= now.corner.start:
        return math.inf
    return math.sqrt(turning**2 + 2.0 * BRAKING * (now.corner.start - now.arc))
