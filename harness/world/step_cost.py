"""How long a course's world takes for a control step, compared with another course's."""

import time

import numpy as np

from harness.world.world import World
from lad.command import Command
from protocols.course.schema import Course

_STEPS = 30
_ROUNDS = 10


def step_cost_ratio(course: Course, reference: Course) -> float:
    """Return how many times as long a control step takes on a course as on another one.

    The chair drives gently straight on from its start. Rounds on both courses take turns and the
    quickest of each counts: what else the machine does slows both.
    """
    from harness.world.bullet_world import BulletWorld  # noqa: PLC0415  # loads PyBullet

    worlds = BulletWorld(course), BulletWorld(reference)
    rounds = [[_round_s(world) for world in worlds] for _ in range(_ROUNDS)]
    ours, theirs = np.min(rounds, axis=0)
    return float(ours / theirs)


def _round_s(world: World) -> float:
    world.reset(np.random.default_rng(0))
    begun = time.perf_counter()
    for _ in range(_STEPS):
        world.observe()
        world.step(world.safeguard(Command(0.05, 0.0)))
    return time.perf_counter() - begun
