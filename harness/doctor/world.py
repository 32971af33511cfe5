"""Whether the world in PyBullet does what a session needs of it."""

import math

import numpy as np

from harness.doctor.finding import Finding

MEND = (
    "pip install numpy setuptools wheel && pip install --no-build-isolation --no-cache-dir "
    "--force-reinstall --no-deps pybullet==3.2.7"
)


def world_finding() -> Finding:
    """Build the world of a shipped course, and make a step in it."""
    what = "PyBullet's world"
    try:
        from harness.world.bullet_world import BulletWorld  # noqa: PLC0415  # it may be missing
        from lad.command import Command  # noqa: PLC0415
        from protocols.load import load_course  # noqa: PLC0415
    except ImportError as error:
        return Finding(what, f"cannot be loaded: {error}", ("run", "live"), MEND)
    world = BulletWorld(load_course("lab-office"))
    try:
        world.reset(np.random.default_rng(0))
        before = world.observe().pose
        for _ in range(5):
            world.step(Command(v=0.5, w=0.0))
        after = world.observe().pose
    finally:
        world.close()
    moved = math.hypot(after.x - before.x, after.y - before.y)
    if moved > 0:
        return Finding(what, f"the chair drives: {100 * moved:.0f} cm in 0.5 s")
    return Finding(what, "the chair does not move", ("run", "live"), MEND)
