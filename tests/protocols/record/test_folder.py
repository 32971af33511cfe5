"""Opening a study directory for a run."""

from pathlib import Path

import pytest

from protocols.errors import InputError
from protocols.load import resolve_study
from protocols.record.header import read_header
from protocols.record.store import finished_sessions, held, open_folder
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
    with pytest.raises(InputError, match=r"title: .* wanted \(and 1 more differences\)"):
        open_folder(folder, ResolvedStudy(protocol, plan.course, plan.instruments), 0)
    assert _content(folder) == before


def test_a_folder_with_something_else_is_refused(tmp_path: Path, plan: ResolvedStudy):
    """Somebody's files are not mixed with a study; a file is no folder."""
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
    with held(folder), pytest.raises(InputError, match="another run is writing into it"):
        open_folder(folder, plan, 0)
    open_folder(folder, plan, 0)
