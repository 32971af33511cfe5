"""The safeguard against hard collisions, a variant of the Dynamic Window Approach.

Section V of Soh & Demiris: "simple safeguarding using a DWA variant [9] was employed to prevent
hard collisions with obstacles". Admissible, as in Fox, Burgard & Thrun (1997), is a command after
which the chair can still stop: it is followed for one control step, then both velocities are
braked as hard as the controller allows, and all the while the footprint keeps its distance. Of
the commands that only take speed away, the admissible one nearest to what was asked is let
through; the guard never steers and never speeds up.

How much distance? Ahead, in the direction of travel, so much that after a stop the chair can
still turn on the spot; everywhere else about a centimetre, so that narrow passages stay open and
a tail may swing. Nearer than that already, a step may use up half of what is left, which lets
one steer off a wall and yet never reaches it.

ARTY sees all around with three scanners, so the safeguard gets the true distances to the obstacles
around, not the one simulated scan.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from harness.world.clearance import (
    FRONT,
    HALF_WIDTH,
    REAR,
    box_table,
    clearance,
    stretched_clearance,
)
from lad.command import Command
from lad.compiled import compiled
from protocols.course.obstacles import Box
from protocols.pose import Pose
from protocols.wheelchair import (
    ACCELERATION,
    MAX_SPEED,
    MAX_TURN_RATE,
    TURN_ACCELERATION,
    within_limits,
)

ROOM = math.hypot(FRONT, HALF_WIDTH) - FRONT
"""Distance kept in the direction of travel beyond ``MARGIN``, m: room to turn after a stop."""

MARGIN = 0.01
"""Distance kept on all sides, m."""

FLOOR = 0.002
"""Distance below which the chair must not come nearer at all, m."""

TOUCH = 1e-5
"""A pose that is nearer by less than this counts as no nearer, m."""

INTERVAL = 0.05
"""Longest time between two poses that are checked, s."""

TURN_SHARES = (1.0, 0.75, 0.5, 0.25, 0.125, 0.0)
"""Shares of a turn that the safeguard tries, in order."""

HALVINGS = 3
"""How often the search for the largest admissible speed halves its interval."""

ARM = math.hypot(FRONT, HALF_WIDTH)
"""No point of the footprint is farther from the axle's midpoint, m."""

SIGHT = ARM + ROOM + MARGIN + 0.5 * MAX_SPEED + MAX_SPEED**2 / (2 * ACCELERATION)
"""How far away a box can matter at most, with control steps of up to 0.5 s, m."""


class Safeguard:
    """Guards a chair among boxes.

    Parameters
    ----------
    boxes
        The obstacles.
    period
        Length of a control step, s; at most 0.5.
    """

    def __init__(self, boxes: Sequence[Box], period: float) -> None:
        self._table = box_table(boxes)
        self._period = period

    def guard(self, command: Command, pose: Pose, velocity: Command) -> Command:
        """Return the command, or the part of it that is safe.

        Parameters
        ----------
        command
            What is asked of the chair.
        pose, velocity
            Where the chair is and what its controller drives now.
        """
        asked = within_limits(command)
        # Plain tuples: compiled code takes named ones much more slowly.
        v, w = _guarded(self._table, tuple(pose), tuple(velocity), tuple(asked), self._period)
        return command if (v, w) == asked else Command(v, w)


@compiled
def _guarded(table: Any, pose: Any, velocity: Any, asked: Any, period: float) -> Any:
    near = _nearby(table, pose)
    state = (pose[0], pose[1], pose[2], velocity[0], velocity[1])
    if _admissible(near, state, asked, period):
        return asked
    if not _admissible(near, state, (0.0, 0.0), period):
        return (0.0, 0.0)  # too late: only braking is left
    best, least = (0.0, 0.0), np.inf
    for share in TURN_SHARES:
        turning = (1.0 - share) * abs(asked[1]) / MAX_TURN_RATE
        if turning >= least or (share < 1.0 and asked[1] == 0.0):
            break
        speed = _speed_share(near, state, (asked[0], share * asked[1]), period)
        lost = turning + (1.0 - speed) * abs(asked[0]) / MAX_SPEED
        if speed >= 0.0 and lost < least:
            best, least = (speed * asked[0], share * asked[1]), lost
    return best


@compiled
def _speed_share(near: Any, state: Any, command: Any, period: float) -> float:
    """Return the largest safe speed at a turning rate; negative when no speed is safe."""
    if _admissible(near, state, command, period):
        return 1.0
    if not _admissible(near, state, (0.0, command[1]), period):
        # Sometimes the chair may not turn on the spot, but may while it drives out.
        return 0.5 if _admissible(near, state, (0.5 * command[0], command[1]), period) else -1.0
    safe, unsafe = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = (safe + unsafe) / 2
        if _admissible(near, state, (middle * command[0], command[1]), period):
            safe = middle
        else:
            unsafe = middle
    return safe


@compiled
def _nearby(table: Any, pose: Any) -> Any:
    """Return the boxes that matter now."""
    near = np.empty_like(table)
    n = 0
    for k in range(len(table)):
        reach = SIGHT + math.hypot(table[k, 4], table[k, 5])
        dx, dy = table[k, 0] - pose[0], table[k, 1] - pose[1]
        if dx * dx + dy * dy < reach * reach:
            near[n] = table[k]
            n += 1
    return near[:n]


@compiled
def _kept(now: float) -> float:
    """Return the distance that must be kept, given what there is now."""
    return max(min(now / 2, MARGIN), FLOOR) if now > FLOOR else now - TOUCH


@compiled
def _admissible(near: Any, state: Any, command: Any, period: float) -> bool:
    """Whether the chair keeps its distance for one step and until it stands."""
    x, y, heading, v, w = state
    front = FRONT + (ROOM if command[0] > 0.0 else 0.0)
    rear = REAR + (ROOM if command[0] < 0.0 else 0.0)
    now = clearance(near, (x, y, heading))
    now_ahead = stretched_clearance(near, (x, y, heading), front, rear)
    keep, keep_ahead = _kept(now), _kept(now_ahead)
    spare = min(now - keep, now_ahead - keep_ahead)
    steps = math.ceil(period / INTERVAL)
    dt = period / steps
    k = 0
    while k < steps or v != 0.0 or w != 0.0:
        goal_v, goal_w = command if k < steps else (0.0, 0.0)
        v_next = min(max(goal_v, v - ACCELERATION * dt), v + ACCELERATION * dt)
        w_next = min(max(goal_w, w - TURN_ACCELERATION * dt), w + TURN_ACCELERATION * dt)
        v_mean, w_mean = (v + v_next) / 2, (w + w_next) / 2
        middle = heading + w_mean * dt / 2
        x += v_mean * dt * math.cos(middle)
        y += v_mean * dt * math.sin(middle)
        heading += w_mean * dt
        v, w = v_next, w_next
        k += 1
        # Until it can have come too near, no check is needed.
        spare -= (abs(v_mean) + abs(w_mean) * (ARM + ROOM)) * dt
        if spare < 0.0:
            ahead = stretched_clearance(near, (x, y, heading), front, rear)
            spare = ahead - max(keep, keep_ahead)
            if spare < 0.0:  # the chair itself is never nearer than its stretched outline
                own = ahead if command[0] == 0.0 else clearance(near, (x, y, heading))
                spare = min(ahead - keep_ahead, own - keep)
            if spare < 0.0:
                return False
    return True
