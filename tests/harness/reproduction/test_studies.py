"""The experiments of a reproduction: run by the shipped runner, resumed, and never mixed up."""

from contextlib import contextmanager
from pathlib import Path

import pytest

from harness.reproduction import studies
from harness.reproduction.studies import EXPERIMENTS, experiments, run_experiments
from harness.running.runner import Outcome
from protocols.files.errors import InputError
from protocols.record.store import write_failure

BRIEF = """\
schema: 1
name: {name}
title: Two seconds of driving
cohort: {{participants: 2, driver: {{use: autonomous}}}}
conditions:
  baseline: {{}}
laps:
  - {{condition: baseline, time_limit_s: 2}}
"""


def brief(folder, name):
    """Write a protocol of one short lap, and return its path."""
    path = folder / f"{name}.yaml"
    path.write_text(BRIEF.format(name=name))
    return str(path)


def read(folder):
    """Return every recorded file with its content and when it was written."""
    return {
        p.relative_to(folder): (p.read_bytes(), p.stat().st_mtime_ns)
        for p in folder.rglob("*")
        if p.is_file() and "logs" not in p.parts
    }


class Shown:
    """Remembers which studies were shown, and how far they came."""

    def __init__(self):
        self.told = {}

    @contextmanager
    def __call__(self, name):
        yield lambda ended, planned: self.told.update({name: (ended, planned)})


@pytest.fixture(scope="module")
def protocols(tmp_path_factory):
    """Return two protocols."""
    folder = tmp_path_factory.mktemp("protocols")
    return [brief(folder, "one"), brief(folder, "two")]


def test_the_paper_has_three():
    """Laps, accuracy and people, each by its shipped protocol, all with the seed."""
    planned = experiments(Path("out"), 7)
    assert [e.folder for e in planned] == [Path("out/studies") / name for name in EXPERIMENTS]
    assert {e.run.seed for e in planned} == {7}


def test_a_second_run_finds_everything(tmp_path, protocols):
    """Each study is run and shown; run again, no session is written again."""
    shown, out = Shown(), tmp_path / "out"
    assert run_experiments(out, experiments(out, 0, protocols), 1, shown) == ()
    assert shown.told == {"one": (2, 2), "two": (2, 2)}
    sessions = {k: v for k, v in read(out).items() if "sessions" in k.parts}
    assert len([k for k in sessions if k.name == "steps-0.parquet"]) == 4
    assert run_experiments(out, experiments(out, 0, protocols), 1, Shown()) == ()
    assert {k: v for k, v in read(out).items() if "sessions" in k.parts} == sessions


@pytest.mark.parametrize("study", ["one", "two"])
def test_another_seeds_folder_is_refused_untouched(tmp_path, protocols, study):
    """Whichever of the studies is there, one of another seed stops everything."""
    out = tmp_path / "out"
    planned = [e for e in experiments(out, 0, protocols) if e.folder.name == study]
    run_experiments(out, planned, 1, Shown())
    before = read(out)
    with pytest.raises(InputError, match="seed"):
        run_experiments(out, experiments(out, 1, protocols), 1, Shown())
    assert read(out) == before


@pytest.mark.parametrize("stranger", ["thesis.tex", "studies/four-lap-seed0/study.yaml"])
def test_a_folder_with_something_else_is_refused_untouched(tmp_path, protocols, stranger):
    """A thesis, or the folder in which `lad-study run` keeps its studies."""
    path = tmp_path / stranger
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("precious")
    before = read(tmp_path)
    with pytest.raises(InputError, match="something else"):
        run_experiments(tmp_path, experiments(tmp_path, 0, protocols), 1, Shown())
    assert read(tmp_path) == before


def test_a_file_is_refused(tmp_path, protocols):
    """A file is no folder."""
    (tmp_path / "out").write_text("precious")
    with pytest.raises(InputError, match="is a file"):
        run_experiments(tmp_path / "out", experiments(tmp_path / "out", 0, protocols), 1, Shown())


def test_failed_sessions_are_said_and_resume_command(tmp_path, protocols, monkeypatch):
    """A line names study, participant and reason; sessions that failed before are tried again."""
    planned = experiments(tmp_path, 0, protocols[:1])

    def fail(run, folder, jobs, tell, *, retry_failed):
        assert retry_failed
        (folder / "logs").mkdir(parents=True)
        write_failure(folder, "P0002", "Traceback\nRuntimeError: fell over\n")
        return Outcome(2, 0, 1, ("P0002",))

    monkeypatch.setattr(studies, "run_study", fail)
    (line,) = run_experiments(tmp_path, planned, 1, Shown())
    assert "1 of 2 sessions failed (P0002: RuntimeError: fell over)" in line
    assert str(planned[0].folder) in line
