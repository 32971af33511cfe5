"""A log is replayed as it stands, and a bad one is refused with where and what."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.command import STILL, Command
from participants.registry import make_driver
from participants.scripted import ScriptedDriver, read_log
from participants.setup import DriverSetup
from protocols.files.errors import InputError

NUMBER = st.floats(-1.0, 1.0)


@given(st.lists(st.tuples(st.floats(0.01, 1.0), NUMBER, NUMBER), min_size=1, max_size=30))
def test_each_command_holds_until_the_next(steps):
    """At and after a command's time, and before the next one's, it is what is said."""
    times = np.cumsum([gap for gap, _, _ in steps])
    driver = ScriptedDriver([(t, v, w) for t, (_, v, w) in zip(times, steps, strict=True)])
    assert driver.command_at(0.0) == STILL
    for i, (_, v, w) in enumerate(steps):
        assert driver.command_at(times[i]) == Command(v, w)
        if i + 1 < len(steps):
            assert driver.command_at((times[i] + times[i + 1]) / 2) == Command(v, w)
    assert driver.command_at(times[-1] + 99.0) == Command(*steps[-1][1:])


def test_times_that_are_sums_of_tenths_are_met():
    """A step at 0.3 s finds the command of 0.3 s, however the sum was rounded."""
    driver = ScriptedDriver([(0.0, 0.1, 0.0), (0.3, 0.2, 0.0)])
    assert driver.command_at(0.1 + 0.2).v == 0.2
    assert driver.command_at(0.3 - 1e-12).v == 0.2


def test_a_file_is_read_beside_the_protocol(lab_office, tmp_path):
    """Other columns and their order do not matter; the path starts at the protocol's folder."""
    text = "w_rad_s,note,t_s,v_m_s\n-0.1,go,0,0.4\n0,,1.5,0\n\n"
    (tmp_path / "log.csv").write_text(text)
    rng = np.random.default_rng(0)
    setup = DriverSetup(lab_office, rng, options={"file": "log.csv"}, folder=tmp_path)
    driver = make_driver("scripted", setup)
    assert driver.command_at(1.0) == Command(0.4, -0.1)
    assert driver.command_at(2.0) == STILL


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "log.csv:1: column t_s, v_m_s, w_rad_s is missing; allowed: a CSV file"),
        ("t_s,v_m_s\n0,1\n", "log.csv:1: column w_rad_s is missing"),
        ("t_s,v_m_s,w_rad_s\n", "holds no command"),
        ("t_s,v_m_s,w_rad_s\n0,fast,0\n", "log.csv:2: could not convert .*'fast'"),
        ("t_s,v_m_s,w_rad_s\n0,0.1,0\n1,0.1\n", "log.csv:3: has only 2 values"),
    ],
)
def test_a_bad_file_is_explained(tmp_path, text, message):
    """The line and what is wrong with it."""
    path = tmp_path / "log.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=message):
        read_log(path)


def test_a_file_that_is_none_is_explained(tmp_path):
    """Missing files, folders and binary files alike."""
    (tmp_path / "binary").write_bytes(b"\xff\xfe\x00\x80")
    for name in ("absent.csv", "", "binary"):
        with pytest.raises(InputError, match="cannot be read as a command log"):
            read_log(tmp_path / name)


@pytest.mark.parametrize(
    ("log", "message"),
    [
        ([], r"shape \(0,\); allowed: \(n, 3\)"),
        ([(0.0, 0.1)], r"shape \(1, 2\)"),
        ([(0.0, 0.1, "x")], "rows of numbers"),
        ([(0.0, 0.1, 0.0), (1.0, np.nan, 0.0)], "command 2 is not finite"),
        ([(0.0, 0.1, 0.0), (0.0, 0.1, 0.0)], "command 2 comes at 0 s"),
        ([(-1.0, 0.1, 0.0)], "command 1 comes at -1 s"),
    ],
)
def test_a_bad_log_is_explained(log, message):
    """Which command, and what is wrong with it."""
    with pytest.raises(InputError, match=message):
        ScriptedDriver(log)


@pytest.mark.parametrize("options", [{}, {"file": "a", "commands": [[0, 0, 0]]}, {"fiel": "a"}])
def test_exactly_one_source_is_named(lab_office, options):
    """Neither, both and misspelt are errors of the protocol."""
    with pytest.raises(InputError, match="driver 'scripted'"):
        make_driver("scripted", DriverSetup(lab_office, np.random.default_rng(0), options=options))
