"""The course seen from above: walls, furniture, start and gates."""

from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patheffects import withStroke

from analysis.figures.style import BLACK, GREY
from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course, Point

WALL, FURNITURE = "#4a4a4a", "#b8b8b8"


def draw_plan(axes: Axes, course: Course, wall: str = WALL) -> None:
    """Draw a course to scale, in metres, its walls in a colour."""
    names = {piece.name for piece in course.furniture}
    boxes = obstacle_boxes(course)
    walls = [box.corners() for box in boxes if box.name not in names]
    furniture = [box.corners() for box in boxes if box.name in names]
    axes.add_collection(PolyCollection(furniture, facecolors=FURNITURE, edgecolors="none"))
    axes.add_collection(PolyCollection(walls, facecolors=wall, edgecolors=wall, linewidths=0.3))
    gates = [(gate.left, gate.right) for gate in course.gates]
    axes.add_collection(LineCollection(gates, colors=GREY, linewidths=0.8, linestyles="--"))
    for gate in course.gates:
        _name(axes, gate.name, gate.left, (0, 3))
    axes.plot(course.start.x, course.start.y, marker="o", markersize=4, color=BLACK)
    _name(axes, "S", (course.start.x, course.start.y), (8, 4))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.axis("off")


def _name(axes: Axes, text: str, at: Point, shift: tuple[float, float]) -> None:
    axes.annotate(
        text, at, xytext=shift, textcoords="offset points", ha="center", color=BLACK, fontsize=9,
        fontweight="bold", path_effects=[withStroke(linewidth=2.5, foreground="white")],
    )  # fmt: skip
