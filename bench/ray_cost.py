"""What one scan of our laser costs among more and more boxes."""

import statistics
import time

import numpy as np
from synthetic_course import synthetic_course

from harness.world.laser import Laser
from protocols.course.centreline import Centreline
from protocols.course.obstacles import obstacle_boxes
from protocols.pose import Pose

BOXES = (20, 60, 200)
POSES = 200
REPETITIONS = 15


def print_ray_cost(rays: int) -> None:
    """Print microseconds per scan, noise and segments included, for both casters."""
    print(f"\nMicroseconds per scan of {rays} rays, noise and segments included\n")
    print(f"| caster | {' | '.join(f'{n} boxes' for n in BOXES)} | 200 / 20 boxes |")
    print("|---|---:|---:|---:|---:|")
    for caster in ("sweep", "pybullet"):
        lasers = {n: _laser(n, rays, caster) for n in BOXES}
        times: dict[int, list[float]] = {n: [] for n in BOXES}
        for _ in range(REPETITIONS):
            for n, (laser, poses) in lasers.items():
                times[n].append(_scans(laser, poses))
        cost = {n: statistics.median(values) for n, values in times.items()}
        cells = " | ".join(f"{1e6 * cost[n]:.1f}" for n in BOXES)
        print(f"| {caster} | {cells} | {cost[200] / cost[20]:.2f} |")


def _laser(boxes: int, rays: int, caster: str) -> tuple[Laser, list[Pose]]:
    """Return a laser, and where it looks from: evenly along the path."""
    course = synthetic_course(boxes)
    line = Centreline(course)
    poses = [line.point(arc) for arc in np.linspace(0.0, line.length, POSES)]
    laser = Laser(obstacle_boxes(course), rays, caster)
    laser.scan(poses[0], np.random.default_rng(0))
    return laser, poses


def _scans(laser: Laser, poses: list[Pose]) -> float:
    """Return CPU seconds per scan."""
    rng = np.random.default_rng(0)
    begun = time.process_time()
    for pose in poses:
        laser.scan(pose, rng)
    return (time.process_time() - begun) / len(poses)
