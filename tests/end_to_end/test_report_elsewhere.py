"""A study directory is reported where there is no simulator."""

import os
import shutil
import subprocess
import sys


def test_a_copied_study_is_reported_without_pybullet(undisturbed_study, start, record, tmp_path):
    """The report needs nothing but the directory, and leaves the record as it is."""
    (tmp_path / "blocked").mkdir()
    (tmp_path / "blocked" / "pybullet.py").write_text("raise ImportError('no simulator here')")
    blocked = str(tmp_path / "blocked")
    importing = subprocess.run(
        [sys.executable, "-c", "import pybullet"],
        env={**os.environ, "PYTHONPATH": blocked},
        capture_output=True,
        check=False,
    )
    assert importing.returncode != 0, "PyBullet is not blocked; this test would show nothing"
    copied = shutil.copytree(undisturbed_study, tmp_path / "copied")
    ended = start("report", copied, PYTHONPATH=blocked).ended()
    assert ended.code == 0, ended.err
    assert "<html" in (copied / "report" / "index.html").read_text()
    assert record(copied) == record(undisturbed_study)
