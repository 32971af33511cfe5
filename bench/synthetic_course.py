"""A course of 12 x 10 m with any number of boxes: the same geometry for every simulator."""

import math
from collections.abc import Iterator

import numpy as np
import shapely

from protocols.course.schema import Course, Furniture, Gate, Point, Section, Start, Wall

LENGTH, WIDTH = 12.0, 10.0
"""The room's size, m."""

BLOCK = 4.5
"""Distance of the block in the middle from the outer walls, m."""

INSET = 1.7
"""Distance of the path from the outer walls, m."""

CORNER_RADIUS = 1.5
"""Full speed through it takes 0.47 rad/s: within what the chair can turn, m."""

CLEAR = 0.8
"""How far every box stays away from the path, m."""

TRIES = 5000
"""How often a place for a box is drawn; 200 boxes take some 1,700."""

WALLS = 8
"""Boxes taken by the room and by the block in its middle."""


def synthetic_course(boxes: int, seed: int = 0) -> Course:
    """Return a room with a block in its middle, and furniture wherever the path leaves room.

    The lap runs once around the block, anticlockwise: a limitation of right turns then costs its
    computation and leaves the same way for every driver. Fewer boxes are a subset of more.

    Parameters
    ----------
    boxes
        Number of obstacle boxes in all, at least ``WALLS``.
    seed
        Of the furniture's places, sizes and headings.
    """
    line = _loop()
    return Course(
        name=f"{boxes} boxes",
        title=f"Room of 12 x 10 m with {boxes} boxes",
        walls=(
            Wall(name="room", closed=True, points=_rectangle(0.0)),
            Wall(name="block", closed=True, points=_rectangle(BLOCK)),
        ),
        furniture=tuple(_furniture(boxes - WALLS, line, np.random.default_rng(seed))),
        start=Start(x=line[0][0], y=line[0][1], heading=0.0),
        gates=(
            Gate(name="east", left=(LENGTH - BLOCK, WIDTH / 2), right=(LENGTH, WIDTH / 2)),
            Gate(name="north", left=(LENGTH / 2, WIDTH - BLOCK), right=(LENGTH / 2, WIDTH)),
            Gate(name="west", left=(BLOCK, WIDTH / 2), right=(0.0, WIDTH / 2)),
            Gate(name="F", left=(line[-1][0], BLOCK), right=(line[-1][0], 0.0)),
        ),
        centreline=line,
        sections=(Section(name="lap", kind="left"),),
    )


def _rectangle(inset: float) -> tuple[Point, ...]:
    right, top = LENGTH - inset, WIDTH - inset
    return ((inset, inset), (right, inset), (right, top), (inset, top))


def _loop() -> tuple[Point, ...]:
    """Return a rounded rectangle from the middle of its lower leg, stopping 0.5 m short of it."""
    r = CORNER_RADIUS
    low_x, high_x, low_y, high_y = INSET + r, LENGTH - INSET - r, INSET + r, WIDTH - INSET - r
    centres = ((high_x, low_y), (high_x, high_y), (low_x, high_y), (low_x, low_y))
    points = [(LENGTH / 2, INSET)]
    for corner, (x, y) in enumerate(centres):
        for degrees in range(0, 91, 10):
            angle = math.radians(-90 + 90 * corner + degrees)
            points.append((round(x + r * math.cos(angle), 4), round(y + r * math.sin(angle), 4)))
    points.append((LENGTH / 2 - 0.5, INSET))
    return tuple(points)


def _furniture(n: int, line: tuple[Point, ...], rng: np.random.Generator) -> Iterator[Furniture]:
    """Draw boxes until enough stand free of the path, the walls and one another."""
    taken = [
        shapely.LinearRing(line).buffer(CLEAR),
        shapely.box(BLOCK, BLOCK, LENGTH - BLOCK, WIDTH - BLOCK).buffer(0.1),
    ]
    placed = 0
    for _ in range(TRIES):
        if placed == n:
            return
        x, y = rng.uniform((0.5, 0.5), (LENGTH - 0.5, WIDTH - 0.5))
        heading = rng.uniform(0.0, math.tau)
        length, width = rng.uniform(0.15, 0.45, 2)
        along = np.array([math.cos(heading), math.sin(heading)]) * length / 2
        across = np.array([-math.sin(heading), math.cos(heading)]) * width / 2
        corners = (along + across, across - along, -along - across, along - across)
        box = shapely.Polygon([corner + np.array([x, y]) for corner in corners])
        if any(box.intersects(other) for other in taken):
            continue
        taken.append(box)
        placed += 1
        values = {"x": x, "y": y, "heading": heading, "length": length, "width": width}
        yield Furniture(
            name=f"box {placed}",
            height=round(rng.uniform(0.5, 1.2), 2),
            **{key: round(float(value), 4) for key, value in values.items()},
        )
    raise ValueError(f"no room for {n} boxes beside the path, only for {placed}")
