"""A protocol's own code runs only after a person has allowed it, and only as it was then."""

import pytest

PROTOCOL = """\
schema: 1
name: own
title: A driver of one's own
conditions: {baseline: {}}
cohort:
  participants: 1
  driver: {use: "PART"}
laps: [{condition: baseline, time_limit_s: 0.3}]
"""

RAN = 1
"""The exit code of a run: its lap is too short to be finished, and the run says so."""

DRIVER = """\
from pathlib import Path
from lad.command import Command

Path(__file__).with_name("proof").touch()

class Slow:
    def start_lap(self, lap, rng): pass
    def act(self, sight): return Command(0.1, 0.0)

def slow(setup): return Slow()
"""


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Return the function that writes a protocol with a part, in a state directory of its own."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "slow.py").write_text(DRIVER)

    def write(part):
        (tmp_path / "mine" / "own.yaml").write_text(PROTOCOL.replace("PART", part))
        return tmp_path / "mine" / "proof"

    return write


@pytest.mark.parametrize(
    "part",
    ["subprocess:run", "os:path", "os.path:join", "lad.command:Command", "builtins:exec", "slow:"],
)
@pytest.mark.parametrize("command", ["validate", "run"])
def test_nothing_but_parts_can_be_named(lad_study, study, command, part):
    """Neither the standard library nor other functions of ours: one line with file and line."""
    study(part)
    said = lad_study(command, "mine/own.yaml")
    assert said.code == 2
    assert said.err.startswith("mine/own.yaml:7: cohort.driver.use: ")
    assert said.err.count("\n") == 1
    assert part in said.err
    assert "allowed: " in said.err


def test_a_model_cannot_be_a_shell(lad_study, study, tmp_path):
    """The file alone runs no command."""
    study("human")
    file = tmp_path / "mine" / "own.yaml"
    options = f"{{args: 'touch {tmp_path / 'shell'}', shell: true}}"
    file.write_text(f"{file.read_text()}model: {{use: 'subprocess:run', options: {options}}}\n")
    for command in ("validate", "run"):
        said = lad_study(command, "mine/own.yaml")
        assert said.code == 2
        assert "own.yaml:9: model.use: no model is called 'subprocess:run'" in said.err
    assert not (tmp_path / "shell").exists()


def test_validate_runs_nobodys_code(lad_study, study):
    """It says what it did not try."""
    proof = study("slow:slow")
    said = lad_study("validate", "mine/own.yaml")
    assert said.code == 0
    assert "own.yaml:7: cohort.driver.use: 'slow:slow' was not tried" in said.out
    assert not proof.exists()


def test_run_says_which_code_and_runs_it_once_it_is_trusted(lad_study, study, tmp_path):
    """Refused with the file's name; then allowed by name and content, until that changes."""
    proof, file = study("slow:slow"), tmp_path / "mine" / "slow.py"
    run = ("run", "mine/own.yaml", "--no-report", "--jobs", 1, "--out")
    refused = lad_study(*run, "a")
    assert refused.code == 2
    assert refused.err.count("\n") == 1
    assert "own.yaml:7: cohort.driver.use: 'slow:slow' would run the code in " in refused.err
    assert str(file) in refused.err
    assert "--trust" in refused.err
    assert not proof.exists()
    assert not (tmp_path / "a").exists()

    allowed = lad_study(*run, "a", "--trust")
    assert allowed.code == RAN, allowed.err
    assert allowed.err.splitlines()[0] == f"Runs code that is not this program's: {file}"
    assert "Nobody finished a lap of baseline (1 begun)" in allowed.err
    assert proof.exists()
    assert lad_study(*run, "b").code == RAN

    proof.unlink()
    file.write_text(DRIVER.replace("0.1", "0.2"))
    changed = lad_study(*run, "c")
    assert changed.code == 2
    assert "--trust" in changed.err
    for command in ("report", "check", "replay"):
        more = ("--participant", "P0001", "--lap", 0) if command == "replay" else ()
        assert lad_study(command, "a", *more).code == 0
    assert not proof.exists()


def test_the_same_content_elsewhere_is_not_trusted(lad_study, study, tmp_path):
    """Trust is given to a file."""
    study("slow:slow")
    assert lad_study("run", "mine/own.yaml", "--no-report", "--out", "a", "--trust").code == RAN
    (tmp_path / "mine").rename(tmp_path / "yours")
    assert lad_study("run", "yours/own.yaml", "--no-report", "--out", "b").code == 2


@pytest.mark.parametrize("record", ["", "[1]", "{", '{"a": 1}', "\x00"])
def test_a_damaged_trust_record_trusts_nothing(lad_study, study, tmp_path, record):
    """It is no traceback either."""
    study("slow:slow")
    (tmp_path / "state" / "lad-study").mkdir(parents=True)
    (tmp_path / "state" / "lad-study" / "trusted.json").write_text(record)
    said = lad_study("run", "mine/own.yaml", "--no-report", "--out", "a")
    assert said.code == 2
    assert said.err.count("\n") == 1


def test_an_installed_package_declares_parts(lad_study, study, tmp_path, monkeypatch):
    """By an entry point: named plainly, run without more, and said."""
    site = tmp_path / "site"
    info = site / "my_lab-1.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: my-lab\nVersion: 1\n")
    (info / "entry_points.txt").write_text("[lad_study.parts]\nslowly = my_lab_drivers:slow\n")
    (site / "my_lab_drivers.py").write_text(DRIVER)
    monkeypatch.syspath_prepend(site)
    monkeypatch.setenv("PYTHONPATH", str(site), prepend=":")
    study("slowly")
    said = lad_study("validate", "mine/own.yaml")
    assert said.code == 0
    assert "'slowly' of my-lab was not tried" in said.out
    assert not (site / "proof").exists()
    assert lad_study("validate", "mine/own.yaml").code == 0
