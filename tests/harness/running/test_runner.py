"""A run: what was finished is kept, what failed is told, and the bytes are always the same."""

import errno
import shutil
from contextlib import nullcontext

import pytest

from harness.running import runner, writer
from harness.running import sessions as crew
from harness.running.runner import Outcome, run_study
from harness.running.sessions import attempt
from harness.running.workers import MAX_DEATHS, Died
from protocols.files.errors import InputError
from protocols.record.check import check_study
from protocols.record.header import read_header
from protocols.record.reader import open_study
from protocols.record.rows import participant_id


class Here:
    """Workers that are this process, so that a test's stand-ins reach it."""

    def run(self, task, numbers):
        """Run one after another."""
        return ((number, task(number)) for number in numbers)


@pytest.fixture
def here(monkeypatch):
    """Have sessions run in this process."""
    monkeypatch.setattr(runner, "open_workers", lambda *_: nullcontext(Here()))


def record(folder):
    """Return the record's files by name: all but logs and the head."""
    files = (p for p in folder.rglob("*") if p.is_file())
    names = ((p, p.relative_to(folder).as_posix()) for p in files)
    return {
        name: path.read_bytes()
        for path, name in names
        if not name.startswith("logs/") and name != "study.yaml"
    }


@pytest.mark.usefixtures("ready")
def test_the_number_of_processes_changes_no_byte(make_run, tmp_path):
    """One process, or several: sessions and tables are the same."""
    run = make_run(participants=5)
    for jobs in (1, 3):
        assert run_study(run, tmp_path / f"{jobs}", jobs) == Outcome(5, 0, 5, ())
    assert record(tmp_path / "1") == record(tmp_path / "3")
    assert check_study(tmp_path / "3") == ()


def test_progress_is_told_from_the_first_session_to_the_last(here, make_run, tmp_path):
    """Sessions that were there before count as ended from the start."""
    told = []
    run_study(make_run(participants=2), tmp_path / "s", 1, lambda *now: told.append(now))
    assert told == [(0, 2), (1, 2), (2, 2)]
    told.clear()
    run_study(make_run(participants=4), tmp_path / "s", 1, lambda *now: told.append(now))
    assert told == [(2, 4), (3, 4), (4, 4)]


def test_a_study_is_enlarged_without_touching_what_is_there(here, make_run, tmp_path):
    """The sessions there are not written again; the study is the one a larger run makes."""
    small, large = tmp_path / "small", tmp_path / "large"
    run_study(make_run(participants=2), small, 1)
    before = {p: (p.stat().st_mtime_ns, p.stat().st_ino) for p in small.glob("sessions/*/*")}
    assert run_study(make_run(participants=4), small, 1) == Outcome(4, 2, 2, ())
    assert {p: (p.stat().st_mtime_ns, p.stat().st_ino) for p in before} == before
    run_study(make_run(participants=4), large, 1)
    assert record(small) == record(large)
    assert run_study(make_run(participants=3), small, 1) == Outcome(3, 3, 0, ())
    assert record(small) == record(large)


def test_a_finished_study_needs_no_workers(here, make_run, tmp_path, monkeypatch):
    """Running it again only puts its tables in order."""
    run, out = make_run(participants=2), tmp_path / "s"
    run_study(run, out, 1)
    whole = record(out)
    (out / "laps.parquet").unlink()
    monkeypatch.setattr(runner, "open_workers", None)
    assert run_study(run, out, 1) == Outcome(2, 2, 0, ())
    assert record(out) == whole


def test_a_failure_is_kept_told_and_left_alone_until_asked(here, make_run, unlucky, tmp_path):
    """The others finish; the failed ones are run again only on request, to the same bytes."""
    (tmp_path / "mood").touch()
    driver = f"{{use: 'some_drivers:moody', options: {{file: '{tmp_path / 'mood'}'}}}}"
    run, out = make_run(participants=6, driver=driver), tmp_path / "s"
    failed = tuple(map(participant_id, unlucky(run)))
    assert run_study(run, out, 1) == Outcome(6, 0, 6 - len(failed), failed)
    for name in failed:
        log = (out / "logs" / f"failed-{name}.txt").read_text()
        assert "RuntimeError: I am in no mood" in log
    assert open_study(out).failed() == failed
    assert len(open_study(out).participants) == 6 - len(failed)
    (tmp_path / "mood").unlink()
    assert run_study(run, out, 1) == Outcome(6, 6 - len(failed), 0, failed)
    assert run_study(run, out, 1, retry_failed=True) == Outcome(6, 6 - len(failed), len(failed), ())
    assert not list((out / "logs").glob("failed-*"))
    run_study(run, tmp_path / "calm", 1)
    assert record(out) == record(tmp_path / "calm")


@pytest.mark.usefixtures("ready")
def test_deaths_of_processes_are_logged(make_run, unlucky, tmp_path):
    """Each death is a line of the log, and the last one is the failure's reason."""
    run, out = make_run(participants=4, driver="{use: 'some_drivers:deadly'}"), tmp_path / "s"
    failed = tuple(map(participant_id, unlucky(run)))
    assert run_study(run, out, 2).failed == failed
    assert failed
    deaths = (out / "logs" / "deaths.csv").read_text().splitlines()
    for name in failed:
        assert deaths.count(f"{name},its process was killed by SIGKILL") == MAX_DEATHS - 1
        assert "SIGKILL" in (out / "logs" / f"died-{name}.txt").read_text()
    assert open_study(out).failed() == failed


def test_who_was_given_up_is_tried_again_by_the_same_call(here, make_run, tmp_path, monkeypatch):
    """Memory was short, or a machine was taken away: the study is not over."""
    run, out = make_run(participants=2), tmp_path / "s"
    killed = Died("its process was killed by SIGKILL")
    with monkeypatch.context() as patch:
        patch.setattr(Here, "run", lambda _, task, numbers: ((n, killed) for n in numbers))
        patch.setattr(runner, "try_parts", lambda *_: None)
        assert run_study(run, out, 1) == Outcome(2, 0, 0, ("P0001", "P0002"))
    assert run_study(run, out, 1) == Outcome(2, 0, 2, ())
    assert not list((out / "logs").glob("died-*"))


def test_of_two_runs_that_start_together_the_second_leaves_no_byte(
    here, make_run, tmp_path, monkeypatch
):
    """The other one comes between this one's look at the folder and its first byte."""
    first, second = make_run(participants=1), make_run(participants=1, seed=1)
    out, undisturbed = tmp_path / "s", tmp_path / "alone"
    run_study(first, undisturbed, 1)

    def meanwhile(*_):
        monkeypatch.setattr(runner, "try_parts", lambda *_: None)
        run_study(first, out, 1)

    monkeypatch.setattr(runner, "try_parts", meanwhile)
    with pytest.raises(InputError, match="seed: 0 there, 1 wanted"):
        run_study(second, out, 1)
    assert record(out) == record(undisturbed)
    assert read_header(out).seed == 0


def test_a_foreign_session_is_resume_command(here, make_run, tmp_path):
    """Another seed's session was put there: the study ends as if it had not been."""
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    run_study(make_run(participants=2), ours, 1)
    run_study(make_run(participants=2, seed=1), theirs, 1)
    whole = record(ours)
    shutil.rmtree(ours / "sessions" / "P0002")
    shutil.copytree(theirs / "sessions" / "P0002", ours / "sessions" / "P0002")
    assert run_study(make_run(participants=2), ours, 1) == Outcome(2, 1, 1, ())
    assert record(ours) == whole


def test_a_write_error_loses_nothing_that_was_finished(here, make_run, tmp_path, monkeypatch):
    """No space left: the run ends with the system's error, and the same call resumes it later.

    A session that is being written beside the one that fails is kept, too.
    """
    run, out = make_run(participants=4), tmp_path / "s"
    write, calls = writer.write_session, []

    def disk_full(folder, name, files):
        calls.append(name)
        if len(calls) == 3:
            (folder / "sessions" / f".partial-{name}-1").mkdir()
            raise OSError(errno.ENOSPC, "No space left on device", str(folder))
        write(folder, name, files)

    monkeypatch.setattr(writer, "write_session", disk_full)
    with pytest.raises(OSError, match="No space left"):
        run_study(run, out, 1)
    kept = calls[:2] + calls[3:]
    assert sorted(p.name for p in (out / "sessions").glob("P*")) == kept
    assert not list(out.glob("*.parquet"))
    assert run_study(run, out, 1) == Outcome(4, len(kept), 4 - len(kept), ())
    run_study(run, tmp_path / "undisturbed", 1)
    assert record(out) == record(tmp_path / "undisturbed")


@pytest.mark.parametrize("name", ["steps-0.parquet", "participant_row.parquet", "manifest.json"])
def test_a_truncated_file_is_never_read(here, make_run, tmp_path, name):
    """The session it belongs to is run again, to the same bytes."""
    run, out = make_run(participants=2), tmp_path / "s"
    run_study(run, out, 1)
    whole = record(out)
    damaged = out / "sessions" / "P0002" / name
    damaged.write_bytes(damaged.read_bytes()[:-7])
    assert run_study(run, out, 1) == Outcome(2, 1, 1, ())
    assert record(out) == whole


@pytest.mark.parametrize("table", ["participants.parquet", "laps.parquet", "surveys.parquet"])
def test_a_truncated_table_is_built_again(here, make_run, tmp_path, table):
    """From the sessions, to the same bytes."""
    run, out = make_run(participants=2), tmp_path / "s"
    run_study(run, out, 1)
    whole = record(out)
    (out / table).write_bytes(b"PAR1")
    assert run_study(run, out, 1) == Outcome(2, 2, 0, ())
    assert record(out) == whole


def test_another_study_is_refused_before_anything_starts(here, make_run, tmp_path, monkeypatch):
    """The difference is shown; no worker is started and no byte changes."""
    out = tmp_path / "s"
    run_study(make_run(participants=1), out, 1)
    whole = record(out)
    monkeypatch.setattr(runner, "open_workers", None)
    with pytest.raises(InputError, match="seed: 0 there, 1 wanted"):
        run_study(make_run(participants=2, seed=1), out, 1)
    with pytest.raises(InputError, match=r"driver\.use: 'some_drivers:straight' there"):
        run_study(make_run(participants=2, driver="{use: autonomous}"), out, 1)
    assert record(out) == whole


def test_a_part_that_cannot_be_made_leaves_no_folder(here, make_run, tmp_path):
    """The check of all parts comes before the first byte."""
    with pytest.raises(InputError, match="no such thing"):
        run_study(make_run(driver="{use: 'some_drivers:impossible'}"), tmp_path / "s", 1)
    assert not (tmp_path / "s").exists()


def test_a_changed_command_log_is_another_study(here, make_run, tmp_path):
    """What a scripted driver replays belongs to what the study is, not only its file's name."""
    log, driver = tmp_path / "log.csv", "{use: scripted, options: {file: log.csv}}"
    log.write_text("t_s,v_m_s,w_rad_s\n0,0.3,0\n")
    run_study(make_run(participants=1, driver=driver), tmp_path / "s", 1)
    assert run_study(make_run(participants=2, driver=driver), tmp_path / "s", 1).finished == 1
    log.write_text("t_s,v_m_s,w_rad_s\n0,0.2,0\n")
    with pytest.raises(InputError, match=r"options\.commands"):
        run_study(make_run(participants=3, driver=driver), tmp_path / "s", 1)


def test_going_on_with_other_versions_is_recorded_per_session(
    here, make_run, tmp_path, monkeypatch
):
    """It is allowed, and the study says which versions recorded it."""
    out = tmp_path / "s"
    run_study(make_run(participants=1), out, 1)
    monkeypatch.setattr("protocols.record.manifest.package_versions", lambda: {"numpy": "0.1"})
    run_study(make_run(participants=2), out, 1)
    assert [v["numpy"] == "0.1" for v in open_study(out).versions()].count(True) == 1
    assert len(open_study(out).versions()) == 2
    shutil.rmtree(out / "sessions" / "P0002")
    assert len(open_study(out).versions()) == 1


def test_a_session_knows_nothing_of_how_many_take_part(make_run):
    """A participant's bytes do not depend on the cohort's size."""
    few, many = make_run(participants=1), make_run(participants=9999)
    assert attempt(few, 1).files == attempt(many, 1).files
    assert isinstance(attempt(many, 9999), crew.Finished)
