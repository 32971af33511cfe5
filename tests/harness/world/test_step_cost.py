"""A course's control step compared with another's."""

from harness.world import step_cost
from harness.world.step_cost import step_cost_ratio
from protocols.load import load_course


def test_what_slows_the_machine_slows_both(monkeypatch):
    """While everything takes longer and longer, a course takes as long as itself."""
    course = load_course("lab-office")
    seconds = (1.01**n for n in range(1000))
    monkeypatch.setattr(step_cost, "_round_s", lambda _: next(seconds))
    assert abs(step_cost_ratio(course, course) - 1) < 0.02
