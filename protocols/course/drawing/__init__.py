"""A course as a browser draws it: plan and first-person view, for live pages and for replays."""

from importlib.resources import files

from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course

SCRIPTS = ("plan.js", "view3d.js")
"""JavaScript modules that draw what ``course_picture`` returns."""


def course_picture(course: Course) -> dict[str, object]:
    """Return the course as the scripts take it: what stands there, and the gates.

    Lengths in m, headings in rad; ``boxes``: centre, heading, length, width, height, name;
    ``gates``: name, left and right end; ``start``: position.
    """
    boxes = [
        [b.cx, b.cy, b.heading, b.length, b.width, b.height, b.name] for b in obstacle_boxes(course)
    ]
    gates = [[g.name, list(g.left), list(g.right)] for g in course.gates]
    return {"boxes": boxes, "gates": gates, "start": [course.start.x, course.start.y]}


def script(name: str) -> str:
    """Return the text of one of ``SCRIPTS``."""
    return files("protocols.course.drawing").joinpath(name).read_text("utf-8")
