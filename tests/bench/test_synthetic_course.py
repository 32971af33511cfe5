"""The course every simulator gets."""

import numpy as np
import pytest
import shapely
from synthetic_course import CLEAR, WALLS, synthetic_course

from protocols.course.drivable import undrivable
from protocols.course.obstacles import obstacle_boxes


@pytest.mark.parametrize("boxes", [WALLS, 20, 200])
def test_it_has_as_many_boxes_as_asked_for_and_can_be_driven(boxes: int) -> None:
    """Walls included, the number of boxes is what was asked for, and a lap can be driven."""
    course = synthetic_course(boxes)
    assert len(obstacle_boxes(course)) == boxes
    assert undrivable(course) is None


def test_fewer_boxes_are_a_subset() -> None:
    """Only furniture is added, so that a cost per box is the cost of more of the same."""
    few, many = synthetic_course(20), synthetic_course(200)
    assert many.furniture[: len(few.furniture)] == few.furniture
    assert (few.walls, few.centreline, few.gates) == (many.walls, many.centreline, many.gates)


def test_boxes_stand_apart_and_off_the_path() -> None:
    """No two pieces of furniture overlap, and none is nearer to the path than promised."""
    course = synthetic_course(200)
    shapes = np.array([shapely.Polygon(b.corners()) for b in obstacle_boxes(course)[WALLS:]])
    tree = shapely.STRtree(shapes)
    assert tree.query(shapes, predicate="intersects").shape[1] == len(shapes)
    path = shapely.LinearRing(course.centreline)
    assert min(path.distance(shape) for shape in shapes) > CLEAR - 0.01


def test_another_seed_is_another_course() -> None:
    """The seed decides where the furniture stands, and nothing else does."""
    assert synthetic_course(20, seed=3) == synthetic_course(20, seed=3)
    assert synthetic_course(20, seed=3).furniture != synthetic_course(20, seed=4).furniture


def test_a_course_that_cannot_be_furnished_is_refused() -> None:
    """More boxes than there is room for end in one line, not in an endless search."""
    with pytest.raises(ValueError, match="no room for 4992 boxes beside the path"):
        synthetic_course(5000)
