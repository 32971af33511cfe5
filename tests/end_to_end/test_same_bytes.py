"""The same seed gives the same bytes; another seed gives others."""

from pathlib import Path

import pytest


def test_the_same_seed_gives_the_same_bytes(run_quick, record, undisturbed, tmp_path):
    """Again, and with another number of processes."""
    ended = run_quick(tmp_path / "again", "--jobs", 1)
    assert ended.code == 0, ended.err
    assert record(tmp_path / "again") == undisturbed


def test_a_finished_study_is_whole(undisturbed_study, start):
    """`lad-study check` finds nothing wrong with it."""
    ended = start("check", undisturbed_study).ended()
    assert (ended.code, ended.out) == (0, f"{undisturbed_study}: whole\n")


@pytest.mark.slow
def test_another_seed_gives_other_bytes(run_quick, record, undisturbed, tmp_path):
    """Every table and every lap differs, and so does every model that could have learnt."""
    ended = run_quick(tmp_path / "other", "--seed", 1, "--participants", 2)
    assert ended.code == 0, ended.err
    other = record(tmp_path / "other")
    assert {"sessions/P0002/model.npz", "laps.parquet"} < other.keys() < undisturbed.keys()
    same = {name for name in other if other[name] == undisturbed[name]}
    assert {Path(name).name for name in same} <= {"codebook.json"}


def test_what_is_compared_is_the_whole_record(undisturbed):
    """Sessions with steps, rows, model and manifest; the three tables; the codebook."""
    of_p0001 = {"lap_rows.parquet", "manifest.json", "model.npz", "participant_row.parquet",
                "steps-0.parquet", "steps-1.parquet", "steps-2.parquet",
                "survey_rows.parquet"}  # fmt: skip
    names = {Path(name).name for name in undisturbed if "/P0001/" in name}
    assert names == of_p0001
    assert {name for name in undisturbed if "/" not in name} == {
        "codebook.json", "laps.parquet", "participants.parquet", "surveys.parquet",
    }  # fmt: skip


@pytest.mark.slow
def test_code_compiled_afresh_gives_the_same_bytes(run_quick, record, undisturbed, tmp_path):
    """With no compiled code on disk, and again with what the first run has left there."""
    cache = {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    for name in ("compiling", "loading"):
        ended = run_quick(tmp_path / name, "--jobs", 1, "--participants", 1, **cache)
        assert ended.code == 0, ended.err
        sessions = {n: b for n, b in record(tmp_path / name).items() if n.startswith("sessions/")}
        assert "sessions/P0001/model.npz" in sessions
        assert sessions == {n: undisturbed[n] for n in sessions}
    assert list((tmp_path / "cache").rglob("*.nbc"))


@pytest.mark.slow
def test_two_processes_that_compile_at_once_give_the_same_bytes(
    run_quick, record, undisturbed, tmp_path
):
    """Each compiles what the other has not kept yet, so code fresh and from disk is mixed."""
    cache = {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    for name in ("compiling", "loading"):
        ended = run_quick(tmp_path / name, "--jobs", 2, **cache)
        assert ended.code == 0, ended.err
        assert record(tmp_path / name) == undisturbed


@pytest.mark.slow
def test_the_shipped_study_gives_the_same_bytes(start, record, tmp_path):
    """The four-lap study in one process and in two, with its report, gives one record."""
    for name, jobs in (("a", 1), ("b", 2)):
        ended = start("run", "--participants", 3, "--jobs", jobs, "--out", tmp_path / name).ended()
        assert ended.code == 0, ended.err
        assert f"Report: {tmp_path / name}" in ended.out
    assert record(tmp_path / "a") == record(tmp_path / "b")
