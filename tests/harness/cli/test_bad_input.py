"""A person's mistake: one line that says where, what and what is allowed; exit code 2."""

import pytest

from protocols.load import resolve_study
from protocols.record.store import open_folder

SHORT = """\
schema: 1
name: short
title: A short study
conditions:
  baseline: {}
laps:
  - condition: baseline
"""


def files_below(folder):
    """Every file below a folder with its content."""
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["run", "for-lap"], ["for-lap", "four-lap"]),
        (["run", "--course", "moon"], ["moon", "lab-office"]),
        (["run", "--participants", "0"], ["participants", "0", "1"]),
        (["run", "--participants", "many"], ["lad-study run", "--participants", "integer"]),
        (["run", "--seed", "-1"], ["seed", "-1", "0"]),
        (["run", "--jobs", "0"], ["jobs", "0", "1"]),
        (["run", "--sed", "1"], ["--sed", "--seed"]),
        (["rum"], ["rum", "run"]),
        (["validate", "missing.yaml"], ["missing.yaml"]),
        (["show", "five-lap"], ["five-lap", "four-lap"]),
        (["report", "nowhere"], ["nowhere"]),
        (["replay", "nowhere", "--participant", "P0001", "--lap", "1"], ["nowhere"]),
        (["replay", "nowhere", "--lap", "1"], ["--participant"]),
        (["power", "four-lap", "--n", "6:101"], ["101", "quarter", "400", "100"]),
        (["power", "four-lap", "--n", "many"], ["--n", "many", "6:40"]),
        (["power", "four-lap", "--n", "9:6"], ["--n", "9:6", "2 or more"]),
        (["power", "four-lap", "--target", "2"], ["--target", "2", "0.99"]),
        (["power", "four-lap", "--from", "nowhere"], ["nowhere"]),
        (["power", "rd-accuracy"], ["rd-accuracy", "analysis"]),
        (["preregister", "four-lap", "--out", "r", "--amend", "more"], ["no registration"]),
        (["run", "--registration", "nowhere"], ["nowhere", "no registration"]),
    ],
)
def test_one_line_and_exit_code_2(lad_study, tmp_path, arguments, parts):
    """Whatever is wrong with a call is said in one line that names it, and nothing is written."""
    said = lad_study(*arguments)
    assert said.code == 2
    assert said.out == ""
    assert said.err.count("\n") == 1
    for part in parts:
        assert part in said.err
    assert files_below(tmp_path) == {}


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ("baseline: {}", "baseline: {assistent: none}", [":5:", "assistent", "assistant"]),
        ("- condition: baseline", "- condition: basline", [":7:", "basline", "baseline"]),
        ("title: A short study", "title: [", ["mine.yaml:", "YAML"]),
        (
            "title: A short study",
            "title: A short study\ncontrol_period_s: 7",
            [":4:", "control_period_s", "0.5"],
        ),
        ("schema: 1", "schema: 2", [":1:", "schema"]),
    ],
)
def test_a_fault_in_a_file_is_located(lad_study, tmp_path, old, new, parts):
    """A fault in a protocol file is said with file, line, field and what is allowed."""
    (tmp_path / "mine.yaml").write_text(SHORT.replace(old, new))
    for command in ("validate", "run"):
        said = lad_study(command, "mine.yaml")
        assert said.code == 2
        assert said.err.count("\n") == 1
        for part in parts:
            assert part in said.err
    assert list(files_below(tmp_path)) == [(tmp_path / "mine.yaml").relative_to(tmp_path)]


def test_a_folder_with_another_study_is_left_alone(lad_study, tmp_path):
    """Running into another study's folder is refused with the difference; nothing changes."""
    (tmp_path / "mine.yaml").write_text(SHORT)
    open_folder(tmp_path / "out", resolve_study("mine.yaml"), 0)
    before = files_below(tmp_path)
    said = lad_study("run", "mine.yaml", "--seed", 1, "--out", "out")
    assert said.code == 2
    assert said.err.count("\n") == 1
    assert "seed: 0 there, 1 wanted" in said.err
    assert files_below(tmp_path) == before


def test_a_folder_with_something_else_is_left_alone(lad_study, tmp_path):
    """Running into a folder that holds anything else is refused; nothing changes."""
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter1.tex").write_text("precious")
    said = lad_study("run", "--out", "thesis")
    assert said.code == 2
    assert "chapter1.tex" in said.err
    assert list(files_below(tmp_path).values()) == [b"precious"]


def test_a_study_without_a_session_is_not_reported(lad_study, tmp_path):
    """A study directory without any session gets no report."""
    (tmp_path / "mine.yaml").write_text(SHORT)
    open_folder(tmp_path / "out", resolve_study("mine.yaml"), 0)
    said = lad_study("report", "out")
    assert said.code == 2
    assert said.err.count("\n") == 1
    assert not (tmp_path / "out" / "report").exists()


def test_a_driver_that_cannot_be_made_stops_before_anything_is_written(lad_study, tmp_path):
    """A dotted path that leads nowhere is said at once, and no study directory appears."""
    (tmp_path / "mine.yaml").write_text(f"{SHORT}cohort:\n  driver: {{use: 'nowhere.at:all'}}\n")
    said = lad_study("run", "mine.yaml", "--out", "out")
    assert said.code == 2
    assert said.err.count("\n") == 1
    assert "nowhere.at:all" in said.err
    assert not (tmp_path / "out").exists()
