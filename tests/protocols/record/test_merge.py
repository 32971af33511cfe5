"""The study's tables, built from its sessions."""

from collections.abc import Callable
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from protocols.files.errors import InputError
from protocols.record import merge
from protocols.record.merge import build_tables
from protocols.record.reader import open_study
from protocols.record.session import SessionRecord, encode
from protocols.record.sessions import write_session

_TABLES = ("participants.parquet", "laps.parquet", "surveys.parquet")


def _tables(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in _TABLES}


def test_tables_hold_every_row_in_the_order_of_participants(folder: Path):
    """Three participants, two laps and four answers each, whatever order they were finished in."""
    assert pq.read_table(folder / "participants.parquet")["participant"].to_pylist() == [
        "P0001", "P0002", "P0003"]  # fmt: skip
    laps = pq.read_table(folder / "laps.parquet")
    assert list(zip(laps["participant"].to_pylist(), laps["lap"].to_pylist(), strict=True)) == [
        (p, lap) for p in ("P0001", "P0002", "P0003") for lap in (0, 1)]  # fmt: skip
    assert pq.read_table(folder / "surveys.parquet")["response"].to_pylist() == [
        4, None, 5, 1] * 3  # fmt: skip


def test_tables_do_not_depend_on_the_order_of_finishing(
    tmp_path: Path, folder: Path, session_files: dict
):
    """Another order, with tables built in between, ends with the same bytes."""
    other = tmp_path / "other"
    other.mkdir()
    for name in ("P0003", "P0001", "P0002"):
        write_session(other, name, session_files[name])
        build_tables(other)
    assert _tables(other) == _tables(folder)


def test_row_groups_bound_what_is_held(folder: Path, monkeypatch: pytest.MonkeyPatch):
    """Tables are written in groups of sessions; the rows are the same however large those are."""
    whole = {name: pq.read_table(folder / name) for name in _TABLES}
    monkeypatch.setattr(merge, "_SESSIONS_PER_ROW_GROUP", 2)
    build_tables(folder)
    for name in _TABLES:
        assert pq.ParquetFile(folder / name).num_row_groups == 2
        assert pq.read_table(folder / name).equals(whole[name])


def test_without_sessions_tables_are_empty(tmp_path: Path):
    """A study of which nothing is finished has tables with columns and no rows."""
    build_tables(tmp_path)
    assert [pq.read_table(tmp_path / name).num_rows for name in _TABLES] == [0, 0, 0]


def test_a_damaged_session_is_left_out_and_an_unreadable_one_named(folder: Path):
    """A truncated session is not read; same-sized rubbish stops the build, old tables stay."""
    before = _tables(folder)
    part = folder / "sessions" / "P0002" / "lap_rows.parquet"
    content = part.read_bytes()
    part.write_bytes(b"\0" * len(content))
    with pytest.raises(InputError, match=r"P0002/lap_rows.parquet: not a readable Parquet file"):
        build_tables(folder)
    assert _tables(folder)["laps.parquet"] == before["laps.parquet"]
    assert not list(folder.glob(".partial-*"))
    part.write_bytes(content[:-10])
    build_tables(folder)
    assert pq.read_table(folder / "laps.parquet").num_rows == 4


@pytest.mark.parametrize("replaced", range(3))
def test_a_build_that_was_killed_hides_nothing(
    folder: Path, session_files: dict, monkeypatch: pytest.MonkeyPatch, replaced: int
):
    """After any of the three tables: the study is refused as not over, never half read."""
    again = session_files["P0001"]
    for name in ("P0001", "P0002", "P0003"):
        (folder / "sessions" / name).rename(folder / "sessions" / f".partial-{name}-1")
    write_session(folder, "P0001", again)
    build_tables(folder)
    for name in ("P0002", "P0003"):
        (folder / "sessions" / f".partial-{name}-1").rename(folder / "sessions" / name)
    replace, calls = Path.replace, []

    def killed(path: Path, target: Path) -> Path:
        calls.append(target)
        if len(calls) > replaced:
            raise KeyboardInterrupt
        return replace(path, target)

    monkeypatch.setattr(Path, "replace", killed)
    with pytest.raises(KeyboardInterrupt):
        build_tables(folder)
    with pytest.raises(InputError, match=r"lacks 2 finished sessions \(P0002 first\)"):
        open_study(folder)


def test_a_first_build_that_was_killed_is_no_study_without_answers(folder: Path):
    """In a study of ours, no table of answers means that it was not built."""
    (folder / "surveys.parquet").unlink()
    with pytest.raises(InputError, match=r"surveys.parquet: no such file; the same `lad-study"):
        open_study(folder)


def test_sessions_of_another_study_are_left_out(
    folder: Path, make_session: Callable[..., SessionRecord]
):
    """As far as a session says what study it is of."""
    write_session(folder, "P0004", encode(make_session(4), "e" * 64))
    build_tables(folder, "d" * 64)
    assert pq.read_table(folder / "participants.parquet").num_rows == 3


def test_rows_of_another_schema_are_refused(folder: Path):
    """A session with other columns than this version's is named, not merged."""
    part = folder / "sessions" / "P0001" / "lap_rows.parquet"
    pq.write_table(pa.table({"a": [1]}), part)
    with pytest.raises(InputError, match="its columns are not those"):
        merge.session_rows(part, merge.STUDY_TABLES[1][2])
