"""Logs of a study directory."""

from pathlib import Path

from protocols.record.logs import (
    clear_failure,
    failure_reason,
    failures,
    raised,
    write_failure,
    write_given_up,
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


def test_who_was_given_up_is_told_from_who_raised(tmp_path: Path):
    """A session that raised would raise again; one whose processes died may not."""
    write_failure(tmp_path, "P0001", "Traceback ...")
    write_given_up(tmp_path, "P0002", "its process was killed by SIGKILL")
    assert failures(tmp_path) == ("P0001", "P0002")
    assert raised(tmp_path) == ("P0001",)
    assert failure_reason(tmp_path, "P0002") == "its process was killed by SIGKILL"
    clear_failure(tmp_path, "P0002")
    assert failures(tmp_path) == ("P0001",)
    assert failure_reason(tmp_path, "P0002") == ""


def test_the_reason_is_the_first_line_of_the_message(tmp_path: Path):
    """However many lines an exception's message has."""
    trace = 'Traceback (most recent call last):\n  File "a.py", line 1, in b\n    c()\n'
    write_failure(tmp_path, "P0001", f"{trace}ValueError: no chair\nnor anything else\n")
    assert failure_reason(tmp_path, "P0001") == "ValueError: no chair"


def test_a_line_that_was_cut_short_does_not_swallow_the_next(tmp_path: Path):
    """A run killed while it wrote, or before it wrote anything."""
    path = tmp_path / "logs" / "timing.csv"
    path.parent.mkdir()
    path.write_text("participant,wall_s\nP0001,1.2")
    write_timing(tmp_path, "P0002", 2)
    assert path.read_text() == "participant,wall_s\nP0001,1.2\nP0002,2.000\n"
    path.write_text("")
    write_timing(tmp_path, "P0001", 1)
    assert path.read_text() == "participant,wall_s\nP0001,1.000\n"


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
