"""A run that does not depend on the machine."""

import pytest

from harness.session.study_run import portable
from protocols.files.errors import InputError

LOG = "t_s,v_m_s,w_rad_s\n0.0,0.3,0.0\n0.25,0.1,-0.5\n"


def test_a_command_log_becomes_part_of_the_run(make_run, tmp_path):
    """Its commands replace the file's name; the file is not needed any more."""
    (tmp_path / "log.csv").write_text(LOG)
    run = portable(make_run(driver="{use: scripted, options: {file: log.csv}}"))
    (tmp_path / "log.csv").unlink()
    driver = run.study.protocol.cohort.driver
    assert driver.options == {"commands": [[0.0, 0.3, 0.0], [0.25, 0.1, -0.5]]}
    assert portable(run) == run


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (None, ["log.csv", "No such file"]),
        ("t_s,v_m_s\n0,1\n", ["log.csv:1", "w_rad_s"]),
        ("t_s,v_m_s,w_rad_s\n1,0,0\n0,0,0\n", ["log.csv", "command 2"]),
    ],
)
def test_a_log_that_cannot_be_replayed_is_named(make_run, tmp_path, text, parts):
    """File, place and what is allowed are said before anything runs."""
    if text is not None:
        (tmp_path / "log.csv").write_text(text)
    with pytest.raises(InputError) as error:
        portable(make_run(driver="{use: scripted, options: {file: log.csv}}"))
    for part in [*parts, "allowed"]:
        assert part in str(error.value)


def test_other_runs_stay_as_they_are(make_run, tmp_path):
    """Only the folder becomes absolute: a worker may stand elsewhere."""
    run = make_run(driver="{use: 'some_drivers:straight', options: {file: log.csv}}")
    assert portable(run) == run
    assert portable(run).study.folder == tmp_path.resolve()
