"""A small course to bend in all directions: a ring around a block, driven clockwise."""

import copy
from typing import Any

import pytest

from protocols.course.schema import Course
from protocols.load import load_course

RING: dict[str, Any] = {
    "schema": 1,
    "name": "ring",
    "title": "Ring around a block",
    "walls": [
        {"name": "outside", "closed": True, "points": [[-1, 1], [5, 1], [5, -4], [-1, -4]]},
        {"name": "block", "closed": True, "points": [[1, -1], [3, -1], [3, -2], [1, -2]]},
    ],
    "furniture": [{"name": "bin", "x": 4.7, "y": 0.7, "length": 0.3, "width": 0.2, "heading": 0.4}],
    "start": {"x": 1.0, "y": 0.0, "heading": 0.0},
    "gates": [
        {"name": "R1", "left": [4, 0.9], "right": [4, -1]},
        {"name": "R2", "left": [2, -3.9], "right": [2, -2.1]},
        {"name": "F", "left": [0.5, 0.9], "right": [0.5, -0.9]},
    ],
    "centreline": [[1, 0], [4.5, 0], [4.5, -3], [0, -3], [0, 0], [0.5, 0]],
    "sections": [
        {"name": "out", "kind": "straight", "until": 3.0},
        {"name": "corner", "kind": "sharp_right", "until": 4.0},
        {"name": "back", "kind": "straight"},
    ],
}


@pytest.fixture
def ring() -> dict[str, Any]:
    """Return the course as data, for a test to change."""
    return copy.deepcopy(RING)


@pytest.fixture
def ring_course() -> Course:
    """Return the course as it is."""
    return Course.model_validate(RING)


@pytest.fixture(scope="session")
def lab_office() -> Course:
    """Return the shipped default course."""
    return load_course("lab-office")
