"""Gates are passed in their order, by moving across them in the right direction."""

import math

from protocols.course.schema import Course, Gate, Point
from protocols.pose import Pose


def forward(gate: Gate) -> Point:
    """Return the unit vector that points through a gate in the right direction.

    Examples
    --------
    >>> forward(Gate(name="F", left=(0.0, 1.0), right=(0.0, -1.0)))
    (1.0, 0.0)
    """
    dx, dy = gate.left[0] - gate.right[0], gate.left[1] - gate.right[1]
    length = math.hypot(dx, dy)
    return dy / length, (gate.right[0] - gate.left[0]) / length


def crossing(gate: Gate, before: Point, after: Point) -> float | None:
    """Return where on the way from one point to another a gate is passed.

    Parameters
    ----------
    gate
        The line between its two posts.
    before, after
        The reference point before and after a move, m.

    Returns
    -------
    float or None
        The fraction of the move made when the line is reached, in (0, 1]; None when it is not
        passed, is passed backwards or beside the posts.

    Examples
    --------
    >>> finish = Gate(name="F", left=(0.0, 1.0), right=(0.0, -1.0))
    >>> crossing(finish, (-0.25, 0.0), (0.75, 0.0))
    0.25
    >>> crossing(finish, (0.75, 0.0), (-0.25, 0.0)) is None
    True
    """
    fx, fy = forward(gate)
    behind = (before[0] - gate.right[0]) * fx + (before[1] - gate.right[1]) * fy
    ahead = (after[0] - gate.right[0]) * fx + (after[1] - gate.right[1]) * fy
    if not behind < 0 <= ahead:
        return None
    share = behind / (behind - ahead)
    x = before[0] + share * (after[0] - before[0]) - gate.right[0]
    y = before[1] + share * (after[1] - before[1]) - gate.right[1]
    from_right = -fy * x + fx * y
    return share if 0 <= from_right <= math.dist(gate.left, gate.right) else None


class GateCounter:
    """Counts the gates of a lap as the chair moves.

    Attributes
    ----------
    passed
        How many gates the chair has passed.
    """

    def __init__(self, course: Course) -> None:
        self._gates = course.gates
        self.passed = 0

    @property
    def finished(self) -> bool:
        """Whether the last gate has been passed."""
        return self.passed == len(self._gates)

    def advance(self, before: Pose | Point, after: Pose | Point) -> float | None:
        """Count the gates passed in a move of the reference point.

        Returns
        -------
        float or None
            The fraction of the move made when the last of them was passed, None without any.
        """
        last = None
        while not self.finished:
            share = crossing(self._gates[self.passed], before[:2], after[:2])
            if share is None or (last is not None and share < last):
                break
            last = share
            self.passed += 1
        return last
