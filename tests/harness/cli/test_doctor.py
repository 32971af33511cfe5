"""What the command prints about this machine."""

import json

from harness.doctor.finding import PURPOSES, Finding


def test_the_command_prints_what_works_and_fails_where_run_cannot(lad_study, monkeypatch):
    """Text for people, one object for programs, exit code 1 without a world."""
    nothing = Finding("browser", "none"), Finding("WebGL", "not known")
    monkeypatch.setattr("harness.doctor.examination.browser_findings", lambda: nothing)
    said = lad_study("doctor")
    assert said.code == 0
    assert "run               works" in said.out
    stopped = Finding("PyBullet's world", "gone", ("run", "live"), "pip install pybullet")
    monkeypatch.setattr("harness.doctor.examination.world_finding", lambda: stopped)
    said = lad_study("doctor", "--json")
    assert said.code == 1
    told = json.loads(said.out)
    assert set(told["can"]) == set(PURPOSES)
    assert told["can"]["run"] is False
    assert told["can"]["export"] is not None
    mended = [finding["mend"] for finding in told["findings"] if "run" in finding["stops"]]
    assert mended == ["pip install pybullet"]
