"""Follow a closed path by pure pursuit: the same control for every simulator.

Coulter (1992), Implementation of the pure pursuit path tracking algorithm, CMU-RI-TR-92-01.
"""

import itertools
import math

from lad.command import Command
from protocols.course.schema import Course
from protocols.pose import Pose
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

LOOKAHEAD = 0.8
"""Distance of the point aimed at, m."""

SPACING = 0.1
"""Distance between the path's points, m."""


class Pursuit:
    """Steers along a course's centreline, closed to a loop, for as long as one likes."""

    def __init__(self, course: Course) -> None:
        corners = [*course.centreline, course.centreline[0]]
        self._points: list[tuple[float, float]] = []
        for (ax, ay), (bx, by) in itertools.pairwise(corners):
            n = max(1, round(math.dist((ax, ay), (bx, by)) / SPACING))
            self._points += [(ax + i / n * (bx - ax), ay + i / n * (by - ay)) for i in range(n)]
        self._at = 0

    def restart(self) -> None:
        """Aim from the beginning of the path again."""
        self._at = 0

    def aim(self, pose: Pose) -> tuple[float, float]:
        """Return the first point of the path, from the last one on, beyond the lookahead."""
        while math.dist(self._points[self._at], pose[:2]) <= LOOKAHEAD:
            self._at = (self._at + 1) % len(self._points)
        return self._points[self._at]

    def act(self, pose: Pose) -> Command:
        """Return full speed and the turn rate whose circle leads through the point aimed at."""
        x, y = self.aim(pose)
        dx, dy = x - pose.x, y - pose.y
        left = math.cos(pose.heading) * dy - math.sin(pose.heading) * dx
        w = 2.0 * MAX_SPEED * left / (dx * dx + dy * dy)
        return Command(MAX_SPEED, min(max(w, -MAX_TURN_RATE), MAX_TURN_RATE))
