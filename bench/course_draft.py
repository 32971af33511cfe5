"""What every course is drafted with: rounded corners, fittings beside the way, the file."""

import argparse
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from ruamel.yaml import YAML

from protocols.course.centreline import Centreline
from protocols.course.drivable import check_drivable
from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course

LEFT, RIGHT = 1, -1

ARC_STEP = 15.0
"""Rounded corners are chords of this turn at most, degrees."""


@dataclass(frozen=True)
class Fitting:
    """A niche or a piece of furniture beside the centreline.

    ``at`` is (corner or leg name, metres from its start); ``clear`` is the distance from the
    centreline to its near side; ``along`` and ``deep`` are its size; ``turn`` twists it.
    """

    name: str
    at: tuple[str, float]
    side: int
    clear: float
    along: float
    deep: float
    height: float = 0.8
    turn: float = 0.0


def round_corners(
    corners: np.ndarray, degrees: Sequence[float], radii: Sequence[float]
) -> tuple[np.ndarray, list[float]]:
    """Round the corners between a way's legs.

    Parameters
    ----------
    corners
        Shape (corners + 2, 2): start, corners, end; m.
    degrees
        Turn at each corner, left positive.
    radii
        Of each corner, m.

    Returns
    -------
    line
        Shape (points, 2).
    ends
        Arc length at which each leg and each corner ends, in the order driven, m.
    """
    line, ends = [corners[0]], []
    for i, (turn_degrees, radius) in enumerate(zip(degrees, radii, strict=True), start=1):
        turn = math.radians(turn_degrees)
        into = unit(corners[i] - corners[i - 1])
        begin = corners[i] - radius * math.tan(abs(turn) / 2) * into
        centre = begin + math.copysign(radius, turn) * np.array([-into[1], into[0]])
        angles = np.linspace(0.0, turn, math.ceil(abs(turn_degrees) / ARC_STEP) + 1)
        arc = [centre + _rotation(angle) @ (begin - centre) for angle in angles]
        line.append(arc[0])
        ends.append(_length(line))
        line += arc[1:]
        ends.append(_length(line))
    line.append(corners[-1])
    ends.append(_length(line))
    return np.array(line), ends


def fitting_corners(path: Centreline, ends: dict, fitting: Fitting) -> np.ndarray:
    """Return a fitting's corners on the floor plan."""
    centre, heading = _frame(path, ends, fitting)
    along = np.array([math.cos(heading), math.sin(heading)]) * fitting.along / 2
    across = np.array([-math.sin(heading), math.cos(heading)]) * fitting.deep / 2
    return np.array(
        [centre + a * along + b * across for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
    )


def place(path: Centreline, ends: dict, fitting: Fitting) -> dict:
    """Return a piece of furniture as it stands in a course file."""
    centre, heading = _frame(path, ends, fitting)
    return {
        "name": fitting.name, "x": millimetres(centre[0]), "y": millimetres(centre[1]),
        "heading": millimetres(math.remainder(heading + fitting.turn, math.tau)),
        "length": fitting.along, "width": fitting.deep, "height": fitting.height,
    }  # fmt: skip


def stub(draft: dict) -> Course:
    """Return a course with one wall and one gate, enough to measure along its centreline."""
    placeholder = {"name": "none", "points": [[90.0, 90.0], [91.0, 90.0]]}
    gate = {"name": "F", "left": [90.0, 91.0], "right": [90.0, 90.0]}
    return Course.model_validate({**draft, "walls": [placeholder], "gates": [gate]})


def unit(vector: np.ndarray) -> np.ndarray:
    """Return the direction of a vector."""
    return vector / np.hypot(*vector)


def millimetres(value: float) -> float:
    """Return a length in m, rounded as files have it."""
    return round(float(value), 3) + 0.0


def points(line: object) -> list[list[float]]:
    """Return points as files have them."""
    return [[millimetres(x), millimetres(y)] for x, y in line]


def draw(course: Course, path: Path) -> None:
    """Draw the plan as a PNG."""
    figure = Figure(figsize=(10, 9))
    axes = figure.subplots()
    for box in obstacle_boxes(course):
        axes.fill(*box.corners().T, color="0.35" if box.width == 0.1 else "peru")
    axes.plot(*np.array(course.centreline).T, ".-", lw=0.8)
    for gate in course.gates:
        axes.plot(*np.array([gate.left, gate.right]).T, "r-", lw=1)
        axes.text(*gate.left, gate.name, color="red")
    axes.plot(course.start.x, course.start.y, "g>", ms=10)
    axes.set_aspect("equal")
    axes.grid(lw=0.3)
    figure.savefig(path, dpi=80)


def write_course(lay_out: Callable[[], dict], description: str) -> None:
    """Be a script: write the course file and, on request, its picture; check what was written."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("out", type=Path)
    parser.add_argument("--picture", type=Path)
    arguments = parser.parse_args()
    data = lay_out()
    yaml = YAML()
    yaml.default_flow_style = None
    yaml.width = 100
    with arguments.out.open("w") as file:
        yaml.dump(data, file)
    course = Course.model_validate(data)
    if arguments.picture:
        draw(course, arguments.picture)
    check_drivable(course)
    print(f"{len(obstacle_boxes(course))} boxes, centreline {Centreline(course).length:.2f} m")


def _frame(path: Centreline, ends: dict, fitting: Fitting) -> tuple[np.ndarray, float]:
    section, metres = fitting.at
    x, y, heading = path.point(ends[section][0] + metres)
    outwards = fitting.side * np.array([-math.sin(heading), math.cos(heading)])
    return np.array([x, y]) + (fitting.clear + fitting.deep / 2) * outwards, heading


def _rotation(angle: float) -> np.ndarray:
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


def _length(line: list) -> float:
    return float(np.hypot(*np.diff(np.array(line), axis=0).T).sum())
