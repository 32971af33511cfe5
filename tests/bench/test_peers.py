"""The peers do what they are timed for: the same chair among the same boxes."""

import math
from collections.abc import Iterator
from importlib import import_module

import numpy as np
import pytest
import shapely
from lap_loop import OURS, SIMULATORS, check
from peers.simulator import FIELD_OF_VIEW, RANGE, Simulator
from synthetic_course import synthetic_course

from lad.command import Command
from protocols.course.obstacles import obstacle_boxes
from protocols.pose import Pose
from protocols.wheelchair import LASER_AHEAD

RAYS, RATE_HZ = 61, 20
COURSE = synthetic_course(20)

# What other people's packages warn about is not ours to mend.
pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.fixture(params=list(SIMULATORS))
def simulator(request: pytest.FixtureRequest) -> Iterator[Simulator]:
    """Give each simulator that is installed here, at the start of the smallest course."""
    module, _, factory = SIMULATORS[request.param].partition(":")
    try:
        make = getattr(import_module(f"peers.{module}"), factory)
    except ImportError as error:
        pytest.skip(str(error))
    made: Simulator = make(COURSE, RAYS, RATE_HZ)
    yield made
    made.close()


def test_it_follows_the_path_at_full_speed_and_drives_a_lap(simulator: Simulator) -> None:
    """Every simulator passes the check that precedes its timing."""
    check("it", simulator, COURSE, RATE_HZ)


def test_a_check_that_cannot_fail_would_check_nothing(simulator: Simulator) -> None:
    """A simulator that drives at half the speed is found out."""
    honest = simulator.step
    simulator.step = lambda command: honest(Command(command.v / 2, command.w / 2))
    with pytest.raises(AssertionError, match="drove"):
        check("it", simulator, COURSE, RATE_HZ)


@pytest.mark.parametrize("simulator", [name for name in SIMULATORS if name != OURS], indirect=True)
def test_it_measures_what_stands_there(simulator: Simulator) -> None:
    """While driving, rays end where another library's geometry says, grazing edges apart.

    Ours has noise and other bearings; its own tests hold it to exact distances.
    """
    errors = []
    simulator.restart()
    for _ in range(40):
        pose, ranges = simulator.sense()
        errors.append(np.abs(ranges - _exact(pose)))
        simulator.step(Command(0.6, 0.4))
    assert np.mean(np.array(errors) > 1e-4) < 0.005


def _exact(pose: Pose) -> np.ndarray:
    """Cut each ray by the union of all boxes."""
    x = pose.x + LASER_AHEAD * math.cos(pose.heading)
    y = pose.y + LASER_AHEAD * math.sin(pose.heading)
    angles = pose.heading + np.linspace(-FIELD_OF_VIEW / 2, FIELD_OF_VIEW / 2, RAYS)
    ends = np.stack([x + RANGE * np.cos(angles), y + RANGE * np.sin(angles)], axis=1)
    rays = shapely.linestrings(np.stack([np.tile((x, y), (RAYS, 1)), ends], axis=1))
    hits = shapely.intersection(rays, BUILT)
    ranges = shapely.distance(shapely.Point(x, y), hits)
    return np.where(shapely.is_empty(hits), RANGE, ranges)


BUILT = shapely.union_all([shapely.Polygon(box.corners()) for box in obstacle_boxes(COURSE)])
