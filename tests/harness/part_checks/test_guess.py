"""A part's role shows in its name, or in what its factory makes."""

import pytest

from harness.part_checks import Setting
from harness.part_checks.guess import guess_role
from protocols.files.errors import InputError


@pytest.mark.usefixtures("their_parts")
@pytest.mark.parametrize(
    ("part", "role"),
    [
        ("scripted", "driver"),
        ("lad", "assistant"),
        ("attentive", "demonstrator"),
        ("participants.human.driver:human_driver", "driver"),
        ("participants.impairments.tremor:tremor", "impairment"),
        ("lad.baselines.memoryless:make", "assistant"),
        ("their_parts:Ahead", "driver"),
        ("their_parts:Half", "impairment"),
        ("their_parts:Helping", "demonstrator"),
        ("their_parts:Remembering", "assistant"),
        ("their_parts:Agreeing", "respondent"),
        ("their_parts:OpenFloor", "world"),
        ("harness.world.bullet_world:BulletWorld", "world"),
    ],
)
def test_the_role_shows(part, role):
    """Shipped names, and dotted paths to a factory of every role."""
    assert guess_role(part, {}, Setting()) == role


@pytest.mark.usefixtures("their_parts")
def test_what_is_not_a_part_is_asked_for():
    """One line that tells how to give it."""
    with pytest.raises(InputError, match=r"give --role driver\|assistant"):
        guess_role("their_parts:WithoutAct", {}, Setting())
