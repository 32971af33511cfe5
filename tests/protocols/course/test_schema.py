"""What a course file may say."""

import copy

import pytest
from pydantic import ValidationError

from protocols.course.schema import Course
from protocols.files.fault import InconsistentError


def _fault(data):
    with pytest.raises(ValidationError) as caught:
        Course.model_validate(data)
    error = caught.value.errors()[0].get("ctx", {}).get("error")
    assert isinstance(error, InconsistentError), caught.value
    return error.faults[0]


def test_a_plain_course_is_accepted(ring):
    """Walls, furniture, start, gates, centreline and sections make a course."""
    course = Course.model_validate(ring)
    assert [gate.name for gate in course.gates] == ["R1", "R2", "F"]


@pytest.mark.parametrize("field", ["walls", "start", "gates", "centreline", "sections"])
def test_nothing_essential_may_be_missing(ring, field):
    """A course without one of its parts is refused at that field."""
    del ring[field]
    with pytest.raises(ValidationError) as caught:
        Course.model_validate(ring)
    assert caught.value.errors()[0]["loc"] == (field,)


def test_a_misspelt_field_is_refused(ring):
    """An unknown field is an error, not silence."""
    ring["walls"][0]["thicknes"] = 0.2
    with pytest.raises(ValidationError, match="thicknes"):
        Course.model_validate(ring)


@pytest.mark.parametrize("bad", [float("nan"), float("inf"), 1e9])
def test_coordinates_are_finite_and_within_a_kilometre(ring, bad):
    """NaN, infinity and places on the moon are refused."""
    ring["start"]["x"] = bad
    with pytest.raises(ValidationError):
        Course.model_validate(ring)


def test_only_the_last_section_may_go_without_an_end(ring):
    """A section in the middle must say where it ends."""
    del ring["sections"][0]["until"]
    fault = _fault(ring)
    assert fault.where == ("sections", 0, "until")
    assert "only the last" in fault.message


@pytest.mark.parametrize(("index", "until"), [(1, 2.0), (1, 3.0), (0, 99.0)])
def test_sections_follow_one_another_within_the_centreline(ring, index, until):
    """A section that ends before the one ahead of it, or past the end, is refused."""
    ring["sections"][index]["until"] = until
    fault = _fault(ring)
    assert fault.where[0] == "sections"
    assert "allowed" in fault.message


def test_the_last_section_ends_with_the_centreline(ring):
    """An end given for the last section must be the centreline's."""
    ring["sections"][-1]["until"] = 5.0
    assert _fault(ring).where == ("sections", 2, "until")
    ring["sections"][-1]["until"] = 14.5
    Course.model_validate(ring)


def test_names_in_the_record_are_unique(ring):
    """Two gates or sections of one name could not be told apart later."""
    ring["sections"][2]["name"] = "out"
    assert _fault(ring).where == ("sections", 2, "name")


def test_lines_have_length(ring):
    """A repeated point, a gate without width and a closed wall closed twice are refused."""
    for change, where in (
        (lambda d: d["centreline"].insert(1, [1, 0]), ("centreline", 1)),
        (lambda d: d["gates"][1].update(left=[2, -2.1]), ("gates", 1)),
        (lambda d: d["walls"][1]["points"].append([1, -1]), ("walls", 1, "points", 4)),
    ):
        data = copy.deepcopy(ring)
        change(data)
        assert _fault(data).where == where
