"""Passages in which the simulated person gives up."""

import numpy as np

from protocols.course.route import Route
from protocols.course.route_checks import way_widths
from protocols.course.schema import Course
from protocols.files.errors import InputError

NARROWEST_FOR_PEOPLE = 0.85
"""Width of the narrowest opening that people pass, m. Of three or four people in a hall with a
passage in it, everybody passed 0.85 m over 0.5 to 4 m and 0.90 m over 4 to 8 m within the 300 s of
a lap; through a doorway of 0.80 m one of three came, after 266 s. The autonomous driver passes
both (`bench/passages.py`)."""

ROUGHLY = 0.01
"""How exactly a width is known, m."""


def check_passages(course: Course, route: Route) -> None:
    """Check that people were measured to pass the narrowest opening of a way.

    Raises
    ------
    InputError
        When they were not; says where it is, and what is allowed.
    """
    widths = way_widths(course, route)
    narrowest = int(np.argmin(widths))
    if widths[narrowest] < NARROWEST_FOR_PEOPLE - ROUGHLY:
        x, y = route.points[narrowest]
        raise InputError(
            f"driver 'human': course {course.name}: the way is {widths[narrowest]:.2f} m wide at "
            f"({x:.2f}, {y:.2f}), where simulated people give up; allowed: at least "
            f"{NARROWEST_FOR_PEOPLE:.2f} m, or driver 'autonomous'"
        )
