"""A study directory is reported where there is no simulator."""

import shutil


def test_a_copied_study_is_reported_without_pybullet(run_quick, start, record, tmp_path):
    """The report needs nothing but the directory: neither the original nor PyBullet."""
    ended = run_quick(tmp_path / "study", "--participants", 4)
    assert ended.code == 0, ended.err
    shutil.move(tmp_path / "study", tmp_path / "copied")
    blocked = tmp_path / "blocked"
    blocked.mkdir()
    (blocked / "pybullet.py").write_text("raise ImportError('there is no simulator here')")
    before = record(tmp_path / "copied")
    importing = start("run", "--out", tmp_path / "no", PYTHONPATH=str(blocked)).ended()
    assert importing.code != 0, "the simulator is not blocked; this test shows nothing"
    ended = start("report", tmp_path / "copied", PYTHONPATH=str(blocked)).ended()
    assert ended.code == 0, ended.err
    assert "<html" in (tmp_path / "copied" / "report" / "index.html").read_text()
    assert record(tmp_path / "copied") == before
