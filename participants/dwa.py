# ruff: noqa: PLR0917  # compiled code takes arrays apart from objects
"""The Dynamic Window Approach: the best of the velocities the chair can reach and may drive.

Fox, Burgard & Thrun (1997), The dynamic window approach to collision avoidance, IEEE Robotics &
Automation Magazine 4(1), 23-33.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from lad.command import STILL, Command
from lad.compiled import compiled
from participants.planning.field import DistanceField
from participants.planning.sweep import advance, arc_end
from protocols.wheelchair import ACCELERATION, MAX_SPEED, MAX_TURN_RATE, TURN_ACCELERATION


@dataclass(frozen=True, slots=True)
class DynamicWindow:
    """Settings of the search.

    Attributes
    ----------
    heading, clearance, velocity
        Weights of the objective's three parts, each between 0 and 1.
    interval
        How long the chair accelerates before it is assumed to have reached a velocity, s.
    horizon
        How far ahead an arc is checked, s.
    prediction
        How far ahead the direction to the target is judged, s.
    speeds, turns
        How many translational and rotational velocities are tried.
    """

    heading: float = 2.0
    clearance: float = 0.2
    velocity: float = 0.2
    interval: float = 0.25
    horizon: float = 2.0
    prediction: float = 1.5
    speeds: int = 16
    turns: int = 25


@dataclass(frozen=True, slots=True)
class Choice:
    """What the search found.

    Attributes
    ----------
    command
        The best admissible velocities.
    score
        Their objective; minus infinity when nothing is admissible, and the chair should stand.
    """

    command: Command
    score: float


def choose(
    field: DistanceField,
    velocity: Command,
    target: tuple[float, float],
    settings: DynamicWindow,
) -> Choice:
    """Return the best velocities for the next moment.

    Parameters
    ----------
    field
        Distance field of the scan, from ``participants.planning.field.scan_field``.
    velocity
        The chair's velocities now, m/s and rad/s.
    target
        Where to go, in the chair's frame: ahead and to the left, m.
    settings
        Weights and resolution.
    """
    s = settings
    low_v, high_v = _reach(velocity.v, ACCELERATION * s.interval, 0.0, MAX_SPEED)
    low_w, high_w = _reach(
        velocity.w, TURN_ACCELERATION * s.interval, -MAX_TURN_RATE, MAX_TURN_RATE
    )
    vs = np.linspace(low_v, high_v, s.speeds)
    ws = np.linspace(low_w, high_w, s.turns)
    weights = np.array([s.heading, s.clearance, s.velocity, s.horizon, s.prediction])
    v, w, score = _best(*field, vs, ws, np.array(target), weights)
    return Choice(Command(v, w) if np.isfinite(score) else STILL, score)


def _reach(now: float, change: float, lowest: float, highest: float) -> tuple[float, float]:
    """Velocities that can be reached; the nearest allowed one when none can."""
    low = min(max(now - change, lowest), highest)
    return low, max(min(now + change, highest), low)


@compiled
def _best(known: Any, rows: Any, columns: Any, vs: Any, ws: Any, target: Any, weights: Any) -> Any:
    """Return (v, w, score) of the best admissible pair; score -inf when there is none.

    No arc scores more than it would with full clearance. So pairs are checked in the order of that
    bound, until no other pair can be better: the answer is the same as after checking all.
    """
    clearance_weight, horizon = weights[1], weights[3]
    promise = np.empty(len(vs) * len(ws))
    for i in range(len(promise)):
        v, w = vs[i // len(ws)], ws[i % len(ws)]
        promise[i] = clearance_weight + _liking(v, w, target, weights)
    best_v, best_w, best = 0.0, 0.0, -np.inf
    for i in np.argsort(-promise):
        if promise[i] <= best:
            break
        v, w = vs[i // len(ws)], ws[i % len(ws)]
        free, _ = advance(known, rows, columns, v, w, horizon)
        # Admissible: the chair can stop before it touches anything (equation 14 of Fox).
        brakes = v <= 2 * ACCELERATION * free and abs(w) <= 2 * TURN_ACCELERATION * free
        score = promise[i] - clearance_weight * (1.0 - free / horizon)
        if (free >= horizon or brakes) and score > best:
            best_v, best_w, best = v, w, score
    return best_v, best_w, best


@compiled
def _liking(v: float, w: float, target: Any, weights: Any) -> Any:
    """Weigh direction to the target after the prediction time, and speed."""
    t = weights[4]
    x, y = arc_end(v, w, t)
    bearing = np.arctan2(target[1] - y, target[0] - x) - w * t
    off = abs(np.arctan2(np.sin(bearing), np.cos(bearing))) / np.pi
    return weights[0] * (1.0 - off) + weights[2] * v / MAX_SPEED
