"""People give up in a passage that the planner and the autonomous driver still pass."""

import pytest

from participants.human.room import known_room
from protocols.course.drivable import undrivable
from protocols.course.schema import Course
from protocols.files.errors import InputError


def _hall(width, depth):
    """Return a hall of 12 x 4 m with a passage in its middle."""
    side = 2 - width / 2
    return Course.model_validate(
        {
            "name": "hall",
            "title": "Hall",
            "walls": [{"name": "hall", "closed": True,
                       "points": [[0, 0], [12, 0], [12, 4], [0, 4]]}],
            "furniture": [
                {"name": "r", "x": 6, "y": side / 2, "length": depth, "width": side},
                {"name": "l", "x": 6, "y": 4 - side / 2, "length": depth, "width": side},
            ],
            "start": {"x": 1.5, "y": 2, "heading": 0},
            "gates": [{"name": "F", "left": [10, 4], "right": [10, 0]}],
            "centreline": [[1.5, 2], [10, 2]],
            "sections": [{"name": "all", "kind": "straight"}],
        }
    )  # fmt: skip


@pytest.mark.parametrize("depth", [0.1, 4.0])
@pytest.mark.parametrize("width", [0.8, 0.85, 0.9])
def test_a_passage_is_refused_where_people_were_measured_to_give_up(width, depth):
    """With its width and place; the course by itself can be driven."""
    course = _hall(width, depth)
    assert undrivable(course) is None
    if width >= 0.85:
        known_room(course)
        return
    with pytest.raises(InputError, match=r"^driver 'human': course hall: .* 0\.80 m wide at \("):
        known_room(course)
