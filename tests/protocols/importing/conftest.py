"""A study that was recorded elsewhere, without answers."""

from collections.abc import Callable
from pathlib import Path

import pyarrow as pa
import pytest

from protocols.load import resolve_study
from protocols.record.header import StudyHeader, write_header
from protocols.record.parquet import parquet_bytes
from protocols.record.reader import Study, open_study


@pytest.fixture
def elsewhere(tmp_path: Path) -> Callable[..., Study]:
    """Return the function that writes a study of some people who drove all laps."""

    def write(*people: str) -> Study:
        study = resolve_study("four-lap", participants=len(people))
        folder = tmp_path / "elsewhere"
        folder.mkdir()
        header = StudyHeader(
            origin="elsewhere",
            protocol=study.protocol,
            instruments=study.instruments,
            course=study.course,
        )
        write_header(folder, header)
        laps = [
            {"participant": who, "lap": lap, "condition": planned.condition, "completed": True,
             "lap_time_s": 40.0 + lap}
            for who in people
            for lap, planned in enumerate(study.protocol.laps)
        ]  # fmt: skip
        tables = {"participants": [{"participant": who} for who in people], "laps": laps}
        for name, rows in tables.items():
            content = parquet_bytes(pa.Table.from_pylist(rows))
            (folder / f"{name}.parquet").write_bytes(content)
        return open_study(folder)

    return write
