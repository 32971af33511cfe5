"""A session as bytes."""

import hashlib
import io
from collections.abc import Callable
from dataclasses import asdict, replace

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from protocols.record.manifest import parse_manifest
from protocols.record.session import RecordedLap, SessionRecord, encode
from protocols.record.steps import STEP_SCHEMA
from protocols.record.tables import LAP_SCHEMA, PARTICIPANT_SCHEMA, SURVEY_SCHEMA


def _read(content: bytes) -> pa.Table:
    return pq.read_table(io.BytesIO(content))


def test_the_same_session_gives_the_same_bytes(make_session: Callable[..., SessionRecord]):
    """Encoding depends on the session alone, not on the order in which traits were filled in."""
    session = make_session(1)
    traits = dict(reversed(session.participant.traits.items()))
    again = replace(make_session(1), participant=replace(session.participant, traits=traits))
    assert encode(session) == encode(again)
    assert encode(session) != encode(make_session(2))


def test_chunks_do_not_reach_the_file(make_session: Callable[..., SessionRecord]):
    """A step table made of pieces gives the bytes of the same table in one."""
    session = make_session(1)
    pieces = tuple(
        RecordedLap(lap.row, pa.concat_tables([lap.steps[:2], lap.steps[2:]]))
        for lap in session.laps
    )
    assert encode(replace(session, laps=pieces)) == encode(session)


def test_everything_comes_back(make_session: Callable[..., SessionRecord]):
    """Rows, answers, steps and model are in the files as they were in memory."""
    session = make_session(1)
    files = encode(session)
    assert set(files) == {
        "participant_row.parquet", "lap_rows.parquet", "survey_rows.parquet", "steps-0.parquet",
        "steps-1.parquet", "model.npz", "manifest.json"}  # fmt: skip
    person = _read(files["participant_row.parquet"])
    assert person.schema.equals(PARTICIPANT_SCHEMA)
    (row,) = person.to_pylist(maps_as_pydicts="strict")
    assert row == asdict(session.participant)
    laps = _read(files["lap_rows.parquet"])
    assert laps.schema.equals(LAP_SCHEMA)
    assert laps.to_pylist() == [asdict(lap.row) for lap in session.laps]
    answers = _read(files["survey_rows.parquet"])
    assert answers.schema.equals(SURVEY_SCHEMA)
    assert answers.to_pylist() == [asdict(answer) for answer in session.answers]
    for n, lap in enumerate(session.laps):
        assert _read(files[f"steps-{n}.parquet"]).equals(lap.steps)
    assert files["model.npz"] == b"learnt"


def test_the_manifest_holds_every_checksum(make_session: Callable[..., SessionRecord]):
    """Each file's size and SHA-256 are in the manifest, and the software's versions too."""
    files = encode(make_session(1))
    manifest = parse_manifest(files.pop("manifest.json"))
    assert manifest is not None
    assert {name: (e.bytes, e.sha256) for name, e in manifest.files.items()} == {
        name: (len(content), hashlib.sha256(content).hexdigest()) for name, content in files.items()
    }
    assert {"python", "pyarrow", "numpy"} <= manifest.versions.keys()


def test_a_session_may_have_learnt_and_answered_nothing(make_session: Callable[..., SessionRecord]):
    """Without a model there is no model file; without answers the survey file has no rows."""
    files = encode(replace(make_session(1), answers=(), model=None))
    assert "model.npz" not in files
    assert _read(files["survey_rows.parquet"]).num_rows == 0
    assert _read(files["survey_rows.parquet"]).schema.equals(SURVEY_SCHEMA)


def test_a_lap_may_be_empty(make_session: Callable[..., SessionRecord]):
    """A lap that ended before its first step has a file without rows."""
    session = make_session(1, laps=1)
    empty = RecordedLap(session.laps[0].row, STEP_SCHEMA.empty_table())
    assert _read(encode(replace(session, laps=(empty,)))["steps-0.parquet"]).num_rows == 0


def test_floats_are_kept_to_the_last_digit(
    make_session: Callable[..., SessionRecord], make_steps: Callable[..., pa.Table]
):
    """Compression and encoding lose nothing."""
    steps = make_steps(200, np.random.default_rng(5))
    session = make_session(1, laps=1)
    files = encode(replace(session, laps=(RecordedLap(session.laps[0].row, steps),)))
    written = _read(files["steps-0.parquet"])["segment_07"].to_numpy()
    assert np.array_equal(written, steps["segment_07"].to_numpy())
