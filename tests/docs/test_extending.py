"""The page on bringing one's own parts is true: its examples run, as they stand there."""

import re
import sys
from pathlib import Path

import pyarrow.compute as pc
import pytest

from harness.cli import main
from protocols.record.reader import open_study

PAGE = Path(__file__).parents[2] / "docs" / "extending.md"
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.fixture
def workplace(tmp_path, monkeypatch):
    """Return a folder with every file the page shows, and be in it."""
    for _, text in BLOCK.findall(PAGE.read_text()):
        if name := re.match(r"# (\S+)\n", text):
            (tmp_path / name[1]).write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path


def commands():
    """Return the page's command lines, each as its arguments."""
    blocks = [text for language, text in BLOCK.findall(PAGE.read_text()) if language == "sh"]
    return [line.split()[1:] for text in blocks for line in text.splitlines()]


def without_numbers(line):
    """Return a line of output as any machine prints it."""
    return re.sub(r"\d[\d.]*", "#", line)


def test_the_pages_own_parts_run_as_a_study(workplace, monkeypatch, capsys):
    """Somebody else's driver and assistant pass their checks, run in our study, and help."""
    printed = []
    for arguments in commands():
        monkeypatch.setattr(sys, "argv", ["lad-study", *arguments])
        with pytest.raises(SystemExit) as end:
            main()
        said = capsys.readouterr()
        assert end.value.code == 0, said.err or said.out
        printed += map(without_numbers, said.out.splitlines())
    (shown,) = (text for language, text in BLOCK.findall(PAGE.read_text()) if language == "text")
    assert [line for line in map(without_numbers, shown.splitlines()) if line not in printed] == []
    study = open_study(workplace / "gentle")
    laps = study.laps.to_pandas().set_index("condition")
    assert laps.completed.all()
    assert laps.assisted_fraction["helped"] > 0.05
    assert laps.lap_time_s["helped"] < laps.lap_time_s["limited"]
    intents = study.steps("P0001", 0, ["intent_v"])["intent_v"]
    assert pc.max(intents).as_py() <= 0.8 * 0.7 + 1e-9
    assert (workplace / "gentle" / "report" / "index.html").stat().st_size > 10_000
