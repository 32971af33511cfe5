"""`lad-study check`: what is wrong, a line each, and an exit code a script can use."""

from protocols.load import resolve_study
from protocols.record.store import build_tables, open_folder, write_failure


def test_what_is_wrong_is_said_a_line_each(lad_study, tmp_path):
    """Exit code 1, and what to run."""
    open_folder(tmp_path / "s", resolve_study("four-lap"), 0)
    write_failure(tmp_path / "s", "P0003", "Traceback")
    build_tables(tmp_path / "s")
    said = lad_study("check", "s")
    assert said.code == 1
    missing, failed = said.out.splitlines()
    command = "lad-study run four-lap --participants 12 --seed 0 --out s"
    assert missing == f"11 of 12 sessions are missing (P0001 first); `{command}` adds them"
    assert failed.endswith("--retry-failed runs them again")


def test_what_is_no_study_is_an_input_fault(lad_study):
    """Exit code 2 and one line."""
    said = lad_study("check", "nowhere")
    assert (said.code, said.err) == (2, "nowhere: no such folder\n")
