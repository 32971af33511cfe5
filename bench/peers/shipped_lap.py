"""A lap as shipped: driver, limitation, safeguard and record, in our world or in a peer's.

A peer thus gets everything but the simulation from us, which is the best that can happen to it.
"""

import math

import numpy as np
from peers.simulator import Simulator, bearings

from harness.session.arbitration import takeover
from harness.session.clock import VirtualClock
from harness.session.lap import Lap, LapParts, Rules
from harness.session.lap_log import LapLog
from harness.session.limitation import right_turn_limit
from harness.world.clearance import box_table, clearance
from harness.world.safeguard import Safeguard
from harness.world.world import Observation, World
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from lad.inputs import N_SEGMENTS
from participants.autonomous import autonomous_driver
from participants.setup import DriverSetup
from protocols.course.centreline import Centreline
from protocols.course.gates import GateCounter
from protocols.course.obstacles import obstacle_boxes
from protocols.course.schema import Course
from protocols.record.parquet import parquet_bytes
from protocols.wheelchair import LASER_AHEAD


class NoAssistant:
    """An assistant who never helps: the part is about the loop, not about the model."""

    def start_lap(self) -> None:
        """Nothing to forget."""

    def assist(self, x: np.ndarray) -> Assistance:  # noqa: ARG002  # the seam's
        """Stay out of it."""
        return NO_ASSISTANCE


def drive_shipped_lap(world: World, course: Course, time_limit_s: float) -> float:
    """Drive and record one lap, at most so long; return its length in simulated seconds."""
    driver = autonomous_driver(DriverSetup(course=course, rng=np.random.default_rng(0)))
    parts = LapParts(driver=driver, demonstrator=NoAssistant(), model=NoAssistant())
    rules = Rules(
        limitation=right_turn_limit(0.15),
        assistant="none",
        arbitration=takeover,
        safeguarded=True,
        training=False,
        time_limit_s=time_limit_s,
    )
    world.reset(np.random.default_rng(0))
    driver.start_lap(0, np.random.default_rng(0))
    log = LapLog(Centreline(course), demonstrated=False)
    ending = Lap(world, parts, rules, GateCounter(course)).drive(log, VirtualClock())
    parquet_bytes(log.table())
    return ending.t


class PeerWorld:
    """A peer as a world of ours: its motion and its scan, our safeguard."""

    def __init__(self, simulator: Simulator, course: Course, rays: int, rate_hz: int) -> None:
        boxes = obstacle_boxes(course)
        self._simulator = simulator
        self._table = box_table(boxes)
        self._guard = Safeguard(boxes, 1 / rate_hz)
        self._step = 0
        self.period = 1 / rate_hz
        self.bearings = bearings(rays)
        self.laser_offset = LASER_AHEAD
        edges = np.linspace(-math.pi / 2, math.pi / 2, N_SEGMENTS + 1)[:-1]
        self._firsts = np.searchsorted(self.bearings, edges)
        self._seen = self._look()

    def reset(self, rng: np.random.Generator) -> None:  # noqa: ARG002  # peers have no noise
        """Put the chair at the start, at rest."""
        self._simulator.restart()
        self._step = 0
        self._seen = self._look()

    def observe(self) -> Observation:
        """Return the instruments' readings."""
        return self._seen

    def safeguard(self, command: Command) -> Command:
        """Return the command, or what the last guard against hard collisions leaves of it."""
        return self._guard.guard(command, self._seen.pose, self._seen.velocity)

    def step(self, command: Command) -> None:
        """Follow a command for one control step."""
        self._simulator.step(command)
        self._step += 1
        self._seen = self._look()

    def _look(self) -> Observation:
        pose, ranges = self._simulator.sense()
        return Observation(
            t=self._step * self.period,
            pose=pose,
            velocity=self._simulator.velocity(),
            ranges=ranges,
            segments=np.minimum.reduceat(ranges, self._firsts),
            clearance_m=max(0.0, clearance(self._table, pose)),
            contact=False,
        )
