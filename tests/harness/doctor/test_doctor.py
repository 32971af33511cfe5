"""What is looked at, and what it stops."""

import socket

import pytest

from harness.doctor import machine, packages, world
from harness.doctor.finding import Finding
from harness.doctor.machine import machine_findings
from harness.doctor.packages import package_findings
from harness.running import processes

ASKED = (
    "numpy>=2.0",
    "no-such-package-here>=3; extra == 'live'",
    "pandas>=9999; extra == 'cluster'",
    "pyarrow>=1; extra == 'exchange'",
)


@pytest.fixture
def found(monkeypatch):
    """Return the findings about packages of a distribution that asks for odd ones."""
    monkeypatch.setattr(packages, "requires", lambda _: ASKED)
    return {finding.what: finding for finding in package_findings()}


def test_a_missing_package_stops_what_needs_it_and_says_the_line(found):
    """Only that: the other purposes go on."""
    assert found["no-such-package-here"] == Finding(
        "no-such-package-here",
        "missing; needs no-such-package-here>=3",
        ("live",),
        "pip install 'lad-study[live]'",
    )
    assert found["numpy"].stops == found["pyarrow"].stops == ()


def test_a_package_that_is_too_old_is_not_there(found):
    """The version that is there, and the one that is asked for."""
    assert found["pandas"].stops == ("cluster",)
    assert found["pandas"].found.endswith("; needs pandas>=9999")


def test_an_extra_that_the_installed_package_does_not_know_is_not_called_working(found):
    """Metadata of an older version lists nothing for it: nothing listed is nothing known."""
    assert found["extra video"].stops == ("video",)


def of(what, tmp_path):
    """Return what is found about one thing of the machine."""
    return next(finding for finding in machine_findings(1, tmp_path) if finding.what == what)


def test_a_full_disk_stops_a_study(monkeypatch, tmp_path):
    """A line says how much room a study needs."""
    monkeypatch.setattr(machine, "LEAST_FREE", 1 << 62)
    assert of("disk", tmp_path).stops == ("run", "live")


def test_a_folder_that_cannot_be_written_stops_a_study(tmp_path):
    """Also one that is not there; and nothing is left in one that is."""
    assert of("working folder", tmp_path).stops == ()
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "file").write_text("")
    finding = machine._writable("working folder", tmp_path / "file")
    assert finding.stops == ("run", "live")


def test_a_temporary_folder_with_a_long_path_is_told(monkeypatch, tmp_path):
    """Another short one is used; without one, nothing runs."""
    long = tmp_path / ("x" * 90)
    long.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(long))
    assert "instead" in of("temporary path", tmp_path).found
    monkeypatch.setattr(processes.os, "access", lambda *_: False)
    assert of("temporary path", tmp_path).stops == ("run",)


def test_a_taken_port_is_no_obstacle_and_says_which_other(monkeypatch, tmp_path):
    """Live takes a free one when it is asked to."""
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        monkeypatch.setattr(machine, "LIVE_PORT", taken.getsockname()[1])
        finding = of("port", tmp_path)
    assert finding.stops == ()
    assert "--port 0" in finding.mend


def test_the_world_is_tried_not_only_imported():
    """The chair drives."""
    finding = world.world_finding()
    assert finding.stops == ()
    assert finding.found.startswith("the chair drives")
