"""A course that cannot be driven is refused, with the reason."""

import math

import pytest

from protocols import wheelchair
from protocols.course.drivable import check_drivable, footprint, undrivable
from protocols.course.schema import Course
from protocols.files.errors import InputError
from protocols.load import load_course, shipped_courses


def _fault(data):
    fault = undrivable(Course.model_validate(data))
    assert fault is not None
    return fault


@pytest.mark.parametrize("name", shipped_courses())
def test_shipped_courses_can_be_driven(name):
    """No shipped course is refused."""
    assert undrivable(load_course(name)) is None


def test_the_ring_can_be_driven(ring_course):
    """Nor is the course these tests start from."""
    check_drivable(ring_course)


@pytest.mark.parametrize("x", [4.9, 4.96 - wheelchair.FRONT])
def test_a_start_inside_a_wall_is_refused(ring, x):
    """The chair's whole footprint must be free where a lap starts."""
    ring["start"] = {"x": x, "y": -0.2, "heading": 0.0}
    fault = _fault(ring)
    assert fault.where == ("start",)
    assert "outside" in fault.message


def test_a_start_in_furniture_is_refused(ring):
    """What the chair would stand in is named."""
    ring["furniture"].append({"name": "sofa", "x": 1.3, "y": 0.1, "length": 0.5, "width": 0.3})
    assert "'sofa'" in _fault(ring).message


def test_a_start_far_from_the_centreline_is_refused(ring):
    """Arc lengths would begin somewhere else."""
    ring["start"] = {"x": 0.0, "y": -3.0, "heading": 1.5}
    assert "centreline" in _fault(ring).message


def test_a_closed_gate_is_refused(ring):
    """An obstacle across a gate leaves an opening, and the chair's width does not fit."""
    ring["furniture"].append({"name": "door", "x": 2, "y": -3.0, "length": 0.1, "width": 1.0})
    fault = _fault(ring)
    assert fault.where == ("gates", 1)
    assert "door" in fault.message
    assert "R2 is closed" in fault.message


def test_a_gate_narrower_than_the_chair_is_refused(ring):
    """A gate's posts may themselves be too near to one another."""
    ring["gates"][0].update(left=[4, 0.2], right=[4, -0.2])
    assert "0.40 m" in _fault(ring).message


def test_a_blocked_way_is_refused(ring):
    """A way narrower than the chair between two gates is found out."""
    ring["furniture"].append({"name": "crate", "x": 4.0, "y": -2.5, "length": 1.5, "width": 0.3})
    ring["centreline"][1:3] = [[4.85, 0], [4.85, -3]]
    fault = _fault(ring)
    assert fault.where == ("gates", 1)
    assert "no way" in fault.message
    assert "gate R1" in fault.message


def test_the_way_round_the_other_side_does_not_count(ring):
    """A gate must be reached at its rear: through the ring backwards R1 is only seen in front."""
    ring["gates"][0].update(left=[2.8, 0.94], right=[2.8, -0.94])
    ring["furniture"].append({"name": "crate", "x": 2.2, "y": -0.3, "length": 0.3, "width": 1.5})
    ring["centreline"] = [
        [1, 0], [2.2, 0.8], [4.5, 0], [4.5, -3], [0, -3], [0, 0], [0.5, 0]
    ]  # fmt: skip
    ring["sections"] = [{"name": "all", "kind": "straight"}]
    fault = _fault(ring)
    assert fault.where == ("gates", 0)
    assert "from the start" in fault.message


def test_a_centreline_through_an_obstacle_is_refused(ring):
    """Where it happens is said."""
    ring["furniture"].append({"name": "post", "x": 4.5, "y": -1.5, "length": 0.1, "width": 0.1})
    fault = _fault(ring)
    assert fault.where == ("centreline",)
    assert "(4.50, -1.45)" in fault.message


def test_a_centreline_that_misses_a_gate_is_refused(ring):
    """Gates in another order than the centreline's, or turned round, are not passed."""
    ring["gates"][0], ring["gates"][1] = ring["gates"][1], ring["gates"][0]
    assert "does not pass gate R1" in _fault(ring).message
    ring["gates"][0], ring["gates"][1] = ring["gates"][1], ring["gates"][0]
    ring["gates"][1].update(left=[2, -2.1], right=[2, -3.9])
    assert "does not pass gate R2" in _fault(ring).message


def test_a_centreline_that_goes_on_is_refused(ring):
    """It ends at the last gate."""
    ring["centreline"][-1] = [2.0, 0.0]
    ring["start"]["x"] = 1.0
    assert "1.50 m from the last gate" in _fault(ring).message


def test_the_refusal_is_one_line_that_names_the_course(ring):
    """As an error it says course, field and reason."""
    ring["start"]["x"] = 4.9
    with pytest.raises(InputError, match=r"^course ring: start: the chair would stand in 'out"):
        check_drivable(Course.model_validate(ring))


def test_the_footprint_has_the_chairs_size():
    """Length, width and overhang are the chair's, around the axle's midpoint."""
    chair = footprint(2.0, 1.0, math.pi / 2)
    assert chair.bounds == pytest.approx(
        (
            2 - wheelchair.WIDTH / 2,
            1 - wheelchair.REAR,
            2 + wheelchair.WIDTH / 2,
            1 + wheelchair.FRONT,
        )
    )
