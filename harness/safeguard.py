"""The last guard against hard collisions, in the manner of a Dynamic Window Approach.

Section V of Soh & Demiris: "simple safeguarding using a DWA variant [9] was employed to prevent
hard collisions with obstacles". Admissible, as in Fox, Burgard & Thrun (1997), is a command after
which the chair can still stop: it is followed for one control step, then both velocities are
braked as hard as the controller allows, and all the while the footprint keeps its distance. Of
the commands that only take speed away, the admissible one nearest to what was asked is let
through; the guard never steers and never speeds up.

ARTY sees all around with three scanners, so the guard gets the true distances to what stands
around, not the one simulated scan.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from harness.chair import within_limits
from harness.clearance import AHEAD, HALF_LENGTH, HALF_WIDTH, box_table, clearance
from lad.command import Command
from lad.compiled import compiled
from protocols.course.obstacles import Box
from protocols.pose import Pose
from protocols.wheelchair import ACCELERATION, MAX_SPEED, MAX_TURN_RATE, TURN_ACCELERATION

MARGIN = 0.03
"""Distance the guard keeps, m; where the chair is nearer already, it must not come nearer."""

TOUCH = 1e-5
"""How much nearer counts as no nearer, m."""

INTERVAL = 0.05
"""Longest time between two poses that are looked at, s."""

SPEED_STEPS, TURN_STEPS = 10, 4
"""In how many steps each velocity can be taken away."""

ARM = AHEAD + math.hypot(HALF_LENGTH, HALF_WIDTH)
"""No point of the footprint is farther from the axle's midpoint, m."""

SIGHT = ARM + MARGIN + 0.5 * MAX_SPEED + MAX_SPEED**2 / (2 * ACCELERATION)
"""How far away a box can matter at most, with control steps of up to 0.5 s, m."""


class Safeguard:
    """Guards a chair among boxes.

    Parameters
    ----------
    boxes
        What stands around.
    period
        Length of a control step, s; at most 0.5.
    """

    def __init__(self, boxes: Sequence[Box], period: float) -> None:
        self._table = box_table(boxes)
        self._period = period

    def guard(self, command: Command, pose: Pose, velocity: Command) -> Command:
        """Return the command, or what is left of it.

        Parameters
        ----------
        command
            What is asked of the chair.
        pose, velocity
            Where the chair is and what its controller drives now.
        """
        asked = within_limits(command)
        v, w = _guarded(self._table, pose, velocity, (asked.v, asked.w), self._period)
        return command if (v, w) == asked else Command(v, w)


@compiled
def _guarded(table: Any, pose: Any, velocity: Any, asked: Any, period: float) -> Any:
    near = _nearby(table, pose)
    now = clearance(near, pose)
    keep = min(MARGIN, now - TOUCH)
    state = (pose[0], pose[1], pose[2], velocity[0], velocity[1])
    if _admissible(near, state, asked, (period, now, keep)):
        return asked
    if not _admissible(near, state, (0.0, 0.0), (period, now, keep)):
        return (0.0, 0.0)  # too late for anything but the brakes
    tried = np.zeros((SPEED_STEPS + 1, TURN_STEPS + 1), dtype=np.bool_)
    tried[0, 0] = True
    tried[1:] = asked[0] == 0.0
    tried[:, 1:] |= asked[1] == 0.0
    while not tried.all():
        i, j = _next(tried, asked)
        tried[i, j] = True
        less = (asked[0] * (1.0 - i / SPEED_STEPS), asked[1] * (1.0 - j / TURN_STEPS))
        if _admissible(near, state, less, (period, now, keep)):
            return less
    return (0.0, 0.0)


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
def _next(tried: Any, asked: Any) -> Any:
    """Return the untried command nearest to what was asked, each velocity in its own range."""
    best, i_best, j_best = np.inf, 0, 0
    for i in range(SPEED_STEPS + 1):
        for j in range(TURN_STEPS + 1):
            lost = (
                abs(asked[0]) / MAX_SPEED * i / SPEED_STEPS
                + abs(asked[1]) / MAX_TURN_RATE * j / TURN_STEPS
            )
            if not tried[i, j] and lost < best:
                best, i_best, j_best = lost, i, j
    return i_best, j_best


@compiled
def _admissible(near: Any, state: Any, command: Any, rule: Any) -> bool:
    """Whether the chair keeps its distance for one step and until it stands."""
    x, y, heading, v, w = state
    period, now, keep = rule
    spare = now - keep
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
        # As long as it cannot have come too near, there is no need to look.
        spare -= (abs(v_mean) + abs(w_mean) * ARM) * dt
        if spare < 0.0:
            spare = clearance(near, Pose(x, y, heading)) - keep
            if spare < 0.0:
                return False
    return True
