"""A lap as a script would drive it: numpy rollouts, a dictionary for every step, pandas at the end.

The same order of things as in our lap: observe, drive by the Dynamic Window Approach, limit right
turns, safeguard, move, record.
"""

import io
import itertools
import math
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from peers.simulator import FIELD_OF_VIEW, RANGE, Simulator, bearings
from pursuit import Pursuit

from lad.command import Command
from protocols.course.gates import GateCounter
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.wheelchair import (
    ACCELERATION,
    FRONT,
    LASER_AHEAD,
    MAX_SPEED,
    MAX_TURN_RATE,
    REAR,
    TURN_ACCELERATION,
    WIDTH,
)

SAMPLES = 20
"""Speeds, and turning rates, that are tried."""

INTERVAL, HORIZON, DT = 0.25, 2.0, 0.2
"""How long the chair accelerates, how far ahead rollouts look, and their step, s."""

RIGHT_TURN = 0.15
"""What full deflection to the right still gives, rad/s."""

MIDDLE = (FRONT - REAR) / 2
RADIUS = math.hypot((FRONT + REAR) / 2, WIDTH / 2)
"""The circle around the chair, m."""


def drive_numpy_lap(
    simulator: Simulator, course: Course, rays: int, rate_hz: int, time_limit_s: float
) -> float:
    """Drive and record one lap, at most so long; return its length in simulated seconds."""
    simulator.restart()
    path, gates = Pursuit(course), GateCounter(course)
    rows: list[dict[str, Any]] = []
    directions = bearings(rays)
    pose, ranges = simulator.sense()
    velocity = simulator.velocity()
    t = 0.0
    while not gates.finished and t < time_limit_s:
        points = _points(ranges, directions)
        intent = _best(points, velocity, _in_chair_frame(pose, path.aim(pose)))
        w = intent.w if intent.w >= 0 else intent.w * RIGHT_TURN / MAX_TURN_RATE
        limited = Command(intent.v, w)
        executed = _safe(points, limited)
        simulator.step(executed)
        row = {
            "step": len(rows), "t": t, "x": pose.x, "y": pose.y, "heading": pose.heading,
            "v": velocity.v, "w": velocity.w, "intent_v": intent.v, "intent_w": intent.w,
            "limited_v": limited.v, "limited_w": limited.w,
            "executed_v": executed.v, "executed_w": executed.w,
            "safeguarded": executed != limited, "clearance": float(np.min(ranges)),
        }  # fmt: skip
        row |= {f"segment_{i:02d}": s for i, s in enumerate(_segments(ranges, directions))}
        rows.append(row)
        before = pose
        pose, ranges = simulator.sense()
        velocity = simulator.velocity()
        gates.advance(before, pose)
        t += 1 / rate_hz
    pd.DataFrame(rows).to_parquet(io.BytesIO())
    return t


def _points(ranges: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return what the laser sees in the chair's frame: shape (n, 2), m."""
    seen = ranges < RANGE
    x = LASER_AHEAD + ranges[seen] * np.cos(directions[seen])
    y = ranges[seen] * np.sin(directions[seen])
    return np.stack([x, y], axis=1)


def _segments(ranges: NDArray[np.float64], directions: NDArray[np.float64]) -> list[float]:
    """Return the nearest return in each 12 degree segment of the front half circle, m."""
    degrees = np.degrees(directions)
    edges = np.linspace(-90, 90, 16)
    if len(ranges) < FIELD_OF_VIEW / math.radians(12):
        return [float(np.interp(e + 6, degrees, ranges)) for e in edges[:-1]]
    inside = [(degrees >= a) & (degrees <= b) for a, b in itertools.pairwise(edges)]
    return [float(ranges[mask].min()) for mask in inside]


def _in_chair_frame(pose: Pose, point: tuple[float, float]) -> tuple[float, float]:
    dx, dy = point[0] - pose.x, point[1] - pose.y
    c, s = math.cos(pose.heading), math.sin(pose.heading)
    return c * dx + s * dy, c * dy - s * dx


def _best(points: NDArray[np.float64], now: Command, target: tuple[float, float]) -> Command:
    """Roll every reachable pair of velocities out, all at once, and take the best."""
    vs = np.linspace(
        max(now.v - ACCELERATION * INTERVAL, 0.0),
        max(min(now.v + ACCELERATION * INTERVAL, MAX_SPEED), 0.0),
        SAMPLES,
    )
    ws = np.linspace(
        max(now.w - TURN_ACCELERATION * INTERVAL, -MAX_TURN_RATE),
        min(now.w + TURN_ACCELERATION * INTERVAL, MAX_TURN_RATE),
        SAMPLES,
    )
    v, w = (a.ravel() for a in np.meshgrid(vs, ws))
    room = _least_room(points, v, w, HORIZON)
    admissible = room > 0
    if not admissible.any():
        return Command(0.0, 0.0)
    x, y, heading = _arc(v, w, HORIZON / 2)
    bearing = np.arctan2(target[1] - y, target[0] - x) - heading
    off = np.abs(np.arctan2(np.sin(bearing), np.cos(bearing))) / np.pi
    score = 2.0 * (1 - off) + 0.2 * np.minimum(room, 0.3) / 0.3 + 0.2 * v / MAX_SPEED
    best = int(np.argmax(np.where(admissible, score, -np.inf)))
    return Command(float(v[best]), float(w[best]))


def _safe(points: NDArray[np.float64], command: Command) -> Command:
    """Slow down until the chair stays free while it brakes."""
    for share in (1.0, 0.75, 0.5, 0.25):
        v, w = command.v * share, command.w * share
        braking = v / ACCELERATION + INTERVAL
        if _least_room(points, np.array([v]), np.array([w]), braking)[0] > 0:
            return Command(v, w)
    return Command(0.0, 0.0)


def _least_room(
    points: NDArray[np.float64], v: NDArray[np.float64], w: NDArray[np.float64], horizon: float
) -> NDArray[np.float64]:
    """Return the least distance between the circle and any point along each arc, m."""
    room = np.full(len(v), RANGE)
    if not len(points):
        return room
    for t in np.arange(DT, horizon + DT / 2, DT):
        x, y, heading = _arc(v, w, t)
        cx, cy = x + MIDDLE * np.cos(heading), y + MIDDLE * np.sin(heading)
        dx, dy = cx[:, None] - points[:, 0], cy[:, None] - points[:, 1]
        room = np.minimum(room, np.sqrt((dx * dx + dy * dy).min(axis=1)) - RADIUS)
    return room


def _arc(v: NDArray[np.float64], w: NDArray[np.float64], t: float) -> tuple[Any, Any, Any]:
    """Return where constant velocities lead in a time: ahead, left (m) and heading (rad)."""
    turn = np.where(np.abs(w) < 1e-6, 1e-6, w)
    return v / turn * np.sin(turn * t), v / turn * (1 - np.cos(turn * t)), w * t
