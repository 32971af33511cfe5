"""`lad-study reproduce`: bad input in one line, and a small reproduction from end to end."""

import json

import pytest

from analysis.reproduction import lessons
from harness.reproduction import studies
from protocols.load import resolve_study


def files_below(folder):
    """Every file below a folder with its content."""
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (["--seed", "-1"], ["--seed", "-1", "0 or more"]),
        (["--seed", "one"], ["lad-study reproduce", "--seed", "integer"]),
        (["--jobs", "0"], ["--jobs", "0", "1 or more"]),
        (["--course", "hall.yaml"], ["--course", "--full"]),
        (["--full", "--course", "hall.yaml"], ["hall.yaml"]),
        (["--ful"], ["--ful", "--full"]),
    ],
)
def test_one_line_and_exit_code_2(lad_study, tmp_path, arguments, parts):
    """Whatever is wrong with a call is said in one line, before anything is written."""
    said = lad_study("reproduce", *arguments)
    assert (said.code, said.out, said.err.count("\n")) == (2, "", 1)
    for part in parts:
        assert part in said.err
    assert files_below(tmp_path) == {}


def test_a_faulty_course_is_named_by_line(lad_study, tmp_path):
    """A course that cannot be used stops everything, with its file and line."""
    text = "schema: 1\nname: hall\ntitle: A hall\nwalls: 3\n"
    (tmp_path / "hall.yaml").write_text(text)
    said = lad_study("reproduce", "--full", "--course", "hall.yaml", "--out", "out")
    assert (said.code, said.err.count("\n")) == (2, 1)
    assert "hall.yaml:" in said.err
    assert not (tmp_path / "out").exists()


def test_a_folder_with_something_else_is_left_alone(lad_study, tmp_path):
    """One line names what is in the way."""
    (tmp_path / "thesis").mkdir()
    (tmp_path / "thesis" / "chapter1.tex").write_text("precious")
    said = lad_study("reproduce", "--out", "thesis")
    assert (said.code, said.err.count("\n")) == (2, 1)
    assert "chapter1.tex" in said.err
    assert list(files_below(tmp_path).values()) == [b"precious"]


@pytest.mark.slow
def test_a_small_reproduction_from_end_to_end(lad_study, tmp_path, monkeypatch):
    """Two replicates and two people: the page is written, and again with the same bytes."""
    monkeypatch.setattr(studies, "resolve_study", _small)
    monkeypatch.setattr(lessons, "PERMUTATIONS", 2)
    said = lad_study("reproduce", "--seed", "3", "--jobs", "2")
    assert said.code == 0, said.err
    folder = tmp_path / "reproductions" / "seed3"
    assert "rd lap limited" in said.out
    assert said.out.rstrip().endswith("reproductions/seed3/reproduction.html")
    rows = json.loads((folder / "reproduction.json").read_text())
    ours = {row["quantity"]: row["ours"] for row in rows}
    assert 30 < ours["rd lap baseline"] < ours["rd lap demonstrator"] < ours["rd lap limited"] < 70
    assert 0.9 < ours["auc test median"] <= 1
    before = files_below(folder)
    again = lad_study("reproduce", "--seed", "3", "--jobs", "1")
    assert again.code == 0
    after = files_below(folder)
    assert {k for k in before if before[k] != after[k] and "logs" not in k.parts} == set()


def _small(name):
    few = 1 if name == "rd-accuracy" else 2
    return resolve_study(name, participants=few)
