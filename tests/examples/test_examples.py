"""The examples run as they stand, and read the exports as they are."""

import io
import json
import re
import runpy
import shutil
import subprocess
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path

import matplotlib.pyplot as plt
import pytest

from analysis.export.write import export_study
from harness.cli import main
from harness.running.runner import run_study
from harness.session.study_run import StudyRun
from protocols.load import resolve_study
from protocols.record.reader import open_study

EXAMPLES = Path(__file__).parents[2] / "examples"
R = shutil.which("Rscript")

GALLERY = sorted(EXAMPLES.glob("example_*.py"))

PROTOCOL = """\
schema: 1
name: example
title: An example
cohort: {participants: 2}
conditions:
  baseline: {}
  limited: {limitation: {right_turn_rad_s: 0.15}}
laps: [{condition: baseline}, {condition: limited}]
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """Return a study of two people who drove two laps."""
    folder = tmp_path_factory.mktemp("example")
    (folder / "protocol.yaml").write_text(PROTOCOL)
    run = StudyRun(resolve_study(str(folder / "protocol.yaml")), 1)
    run_study(run, folder / "study", 1, lambda *_: None)
    return open_study(folder / "study")


def mean(study, condition):
    """Return the mean lap time of a condition."""
    times = [r["lap_time_s"] for r in study.laps.to_pylist() if r["condition"] == condition]
    return sum(times) / len(times)


@pytest.mark.skipif(R is None, reason="R is not installed")
def test_the_r_script_says_what_the_limitation_costs(study, tmp_path):
    """The difference is the record's."""
    export_study(study.folder, "r", tmp_path / "r")
    ended = subprocess.run(  # noqa: S603  # R itself
        [str(R), str(EXAMPLES / "lap_times.R"), str(tmp_path / "r")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert ended.returncode == 0, ended.stderr
    found = re.search(r"limited - baseline: (\S+) s \(n = (\d+)\)", ended.stdout)
    wanted = mean(study, "limited") - mean(study, "baseline")
    assert float(found[1]) == pytest.approx(wanted, abs=5e-4)
    assert found[2] == "2"


def test_the_notebook_runs_from_top_to_bottom(study, tmp_path, monkeypatch):
    """Every cell, in order; its lap times are the record's."""
    export_study(study.folder, "frictionless", tmp_path / "out")
    monkeypatch.setenv("EXPORT", str(tmp_path / "out"))
    notebook = json.loads((EXAMPLES / "pandas.ipynb").read_text())
    space: dict[str, object] = {}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), space)  # noqa: S102  # our own example
    for condition in ("baseline", "limited"):
        found = space["lap_times"].loc[condition, "mean"]
        assert found == pytest.approx(mean(study, condition))
    assert space["takeovers"].between(0, 1).all()


def test_the_layouts_topics_are_exported():
    """Every topic and field that the Foxglove layout shows is one that the export writes."""
    mcap = pytest.importorskip("analysis.export.formats.mcap")
    text = (EXAMPLES / "foxglove-layout.json").read_text()
    layout = json.loads(text)
    shown = set(re.findall(r'"(/[a-z_]+)[".]', text))
    exported = {topic.name for topic in mcap.TOPICS} | {"/lap", "/tf_static"}
    assert shown <= exported
    panels = set(re.findall(r'"(\w+!\w+)"', json.dumps(layout["layout"])))
    assert panels == set(layout["configById"])


def in_this_process(command, *, cwd=None, check, **_):
    """Run a command of ours as its own process would, without importing everything once more."""
    said, complained = io.StringIO(), io.StringIO()
    kept, sys.argv = sys.argv, [Path(command[0]).name, *command[1:]]
    try:
        with chdir(cwd or Path.cwd()), redirect_stdout(said), redirect_stderr(complained):
            main()
    except SystemExit as end:
        code = end.code
    finally:
        sys.argv = kept
    if check and code:
        raise subprocess.CalledProcessError(code, command, said.getvalue(), complained.getvalue())
    return subprocess.CompletedProcess(command, code, said.getvalue(), complained.getvalue())


@pytest.mark.filterwarnings("default")  # as where a person runs it
@pytest.mark.parametrize("script", GALLERY, ids=lambda path: path.stem)
def test_an_example_of_the_gallery_runs_as_it_stands(script, tmp_path, monkeypatch, capsys):
    """From top to bottom, with few people; it shows what its commands print."""
    monkeypatch.setenv("LAD_STUDY_QUICK", "1")
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))  # what is trusted is forgotten
    monkeypatch.setattr(subprocess, "run", in_this_process)
    monkeypatch.chdir(tmp_path)
    with plt.rc_context({"backend": "agg"}):
        names = runpy.run_path(str(script))
    plt.close("all")
    if "work" in names:  # the folder that lasts as long as the script
        names["work"].cleanup()
    assert capsys.readouterr().out
