"""Draft a route file for a map."""

import numpy as np
from scipy import ndimage

from protocols.importing.map.ros_map import RosMap


def draft_route(drawn: RosMap) -> str:
    """Return the text of a route file to correct: it starts where most room is.

    Parameters
    ----------
    drawn
        The map.
    """
    distance = ndimage.distance_transform_edt(np.pad(drawn.free, 1))[1:-1, 1:-1]
    row, column = np.unravel_index(int(np.argmax(distance)), distance.shape)
    x, y = drawn.outward((float(column) + 0.5) * drawn.cell, (float(row) + 0.5) * drawn.cell)
    name = "".join(c if c.isalnum() else "-" for c in drawn.path.stem).strip("-") or "course"
    return (
        f"# Drafted for {drawn.path.name}: the start is where most room is. Put in the points to\n"
        "# pass (see the picture); a gate stands at each, the last one is the finish.\n"
        "schema: 1\n"
        f"name: {name}\n"
        f"start: {{x: {x:.2f}, y: {y:.2f}, heading: 0.0}}\n"
        f"via:\n  - [{x + 1:.2f}, {y:.2f}]\n"
    )
