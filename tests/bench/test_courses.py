"""The scripts that lay out courses write what is shipped, exactly."""

from pathlib import Path

import pytest
from lay_out_course import lab_office
from lay_out_ward import lay_out
from mirror_course import lab_office_mirror
from ruamel.yaml import YAML

COURSES = Path(__file__).parents[2] / "protocols" / "courses"


@pytest.mark.parametrize(
    ("script", "name"),
    [
        (lab_office, "lab-office"),
        (lab_office_mirror, "lab-office-mirror"),
        (lay_out, "ward-corridor"),
    ],
)
def test_the_file_is_what_its_script_writes(script, name):
    """Legs, angles, rooms and furniture of the script lead to the shipped file."""
    assert script() == YAML(typ="safe").load(COURSES / f"{name}.yaml")
