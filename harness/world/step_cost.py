"""How long a course's world takes for a control step on this machine."""

import time

import numpy as np

from lad.command import Command
from protocols.course.schema import Course

_STEPS = 100
_ROUNDS = 3


def step_cost(course: Course) -> float:
    """Return the time of a control step, s: the best of three rounds of a hundred.

    Parameters
    ----------
    course
        The course; the chair drives gently straight on from its start.
    """
    from harness.world.bullet_world import BulletWorld  # noqa: PLC0415  # loads PyBullet

    world = BulletWorld(course)
    best = float("inf")
    for _ in range(_ROUNDS):
        world.reset(np.random.default_rng(0))
        begun = time.perf_counter()
        for _ in range(_STEPS):
            world.observe()
            world.step(world.safeguard(Command(0.05, 0.0)))
        best = min(best, (time.perf_counter() - begun) / _STEPS)
    return best
