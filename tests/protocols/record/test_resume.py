"""The command that resumes the run of a study directory."""

from pathlib import Path

from protocols.load import resolve_study
from protocols.record.header import header_of
from protocols.record.resume import resume_command
from protocols.resolved import ResolvedStudy


def test_another_course_is_named():
    """Where the protocol's own would be another study."""
    header = header_of(resolve_study("rd-laps", course="ward-corridor", participants=2), 3)
    assert resume_command(Path("a b"), header) == (
        "lad-study run rd-laps --course ward-corridor --participants 2 --seed 3 --out 'a b'"
    )


def test_what_does_not_ship_is_called_protocol(plan: ResolvedStudy):
    """A user's own protocol, and a changed one under a shipped name."""
    for change in ({"name": "mine"}, {"control_period_s": 0.2}):
        protocol = plan.protocol.model_copy(update=change)
        header = header_of(ResolvedStudy(protocol, plan.course, plan.instruments), 0)
        assert resume_command(Path("s"), header).startswith(
            "lad-study run PROTOCOL --participants 3"
        )


def test_somebodys_own_course_is_not_guessed(plan: ResolvedStudy):
    """A course that does not ship."""
    course = plan.course.model_copy(update={"name": "hall"})
    protocol = plan.protocol.model_copy(update={"course": "hall"})
    header = header_of(ResolvedStudy(protocol, course, plan.instruments), 0)
    assert resume_command(Path("s"), header).startswith("lad-study run PROTOCOL ")
