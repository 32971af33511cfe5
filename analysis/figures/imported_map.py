"""A robot's map with a grid, or with the course that was made of it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from analysis.figures.plan import draw_plan
from protocols.course.centreline import Centreline
from protocols.course.schema import Course, SectionKind
from protocols.importing.map.ros_map import RosMap

_FREE, _UNKNOWN, _OCCUPIED = 1.0, 0.75, 0.35

_COLOURS: dict[SectionKind, str] = {
    "straight": "#0072B2",
    "sharp_right": "#D55E00",
    "soft_right": "#E69F00",
    "left": "#009E73",
}
_LABELS: dict[SectionKind, str] = {
    "straight": "straight",
    "sharp_right": "sharp right",
    "soft_right": "soft right",
    "left": "left",
}


def map_with_grid(drawn: RosMap) -> Figure:
    """Return a map with a grid in the metres of its world, to write a route by."""
    figure = Figure(figsize=(9, 9), layout="constrained")
    axes = figure.subplots()
    _draw_map(axes, drawn)
    axes.grid(visible=True, color="#0072B2", linewidth=0.4, alpha=0.6)
    axes.set(xlabel="x in m", ylabel="y in m", title=drawn.path.stem)
    return figure


def map_with_course(drawn: RosMap, course: Course) -> Figure:
    """Return a map under the walls, gates and sections of a course."""
    figure = Figure(figsize=(9, 9), layout="constrained")
    axes = figure.subplots()
    draw_plan(axes, course)
    limits = axes.get_xlim(), axes.get_ylim()
    _draw_map(axes, drawn)
    line = Centreline(course)
    for section in line.sections:
        arcs = np.linspace(section.start, section.end, 50)
        points = np.array([line.point(arc)[:2] for arc in arcs])
        axes.plot(*points.T, color=_COLOURS[section.kind], linewidth=2)
    axes.set(xlim=limits[0], ylim=limits[1], xlabel="x in m", ylabel="y in m", title=course.title)
    axes.axis("on")
    there = {section.kind for section in line.sections}
    lines = [Line2D([], [], color=c, label=_LABELS[k]) for k, c in _COLOURS.items() if k in there]
    axes.legend(handles=lines, loc="best", fontsize=8)
    return figure


def _draw_map(axes: Axes, drawn: RosMap) -> None:
    shades = np.full(drawn.free.shape, _UNKNOWN)
    shades[drawn.free] = _FREE
    shades[drawn.occupied] = _OCCUPIED
    every = max(1, max(shades.shape) // 2000)
    rows, columns = drawn.free.shape
    corners = np.array([[drawn.outward(x * drawn.cell, y * drawn.cell)
                         for x in range(0, columns + 1, every)]
                        for y in range(0, rows + 1, every)])  # fmt: skip
    seen = shades[::every, ::every][: len(corners) - 1, : corners.shape[1] - 1]
    axes.pcolormesh(
        corners[:, :, 0], corners[:, :, 1], seen, cmap="gray", vmin=0, vmax=1, rasterized=True,
        zorder=0,
    )  # fmt: skip
    axes.set_aspect("equal")
