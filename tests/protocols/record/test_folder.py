"""Opening a study directory for a run."""

import errno
from collections.abc import Callable
from pathlib import Path

import pytest

from protocols.files.errors import InputError
from protocols.load import resolve_study
from protocols.record.header import read_header
from protocols.record.session import SessionRecord, encode
from protocols.record.store import finished_sessions, locked, open_folder, write_session
from protocols.resolved import ResolvedStudy


def _content(folder: Path) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def test_a_new_folder_says_what_study_it_holds(tmp_path: Path, plan: ResolvedStudy):
    """Head, codebook and places for sessions and logs are there before the first session."""
    out = tmp_path / "a" / "b"
    open_folder(out, plan, 7)
    header = read_header(out)
    assert (header.study, header.seed) == (plan, 7)
    assert header.versions["python"]
    assert header.platform
    assert {p.name for p in out.iterdir()} == {"study.yaml", "codebook.json", "sessions", "logs"}


def test_opening_again_keeps_everything_and_tidies_up(folder: Path, plan: ResolvedStudy):
    """Sessions and tables stay; what a killed run left unfinished goes."""
    before = _content(folder)
    for place in (folder, folder / "sessions", folder / "logs"):
        (place / ".partial-P0004-1").mkdir()
        (place / ".partial-P0004-1" / "x").write_text("x")
    open_folder(folder, plan, 0)
    assert _content(folder) == before
    assert finished_sessions(folder) == ("P0001", "P0002", "P0003")


def test_a_study_is_enlarged_and_never_shrunk(folder: Path):
    """More participants are written into the head; fewer change nothing."""
    for asked, planned in ((5, 5), (2, 5)):
        open_folder(folder, resolve_study("four-lap", participants=asked), 0)
        assert read_header(folder).protocol.cohort.participants == planned


def test_another_study_is_refused_with_the_difference(folder: Path, plan: ResolvedStudy):
    """Another seed or protocol leaves the folder as it was and says what differs."""
    before = _content(folder)
    with pytest.raises(InputError, match="holds another study: seed: 0 there, 1 wanted"):
        open_folder(folder, plan, 1)
    protocol = plan.protocol.model_copy(update={"control_period_s": 0.2, "title": "Mine"})
    with pytest.raises(InputError, match=r"title: .* wanted; protocol.control_period_s: 0.1 there"):
        open_folder(folder, ResolvedStudy(protocol, plan.course, plan.instruments), 0)
    with pytest.raises(InputError, match=r"\(and \d+ more differences\)"):
        open_folder(folder, resolve_study("rd-laps"), 0)
    assert _content(folder) == before


def test_a_folder_with_something_else_is_refused(tmp_path: Path, plan: ResolvedStudy):
    """Other files are not mixed with a study; a file is not a folder."""
    (tmp_path / "thesis.tex").write_text("precious")
    with pytest.raises(InputError, match=r"holds something else \(thesis.tex\)"):
        open_folder(tmp_path, plan, 0)
    with pytest.raises(InputError, match="is a file; allowed"):
        open_folder(tmp_path / "thesis.tex", plan, 0)
    with pytest.raises(InputError, match="cannot be made"):
        open_folder(tmp_path / "thesis.tex" / "sub", plan, 0)
    assert _content(tmp_path) == {"thesis.tex": b"precious"}


def test_a_damaged_head_is_refused(folder: Path, plan: ResolvedStudy):
    """A study.yaml that cannot be read is not overwritten."""
    (folder / "study.yaml").write_text("seed: zero\n")
    with pytest.raises(InputError, match=r"study.yaml:1: seed: must be a whole number"):
        open_folder(folder, plan, 0)


def test_killed_before_the_head_was_written_starts_over(tmp_path: Path, plan: ResolvedStudy):
    """A folder with nothing but an unfinished head is as good as new."""
    out = tmp_path / "out"
    out.mkdir()
    (out / ".partial-study.yaml-1").write_text("schema")
    open_folder(out, plan, 0)
    assert not list(out.glob(".partial-*"))


def test_two_runs_cannot_write_into_one_folder(folder: Path, plan: ResolvedStudy):
    """While one run holds the folder, another is refused; afterwards it is not."""
    with (
        locked(folder),
        pytest.raises(InputError, match="another run is writing into it"),
        locked(folder),
    ):
        pytest.fail("locked twice")
    with locked(folder):
        open_folder(folder, plan, 0)


def test_a_folder_is_locked_before_it_is_a_study(tmp_path: Path, plan: ResolvedStudy):
    """A lock alone is no study, and nothing else either: a run killed right then starts over."""
    with locked(tmp_path / "new"):
        assert [p.name for p in (tmp_path / "new").iterdir()] == [".lock"]
    open_folder(tmp_path / "new", plan, 0)


def test_a_file_system_without_locks_is_refused_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Two runs could not be kept apart there."""

    def flock(*_):
        raise OSError(errno.ENOSYS, "Function not implemented")

    monkeypatch.setattr("fcntl.flock", flock)
    with (
        pytest.raises(InputError, match=r"new: cannot be locked .*Function not implemented"),
        locked(tmp_path / "new"),
    ):
        pytest.fail("locked")


def test_a_folder_that_cannot_be_written_is_refused_by_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """In one line."""

    def touch(_):
        raise OSError(errno.EROFS, "Read-only file system")

    monkeypatch.setattr(Path, "touch", touch)
    with pytest.raises(InputError, match=r"cannot be written: Read-only"), locked(tmp_path):
        pytest.fail("locked")


def _recorded(folder: Path, plan: ResolvedStudy, session: SessionRecord) -> None:
    header = open_folder(folder, plan, 0)
    write_session(folder, "P0001", encode(session, header.digest))


def test_a_lost_head_is_written_again_for_the_same_study(
    tmp_path: Path, plan: ResolvedStudy, make_session: Callable[..., SessionRecord]
):
    """The sessions name their study; another study does not take them."""
    _recorded(tmp_path / "s", plan, make_session(1))
    (tmp_path / "s" / "study.yaml").unlink()
    with pytest.raises(InputError, match="holds something else"):
        open_folder(tmp_path / "s", plan, 1)
    open_folder(tmp_path / "s", plan, 0)
    assert read_header(tmp_path / "s").study == plan
    assert finished_sessions(tmp_path / "s") == ("P0001",)


def test_a_damaged_head_says_how_to_mend_it(
    tmp_path: Path, plan: ResolvedStudy, make_session: Callable[..., SessionRecord]
):
    """Where the sessions are this study's, it can be removed."""
    _recorded(tmp_path / "s", plan, make_session(1))
    head = tmp_path / "s" / "study.yaml"
    head.write_bytes(head.read_bytes()[:900])
    with pytest.raises(InputError, match=r"remove .*study.yaml, and the same `lad-study run`"):
        open_folder(tmp_path / "s", plan, 0)
    head.unlink()
    open_folder(tmp_path / "s", plan, 0)
