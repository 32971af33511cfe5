"""A first protocol from five answers."""

import itertools
from typing import get_args

import pytest

from harness.cli import init
from protocols.draft import Answers, Help, People, draft
from protocols.load import check_file, resolve_study

GIVEN = {
    "name": "ward pilot",
    "people": "synthetic",
    "participants": "8",
    "assistance": "borrowed-model",
    "questionnaire": "driving-assistance",
}


def options(**changes):
    """Return the options that answer everything, some of them differently; None leaves one out."""
    given = {name: value for name, value in (GIVEN | changes).items() if value is not None}
    return [text for name, value in given.items() for text in (f"--{name}", value)]


@pytest.mark.parametrize(
    ("people", "help_"), list(itertools.product(get_args(People), get_args(Help)))
)
def test_every_answer_makes_a_valid_protocol(tmp_path, people, help_):
    """With each questionnaire and without; also where YAML would take the name for something."""
    for name, asked in (("no", "none"), ("1", "driving-assistance"), ("2.5", "nasa-tlx")):
        path = tmp_path / f"{asked}.yaml"
        path.write_text(draft(Answers(name, people, 12, help_, asked), path.name))
        protocol = check_file(str(path)).protocol
        assert protocol.name == name
        assert protocol.cohort.driver.use == ("live" if people == "living" else "human")


def test_answers_come_from_options_and_the_file_has_comments(lad_study, tmp_path):
    """Nothing is asked then; the study is the one that was described."""
    said = lad_study("init", *options())
    assert said.code == 0, said.err
    study = resolve_study(str(tmp_path / "ward-pilot.yaml"))
    assert study.protocol.cohort.participants == 8
    assert study.protocol.orders.use == "williams"
    assert study.protocol.conditions["model-assisted"].model == "borrowed"
    items = [lap.survey[0].items for lap in study.protocol.laps[1:]]
    assert items[0] == ("Q1", "Q2", "Q3", "Q4")
    assert len(items[-1]) == 11 or items[-1] == "all"
    assert (tmp_path / "ward-pilot.yaml").read_text().count("# ") > 10


def test_a_file_that_is_there_stays(lad_study, tmp_path):
    """Exit code 2, and not a byte of it changes."""
    (tmp_path / "ward-pilot.yaml").write_text("mine")
    said = lad_study("init", *options())
    assert said.code == 2
    assert said.err.startswith("ward-pilot.yaml: is there already")
    assert (tmp_path / "ward-pilot.yaml").read_text() == "mine"


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"people": "robots"}, "--people: 'robots' is not known; allowed: synthetic, living"),
        ({"participants": "0"}, "--participants: '0' is not allowed"),
        ({"participants": "\u0663"}, "--participants: '\u0663' is not allowed"),
        ({"name": "../x"}, "--name: '../x' is no name"),
        ({"questionnaire": "mine"}, "allowed: none, driving-assistance, nasa-tlx, sus"),
        ({"assistance": None}, "--assistance: is missing, and there is no terminal to ask at"),
        (
            {"people": "living"},
            "--assistance: 'borrowed-model' is not known; allowed: own-model, d",
        ),
        ({"out": "nowhere/a.yaml"}, "nowhere/a.yaml: cannot be written"),
    ],
)
def test_an_answer_that_is_not_allowed_is_one_line(lad_study, tmp_path, changes, said):
    """Nothing is written; the option and what is allowed are named."""
    found = lad_study("init", *options(**changes))
    assert found.code == 2
    assert said in found.err
    assert list(tmp_path.iterdir()) == []


def test_at_a_terminal_a_wrong_answer_is_asked_for_again(lad_study, monkeypatch, tmp_path):
    """Until it is allowed; what an option says is not asked."""
    entered = iter(["everybody", "living"])
    monkeypatch.setattr("sys.stdin.isatty", lambda: True, raising=False)
    monkeypatch.setattr(init.typer, "prompt", lambda *_, **__: next(entered))
    said = lad_study("init", *options(people=None, assistance="own-model"))
    assert said.code == 0, said.err
    assert "'everybody' is not known" in said.out
    assert resolve_study(str(tmp_path / "ward-pilot.yaml")).protocol.cohort.driver.use == "live"
