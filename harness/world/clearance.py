"""How far the chair's footprint is from what it could hit, exactly."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.compiled import compiled
from protocols import wheelchair
from protocols.course.obstacles import Box

FRONT, REAR = wheelchair.FRONT, wheelchair.REAR
HALF_WIDTH = wheelchair.WIDTH / 2

FAR = 1e3
"""Reported where there is nothing to hit, m."""


def box_table(boxes: Iterable[Box]) -> NDArray[np.float64]:
    """Return boxes as the compiled loops read them.

    Returns
    -------
    NDArray
        Shape (n, 6), a row per box: x and y of its centre, cosine and sine of its heading, half
        its length and half its width.
    """
    rows = [
        (b.cx, b.cy, math.cos(b.heading), math.sin(b.heading), b.length / 2, b.width / 2)
        for b in boxes
    ]
    return np.array(rows, dtype=np.float64).reshape(-1, 6)


@compiled
def clearance(table: NDArray[np.float64], pose: tuple[float, float, float]) -> float:
    """Return the distance from the chair's footprint to the nearest box.

    Parameters
    ----------
    table
        As ``box_table`` returns it.
    pose
        Where the midpoint of the driven axle is, and the heading: a plain tuple, which compiled
        code takes much faster than a named one.

    Returns
    -------
    float
        In m; negative by how far they overlap: the shortest shift that would part them.
    """
    return stretched_clearance(table, pose, FRONT, REAR)  # type: ignore[no-any-return]


@compiled
def stretched_clearance(table: Any, pose: Any, front: float, rear: float) -> Any:
    """Return the clearance of a footprint that reaches farther ahead or behind than the chair."""
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    ahead = (front - rear) / 2
    chair = (pose[0] + ahead * cos, pose[1] + ahead * sin, cos, sin, (front + rear) / 2)
    best = FAR
    for k in range(len(table)):
        best = min(best, _gap(table[k], chair, best))
    return best


@compiled
def _gap(box: Any, chair: Any, enough: float) -> Any:
    """Signed distance of two rectangles; anything above ``enough`` when it is no less."""
    x, y, cos, sin, half = chair
    dx, dy = box[0] - x, box[1] - y
    px, py = dx * cos + dy * sin, dy * cos - dx * sin
    ux, uy = box[2] * cos + box[3] * sin, box[3] * cos - box[2] * sin
    length, width = box[4], box[5]
    along, across = px * ux + py * uy, py * ux - px * uy
    # The widest gap between the shadows on the four edge directions bounds the distance from
    # below, and is the depth of the overlap when no direction parts them.
    apart = max(
        abs(px) - half - length * abs(ux) - width * abs(uy),
        abs(py) - HALF_WIDTH - length * abs(uy) - width * abs(ux),
        abs(along) - length - half * abs(ux) - HALF_WIDTH * abs(uy),
        abs(across) - width - half * abs(uy) - HALF_WIDTH * abs(ux),
    )
    if apart <= 0.0 or apart >= enough:
        return apart
    # Apart, the nearest points are a corner of one and the other rectangle.
    square = np.inf
    for i in range(4):
        a = 1.0 if i < 2 else -1.0
        b = 1.0 if i % 2 == 0 else -1.0
        ex = abs(px + a * length * ux - b * width * uy) - half
        ey = abs(py + a * length * uy + b * width * ux) - HALF_WIDTH
        square = min(square, max(ex, 0.0) ** 2 + max(ey, 0.0) ** 2)
        ex = abs(a * half * ux + b * HALF_WIDTH * uy - along) - length
        ey = abs(b * HALF_WIDTH * ux - a * half * uy - across) - width
        square = min(square, max(ex, 0.0) ** 2 + max(ey, 0.0) ** 2)
    return math.sqrt(square)
