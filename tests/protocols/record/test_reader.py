"""Reading a study directory."""

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from protocols.files.errors import InputError
from protocols.record.check import check_study
from protocols.record.reader import off_scale, open_study
from protocols.record.session import SessionRecord, encode
from protocols.record.store import build_tables, open_folder, write_failure, write_session
from protocols.resolved import ResolvedStudy


def _refused(folder: Path | str) -> str:
    with pytest.raises(InputError) as caught:
        open_study(folder)
    return str(caught.value)


def test_a_study_is_read_back(folder: Path, plan: ResolvedStudy):
    """Protocol, course, seed, tables, steps and models are those that were written."""
    study = open_study(folder)
    assert (study.protocol, study.course, study.instruments) == (
        plan.protocol, plan.course, plan.instruments)  # fmt: skip
    assert study.seed == 0
    assert study.sessions() == ("P0001", "P0002", "P0003")
    assert study.participants.num_rows == 3
    assert (study.laps.num_rows, study.surveys.num_rows) == (6, 12)
    assert study.steps("P0002", 1)["step"].to_pylist() == [0, 1, 2, 3, 4]
    assert study.model_bytes("P0001") == b"learnt"
    assert len(study.versions()) == 1


def test_single_columns_can_be_read(folder: Path):
    """Only what was asked for comes, in that order."""
    steps = open_study(folder).steps("P0001", 0, ["clearance_m", "t_s"])
    assert steps.column_names == ["clearance_m", "t_s"]


def test_a_copy_elsewhere_reads_the_same(folder: Path, tmp_path: Path):
    """A study directory is self-contained: no path in it leads outside."""
    copy = tmp_path / "elsewhere" / "copy"
    shutil.copytree(folder, copy)
    shutil.rmtree(folder)
    assert open_study(copy).laps.num_rows == 6


def test_unfinished_rubbish_is_never_read(folder: Path):
    """What a killed run left behind is no session."""
    (folder / "sessions" / ".partial-P0004-77").mkdir()
    assert open_study(folder).sessions() == ("P0001", "P0002", "P0003")


def test_what_is_no_study_is_told(tmp_path: Path, plan: ResolvedStudy):
    """Nowhere, a file, some folder, and a study before its first session, in one line each."""
    assert _refused(tmp_path / "nowhere") == f"{tmp_path / 'nowhere'}: no such folder"
    (tmp_path / "file").write_text("x")
    assert "is a file, not a study directory" in _refused(tmp_path / "file")
    assert "not a study directory; there is no study.yaml" in _refused(tmp_path)
    open_folder(tmp_path / "new", plan, 0)
    assert "no session in it yet" in _refused(tmp_path / "new")


def test_participants_and_laps_that_do_not_exist_are_told_with_those_that_do(folder: Path):
    """An unknown participant or lap is refused; so is a way out of the directory."""
    study = open_study(folder)
    for participant in ("P0009", "../sessions/P0001", ""):
        with pytest.raises(InputError, match="allowed: P0001, P0002, P0003"):
            study.steps(participant, 0)
    for lap in (2, -1):
        with pytest.raises(InputError, match=f"P0001 has no lap {lap}; allowed: 0, 1"):
            study.steps("P0001", lap)
    assert study.has_steps("P0001", 1)
    assert not study.has_steps("P0001", 2)


@pytest.mark.parametrize("name", ["participants.parquet", "laps.parquet", "surveys.parquet"])
def test_a_corrupt_table_is_named(folder: Path, name: str):
    """A truncated table is refused when the study is opened, by its name."""
    path = folder / name
    path.write_bytes(path.read_bytes()[:-20])
    assert _refused(folder).startswith(f"{path}: not a readable Parquet file")


def test_corrupt_steps_are_named(folder: Path):
    """A truncated step table is refused when it is read."""
    path = folder / "sessions" / "P0001" / "steps-0.parquet"
    path.write_bytes(b"PAR1")
    with pytest.raises(InputError, match=r"P0001/steps-0.parquet: not a readable Parquet file"):
        open_study(folder).steps("P0001", 0)


def test_a_missing_table_says_how_to_finish(folder: Path):
    """A run that was killed before its tables were built says what to do."""
    (folder / "laps.parquet").unlink()
    assert "laps.parquet: no such file; the same `lad-study run` again" in _refused(folder)


def test_another_schema_version_is_refused(folder: Path):
    """A study of a later version is not misread."""
    path = folder / "study.yaml"
    path.write_text(path.read_text().replace("schema: 2", "schema: 9", 1))
    assert _refused(folder) == f"{path}:1: schema: 9 is not allowed here; allowed: 1, 2"


def test_failed_sessions_are_those_still_missing(folder: Path):
    """A session that failed and was run again is not failed any more."""
    for name in ("P0002", "P0007"):
        write_failure(folder, name, "Traceback")
    assert open_study(folder).failed() == ("P0007",)


def test_tables_that_lack_finished_sessions_are_refused(
    folder: Path, make_session: Callable[..., SessionRecord]
):
    """A report of tables that a stopped run left behind would hide what it had finished."""
    write_session(folder, "P0004", encode(make_session(4)))
    with pytest.raises(InputError, match=r"lacks 1 finished sessions \(P0004 first\).*same `lad-"):
        open_study(folder)
    build_tables(folder)
    assert open_study(folder).participants.num_rows == 4


def test_a_study_recorded_elsewhere_is_read(ward: Path):
    """A hand-made directory: a short study.yaml, two tables from pandas, one lap's steps."""
    study = open_study(ward)
    assert study.seed is None
    assert study.laps["lap_time_s"].to_pylist() == [50, 45, 60]
    assert study.surveys.num_rows == 0
    assert study.steps("Ann", 1)["x_m"].to_pylist() == [1.0, 1.1]
    assert study.steps("Ann", 1)["control"].null_count == 2
    assert not study.has_steps("Bea", 0)


@pytest.mark.parametrize("given", [0, 6, 99, -1])
def test_an_answer_off_the_scale_is_named(folder: Path, given: int):
    """Which answer, and what the scale has."""
    path = folder / "surveys.parquet"
    answers = pq.read_table(path)
    responses = [*answers["response"].to_pylist()[:-1], given]
    place = answers.schema.get_field_index("response")
    field = answers.schema.field(place)
    changed = answers.set_column(place, field, pa.array(responses, field.type))
    pq.write_table(changed, path)
    said = f"column response: {given} in row {len(answers) - 1}; allowed: 1 to 5"
    with pytest.raises(InputError, match=said):
        _ = open_study(folder).surveys


def test_answers_from_elsewhere_are_not_refused(folder: Path):
    """Nobody can run that study again: it opens, and whoever reads the answers is told."""
    header = folder / "study.yaml"
    header.write_text(
        re.sub("(?m)^seed: .*\norigin: .*$", "seed: null\norigin: elsewhere", header.read_text())
    )
    path = folder / "surveys.parquet"
    answers = pq.read_table(path)
    place = answers.schema.get_field_index("response")
    field = answers.schema.field(place)
    nine = pa.array([9, *answers["response"].to_pylist()[1:]], field.type)
    pq.write_table(answers.set_column(place, field, nine), path)
    said = f"{path}: column response: 9 in row 0; allowed: 1 to 5 (driving-assistance), or nothing"
    assert list(off_scale(open_study(folder))) == [(0, said)]
    assert said in check_study(folder)
    path.write_bytes(path.read_bytes()[:-20])
    assert open_study(folder).laps.num_rows == 6


@pytest.mark.parametrize(
    ("origin", "said"),
    [
        (
            "simulated",
            "has no row, but there are 3 sessions; the same `lad-study run` again makes it anew",
        ),
        ("elsewhere", "has no row; a report needs at least one participant and one lap"),
    ],
)
@pytest.mark.parametrize("name", ["participants", "laps"])
def test_a_table_without_a_row_says_what_to_do(folder: Path, name: str, origin: str, said: str):
    """To run a study that has its sessions, or was not run here, would be wrong advice."""
    header = folder / "study.yaml"
    header.write_text(re.sub("(?m)^origin: .*$", f"origin: {origin}", header.read_text()))
    path = folder / f"{name}.parquet"
    pq.write_table(pq.read_table(path)[:0], path)
    assert _refused(folder) == f"{path}: {said}"
