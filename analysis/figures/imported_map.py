"""A robot's map with a grid, or with the course that was made of it."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import MultipleLocator

from analysis.figures.plan import draw_plan
from protocols.course.centreline import Centreline
from protocols.course.drivable import footprint
from protocols.course.schema import Course, SectionKind
from protocols.importing.map.ros_map import RosMap
from protocols.pose import Pose

_FREE, _UNKNOWN, _OCCUPIED = 1.0, 0.75, 0.35

_WALL = "#CC79A7"
_ARROWS = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Shares of the route at which an arrow shows the way."""

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
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MultipleLocator(_grid_m(max(drawn.size))))
    axes.grid(visible=True, color="#0072B2", linewidth=0.4, alpha=0.6)
    axes.set(xlabel="x in m", ylabel="y in m", title=drawn.path.stem)
    return figure


def map_with_course(drawn: RosMap, course: Course) -> Figure:
    """Return a map under a course: walls, gates, sections, the way, and the chair at the start."""
    figure = Figure(figsize=(9, 9), layout="constrained")
    axes = figure.subplots()
    draw_plan(axes, course, _WALL)
    limits = axes.get_xlim(), axes.get_ylim()
    _draw_map(axes, drawn)
    line = Centreline(course)
    for section in line.sections:
        arcs = np.linspace(section.start, section.end, 50)
        points = np.array([line.point(arc)[:2] for arc in arcs])
        axes.plot(*points.T, color=_COLOURS[section.kind], linewidth=2)
    start = course.start
    chair = np.array(footprint(start.x, start.y, start.heading).exterior.coords)
    axes.plot(*chair.T, color="black", linewidth=1)
    for share in _ARROWS:
        _arrow(axes, line.point(share * line.length))
    axes.set(xlim=limits[0], ylim=limits[1], xlabel="x in m", ylabel="y in m", title=course.title)
    axes.axis("on")
    there = {section.kind for section in line.sections}
    lines = [Line2D([], [], color=c, label=_LABELS[k]) for k, c in _COLOURS.items() if k in there]
    lines.append(Line2D([], [], color=_WALL, linewidth=3, label="wall of the course"))
    lines.append(Line2D([], [], color=str(_OCCUPIED), linewidth=3, label="obstacle on the map"))
    lines.append(Line2D([], [], color="black", linewidth=1, label="the chair at the start"))
    axes.legend(handles=lines, loc="best", fontsize=8)
    return figure


def _grid_m(size: float) -> float:
    """Return the distance of a grid's lines, m: about 20 of them at most."""
    return next((step for step in (0.5, 1.0, 2.0, 5.0, 10.0, 20.0) if size <= 20 * step), 50.0)


def _arrow(axes: Axes, at: Pose) -> None:
    """Draw an arrowhead that points the way."""
    shape = {"arrowstyle": "-|>", "color": "black", "mutation_scale": 14, "linewidth": 0}
    ahead = (at.x + 0.3 * np.cos(at.heading), at.y + 0.3 * np.sin(at.heading))
    axes.annotate("", xy=ahead, xytext=(at.x, at.y), arrowprops=shape)


def _draw_map(axes: Axes, drawn: RosMap) -> None:
    shades = np.full(drawn.free.shape, _UNKNOWN)
    shades[drawn.free] = _FREE
    shades[drawn.occupied] = _OCCUPIED
    every = -(-max(shades.shape) // 2000)
    rows, columns = drawn.free.shape
    corner, along, up = (np.array(drawn.outward(*at)) for at in ((0, 0), (1, 0), (0, 1)))
    x, y = (np.arange(0, n + 1, every)[:, None] * drawn.cell for n in (columns, rows))
    corners = corner + (y * (up - corner))[:, None] + (x * (along - corner))[None]
    # The darkest of the cells that are drawn as one: a thin wall stays.
    whole = shades[: (len(corners) - 1) * every, : (corners.shape[1] - 1) * every]
    seen = whole.reshape(len(corners) - 1, every, -1, every).min(axis=(1, 3))
    axes.pcolormesh(
        corners[:, :, 0], corners[:, :, 1], seen, cmap="gray", vmin=0, vmax=1, rasterized=True,
        zorder=0,
    )  # fmt: skip
    axes.set_aspect("equal")
