"""What a living person did is not lost with a process, nor deleted with a damaged file."""

import shutil

import pytest

from harness.cli import main
from harness.running.recovery import recover_sessions
from harness.running.sessions import world_of
from harness.session.journal import FileJournal
from harness.session.parts import make_parts
from harness.session.session import Session
from protocols.files.errors import InputError
from protocols.record.check import check_study
from protocols.record.journal import journal_header, journal_path
from protocols.record.session import encode
from protocols.record.store import build_tables, open_folder, write_session


@pytest.fixture
def live_study(make_run, tmp_path):
    """Return a study of living people: two journals, of which one became a session."""
    run, folder = make_run(participants=2), tmp_path / "live"
    header = open_folder(folder, run.study, run.seed, "live")
    (folder / "journals").mkdir()
    for number, name in ((1, "P0001"), (2, "P0002")):
        path = journal_path(folder, name)
        journal = FileJournal(path, journal_header(run.study, run.seed, name))
        record = Session(run, number, world_of(run), make_parts(run, number), journal=journal).run()
        journal.close()
        if number == 1:
            write_session(folder, name, encode(record, header.digest))
    build_tables(folder, header.digest)
    return folder


def test_a_missing_session_is_made_from_its_journal(live_study):
    """A process that died after the last step leaves a journal, and that is enough."""
    outcome = recover_sessions(live_study)
    assert (outcome.whole, outcome.recovered, outcome.faults) == (("P0001",), ("P0002",), ())
    assert check_study(live_study) == ()
    assert recover_sessions(live_study).recovered == ()


def test_a_damaged_session_is_set_aside_and_made_again(live_study):
    """The damaged files are kept; the session has its bytes again."""
    session = live_study / "sessions" / "P0001"
    before = {path.name: path.read_bytes() for path in session.iterdir()}
    steps = session / "steps-0.parquet"
    damaged = steps.read_bytes()[:-7] + b"damaged"
    steps.write_bytes(damaged)
    (fault,) = (f for f in check_study(live_study) if "its checksum differs" in f)
    assert f"`lad-study recover {live_study}` rebuilds it" in fault
    assert "remove" not in fault
    assert recover_sessions(live_study).recovered == ("P0001", "P0002")
    assert {path.name: path.read_bytes() for path in session.iterdir()} == before
    aside = live_study / "set-aside" / "P0001-1" / "steps-0.parquet"
    assert aside.read_bytes() == damaged


def test_an_unfinished_journal_gives_what_there_is(live_study):
    """The lap under way ends as interrupted."""
    path = journal_path(live_study, "P0002")
    path.write_bytes(path.read_bytes()[:-40])
    assert recover_sessions(live_study).recovered == ("P0002",)
    assert check_study(live_study) == ()


def test_a_journal_that_cannot_be_used_is_named(live_study, capsys, monkeypatch):
    """One bad journal does not keep the others from being used; exit code 1."""
    good, bad = journal_path(live_study, "P0002"), journal_path(live_study, "P0003")
    shutil.copy(good, bad)
    monkeypatch.setattr("sys.argv", ["lad-study", "recover", str(live_study)])
    with pytest.raises(SystemExit) as end:
        main()
    said = capsys.readouterr()
    assert end.value.code == 1
    assert "P0002: rebuilt from its journal" in said.out
    assert "participant: P0002 there, P0003 wanted" in said.err


def test_a_live_study_is_not_run_as_a_simulated_one(live_study, make_run):
    """`lad-study run` would delete and simulate what only people can do."""
    run = make_run(participants=2)
    with pytest.raises(InputError, match="origin live, not simulated"):
        open_folder(live_study, run.study, run.seed)
