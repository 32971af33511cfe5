# ruff: noqa: PLR0917  # compiled code takes arrays apart from objects
"""How far the chair can go along an arc before its outline could touch something."""

from typing import Any, NamedTuple

import numpy as np

from lad.command import Command
from lad.compiled import compiled
from participants.planning.field import (
    ASIDE,
    BEHIND,
    CELL,
    COLUMNS,
    FAR,
    ROWS,
    DistanceField,
    distance_at,
)
from protocols.course.footprint import DISC_RADIUS, SWING, disc_centres

CENTRES = disc_centres()

TOUCHING = 0.01
"""Less room than this counts as none, m."""

NUDGE = 0.005
"""The least distance between two checks, m: less than ``TOUCHING``."""


class Sweep(NamedTuple):
    """What happens along an arc driven at constant velocities.

    Attributes
    ----------
    time
        Seconds until the outline could touch something, at most the horizon.
    room
        The least distance between outline and obstacles on the way, m.
    """

    time: float
    room: float


def sweep(field: DistanceField, command: Command, horizon: float) -> Sweep:
    """Follow a command through a distance field.

    Conservative advancement: where the nearest obstacle is d away, no point of the chair gets
    there before it has moved by d, so the next check can wait that long. The answers are never more
    than is free; they are less by at most the discs' overlap and the field's slack.

    Parameters
    ----------
    field
        From ``participants.planning.field.scan_field``.
    command
        The velocities, m/s and rad/s.
    horizon
        How far to look, s.
    """
    return Sweep(*advance(*field, command.v, command.w, horizon))


@compiled
def room_at(field: Any, x: float, y: float, turn: float) -> Any:
    """Return the least distance between outline and obstacles at a pose in the chair's frame."""
    cosine, sine = np.cos(turn), np.sin(turn)
    least = FAR
    for i in range(len(CENTRES)):
        px = x + cosine * CENTRES[i, 0] - sine * CENTRES[i, 1]
        py = y + sine * CENTRES[i, 0] + cosine * CENTRES[i, 1]
        column, row = (px + BEHIND) / CELL + 0.5, (py + ASIDE) / CELL + 0.5
        if 0 <= row < ROWS and 0 <= column < COLUMNS:
            least = min(least, distance_at(field, int(row), int(column)))
    return least - DISC_RADIUS


@compiled
def advance(known: Any, rows: Any, columns: Any, v: float, w: float, horizon: float) -> Any:
    """Return (seconds until a possible touch, least room on the way).

    The field comes as its three arrays: compiled code takes a tuple of them much more slowly.
    """
    field = (known, rows, columns)
    speed = abs(v) + abs(w) * SWING
    least = room_at(field, 0.0, 0.0, 0.0)
    # A chair that is already too close may still move as long as it gets no closer.
    touching = min(TOUCHING, least)
    room = least
    t = 0.0
    while t < horizon and speed > 0.0:
        t = min(t + max(room - touching, NUDGE) / speed, horizon)
        x, y = arc_end(v, w, t)
        room = room_at(field, x, y, w * t)
        if room < touching:
            return t, max(room, 0.0)
        least = min(least, room)
    return horizon, least


@compiled
def arc_end(v: float, w: float, t: float) -> Any:
    """Return where constant velocities lead in a time: (ahead, left) in m."""
    if abs(w) < 1e-6:
        return v * t, 0.0
    return v / w * np.sin(w * t), v / w * (1.0 - np.cos(w * t))
