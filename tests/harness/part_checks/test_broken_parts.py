"""A part with one fault fails one check, the right one, and its line has what was found."""

import pytest

from harness.part_checks import CHECKS, Setting

RIGHT = [
    ("driver", "Ahead"),
    ("assistant", "Remembering"),
    ("demonstrator", "Helping"),
    ("impairment", "Half"),
    ("respondent", "Agreeing"),
    ("world", "OpenFloor"),
]

WRONG = [
    ("driver", "WithoutAct", "interface", "has no method act"),
    ("driver", "WantsMore", "interface", "cannot be called as act(sight)"),
    ("driver", "Robot", "interface", "'robot'"),
    ("driver", "Raising", "laps", "in step 1 of lap 1 it raises IndexError"),
    ("driver", "Hurried", "commands", "v=3, w=0, in step 1 of lap 1"),
    ("driver", "Bare", "commands", "a tuple"),
    ("driver", "Lost", "commands", "v=nan"),
    ("driver", "NotReset", "reset between laps", "0.0 m in lap 2"),
    ("driver", "RaisingLater", "reset between laps", "RuntimeError: not again (their_parts.py:"),
    ("driver", "Unseeded", "same seed, same answers", "first in step 1 of lap 1"),
    ("driver", "Shared", "same seed, same answers", "first in step 1 of lap 1"),
    ("driver", "Digging", "sees no more than it is shown", "in a lap it answers differently"),
    ("driver", "DiggingOnly", "sees no more than it is shown", "it raises AttributeError"),
    ("driver", "Scribbling", "leaves what it is given as it is", "sight of step 1 of lap 1"),
    ("driver", "Taking", "leaves what it is given as it is", "its options"),
    ("driver", "OfItsProcess", "another process", "first in step 1 of lap 1"),
    ("assistant", "Looking", "sees no more than it is shown", "a method look"),
    ("assistant", "DiggingAssistant", "sees no more than it is shown", "in a lap it answers"),
    ("assistant", "Carrying", "reset between laps", "first in step 1 of lap 1"),
    ("assistant", "Commandless", "commands", "it helps without a command"),
    ("assistant", "NumpyTruth", "commands", "helping is a numpy.bool"),
    ("assistant", "Overwriting", "leaves what it is given as it is", "x of step 1 of lap 1"),
    ("assistant", "Dated", "saving and loading", "other bytes"),
    ("assistant", "BadlyLoaded", "saving and loading", "loaded by from_bytes"),
    ("demonstrator", "Clinging", "reset between laps", "from step 1 after a lap broken off"),
    ("impairment", "AsksTwice", "leaves the driver its part", "60 times in 30 steps"),
    ("impairment", "Drawing", "leaves the driver its part", "draws were taken"),
    ("impairment", "Kindless", "leaves the driver its part", "its kind is synthetic"),
    ("impairment", "NobodyLeaves", "leaves the driver its part", "WithdrewError"),
    ("impairment", "NeedsCommands", "a driver with nothing new", "it raises AttributeError"),
    ("impairment", "AlwaysThere", "severity 0", "in step 1, Command("),
    ("respondent", "Brief", "answers", "10 answers to 11 questions"),
    ("respondent", "Between", "answers", "3.5 (float) to Q1"),
    ("respondent", "Moody", "same seed, same answers", "differ, first in"),
    ("respondent", "Confused", "questionnaires", "about lap 1, it raises ZeroDivisionError"),
    ("world", "Mirrored", "follows commands", "-0."),
    ("world", "Elsewhere", "start", "off the start by"),
    ("world", "NoisyLook", "observing", "asked again"),
    ("world", "Reused", "observing", "changes in that step"),
    ("world", "Pushing", "safeguard", "it leaves Command("),
    ("world", "Drifting", "reset between laps", "after other laps it differs"),
    ("world", "Endless", "observations", "segments are between inf and inf"),
]


@pytest.mark.usefixtures("their_parts")
@pytest.mark.parametrize(("role", "name"), RIGHT)
def test_what_is_right_passes(role, name, brief):
    """The same parts, with nothing wrong, pass every check: so the failures below are earned."""
    report = CHECKS[role](f"their_parts:{name}", None, brief)
    assert report.passed, report
    assert {result.state for result in report.results} == {"passed"}, report


@pytest.mark.usefixtures("their_parts")
@pytest.mark.parametrize(("role", "name", "check", "found"), WRONG)
def test_one_thing_wrong_fails_one_check(role, name, check, found, brief):
    """The check that fails is the one about what is wrong; its line has what was found."""
    options = {"share": 0.5} if name == "Taking" else None
    report = CHECKS[role](f"their_parts:{name}", options, brief)
    assert report.failed == (check,), report
    (line,) = [str(result) for result in report.results if result.check == check]
    assert line.startswith(f"failed       {check}: ")
    assert found in line
    assert "; allowed: " in line
    assert "\n" not in line


@pytest.mark.usefixtures("their_parts")
def test_a_slow_part_is_told_how_long_it_may_take():
    """More than half the control period per step is too slow."""
    report = CHECKS["driver"]("their_parts:Slow", None, Setting(lap_s=1.2))
    assert report.failed == ("time per step",), report
    assert "up to 50 ms in 95% of the steps" in str(report)
