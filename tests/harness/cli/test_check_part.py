"""`lad-study check-part`: a line for each check, and an exit code a script can use."""

import pytest

PARTS = """
from participants.respondent import ordinal_respondent

class Yes:
    def __init__(self, setup): self.word = setup.options.get("word", 4)
    def answer(self, questions, experience, rng): return tuple(self.word for _ in questions)

def yes(setup): return Yes(setup)

class Nothing:
    def __init__(self, *_, **__): pass
"""


@pytest.fixture
def workplace(tmp_path, monkeypatch):
    """Put a module of one's own into the folder one works in."""
    import sys

    (tmp_path / "their_answers.py").write_text(PARTS)
    monkeypatch.setattr(sys, "path", [*sys.path])
    yield
    sys.modules.pop("their_answers", None)


@pytest.mark.usefixtures("workplace")
def test_a_part_that_passes(lad_study):
    """What it was checked as, a line for each check, how many passed; exit code 0."""
    said = lad_study("check-part", "their_answers:yes")
    first, *lines, last = said.out.splitlines()
    assert said.code == 0, said.out
    assert first == "their_answers:yes, checked as a respondent"
    assert last == "6 of 6 checks passed, none failed"
    assert len(lines) == 6
    assert all(line.startswith("passed ") and "; allowed: " in line for line in lines)


@pytest.mark.usefixtures("workplace")
def test_a_part_that_fails(lad_study):
    """The option reaches the part, the fault is on the line of its check; exit code 1."""
    said = lad_study("check-part", "their_answers:yes", "--option", "word=yes")
    assert said.code == 1
    (line,) = [line for line in said.out.splitlines() if line.startswith("failed")]
    assert "answers: 'yes' (str) to Q1, about lap 1; allowed: " in line
    assert said.out.splitlines()[-1] == "1 of 6 checks failed: answers"


@pytest.mark.usefixtures("workplace")
@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["nowhere:at"], ["nowhere", "allowed"]),
        (["humna"], ["humna", "did you mean 'human'"]),
        (["human", "--role", "drvier"], ["drvier", "did you mean 'driver'"]),
        (["human", "--role", "respondent"], ["respondent", "human", "allowed"]),
        (["their_answers:Nothing"], ["their_answers:Nothing", "--role driver|assistant|"]),
        (["human", "--option", "speed"], ["speed", "NAME=VALUE"]),
        (["human", "--option", "speed=1"], ["speed", "compliance_to_person"]),
        (["scripted"], ["give either file or commands"]),
        (["human", "--period", "7"], ["--period", "7", "0.02 to 0.5"]),
        (["human", "--seed", "-1"], ["--seed", "-1"]),
        (["human", "--course", "moon"], ["moon", "lab-office"]),
        (["ordinal", "--instrument", "moon"], ["moon", "driving-assistance"]),
    ],
)
def test_bad_input_is_one_line(lad_study, arguments, parts):
    """Exit code 2, and one line with what is allowed."""
    said = lad_study("check-part", *arguments)
    assert said.code == 2
    assert said.out == ""
    assert said.err.count("\n") == 1
    for part in parts:
        assert part in said.err
