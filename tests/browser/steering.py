"""Keys for the way along a course, from where a page shows the chair."""

import json
import math

from protocols.course.centreline import Centreline

AHEAD_M = 0.8
TURN_RAD, STOP_RAD = 0.10, 0.75


class Steering:
    """Holds the arrow keys of a page so that the chair follows the course's centreline.

    Parameters
    ----------
    tab
        The participant's page, with a lap on it.
    course
        What is driven.
    """

    def __init__(self, tab, course):
        self.tab, self.line = tab, Centreline(course)
        self.held, self.arc = set(), 0.0

    def pose(self):
        """Return where the page shows the chair; None before the first picture."""
        shown = self.tab.evaluate("document.body.dataset.pose || 'null'")
        return json.loads(shown)

    def step(self):
        """Look once, and press and release what is needed; return the chair's section."""
        pose = self.pose()
        if pose is None:
            return None
        x, y, heading = pose
        self.arc, _ = self.line.locate(x, y, self.arc)
        goal = self.line.point(min(self.arc + AHEAD_M, self.line.length))
        bearing = math.atan2(goal.y - y, goal.x - x) - heading
        error = math.atan2(math.sin(bearing), math.cos(bearing))
        wanted = set()
        if abs(error) < STOP_RAD:
            wanted.add("ArrowUp")
        if error > TURN_RAD:
            wanted.add("ArrowLeft")
        if error < -TURN_RAD:
            wanted.add("ArrowRight")
        for key in self.held - wanted:
            self.tab.keyboard.up(key)
        for key in wanted - self.held:
            self.tab.keyboard.down(key)
        self.held = wanted
        return self.line.section(self.arc)

    def release(self):
        """Let go of every key."""
        for key in self.held:
            self.tab.keyboard.up(key)
        self.held = set()
