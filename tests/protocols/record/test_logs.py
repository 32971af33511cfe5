"""Logs of a study directory."""

from pathlib import Path

from protocols.record.logs import (
    clear_failure,
    failures,
    write_failure,
    write_log,
    write_timing,
)


def test_failures_are_kept_until_cleared(tmp_path: Path):
    """A session that raised is on the list, with its traceback, until it succeeds."""
    assert failures(tmp_path) == ()
    write_failure(tmp_path, "P0002", "Traceback ...")
    write_failure(tmp_path, "P0001", "Traceback ...")
    assert failures(tmp_path) == ("P0001", "P0002")
    assert (tmp_path / "logs" / "failed-P0001.txt").read_text() == "Traceback ..."
    clear_failure(tmp_path, "P0001")
    clear_failure(tmp_path, "P0001")
    assert failures(tmp_path) == ("P0002",)


def test_timings_are_a_table(tmp_path: Path):
    """One header, one line per session."""
    write_timing(tmp_path, "P0001", 1.23456)
    write_timing(tmp_path, "P0002", 2)
    assert (tmp_path / "logs" / "timing.csv").read_text() == (
        "participant,wall_s\nP0001,1.235\nP0002,2.000\n"
    )


def test_a_log_is_text(tmp_path: Path):
    """Any text under any name."""
    write_log(tmp_path, "warnings.txt", "é\n")
    assert (tmp_path / "logs" / "warnings.txt").read_text(encoding="utf-8") == "é\n"
