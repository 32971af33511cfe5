"""Parquet the way this project writes and reads it."""

from pathlib import Path

import pyarrow as pa
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from protocols.files.errors import InputError
from protocols.record.parquet import parquet_bytes, parquet_shape, read_parquet

_TABLE = pa.table({"a": [1, 2, 3], "b": ["x", None, "z"], "c": [0.1, 0.2, 0.3]})


def test_columns_are_read_in_the_order_asked(tmp_path: Path):
    """Only the columns asked for are read, and absent ones are simply absent."""
    path = tmp_path / "t.parquet"
    path.write_bytes(parquet_bytes(_TABLE))
    assert read_parquet(path).equals(_TABLE)
    assert read_parquet(path, ["c", "a", "nowhere"]).column_names == ["c", "a"]


def test_the_shape_of_a_file_is_that_of_its_table(tmp_path: Path):
    """Columns, types and number of rows."""
    path = tmp_path / "t.parquet"
    path.write_bytes(parquet_bytes(_TABLE))
    schema, rows = parquet_shape(path)
    assert (schema, rows) == (_TABLE.schema, 3)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.integers(0, len(parquet_bytes(_TABLE)) - 1))
def test_a_truncated_file_is_named(tmp_path: Path, size: int):
    """Cut anywhere, the file is refused in one line with its name."""
    path = tmp_path / "t.parquet"
    path.write_bytes(parquet_bytes(_TABLE)[:size])
    with pytest.raises(InputError) as caught:
        read_parquet(path)
    assert str(caught.value).startswith(f"{path}: not a readable Parquet file: ")


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.integers(0, len(parquet_bytes(_TABLE)) - 1), st.integers(1, 255))
def test_a_changed_byte_is_data_or_an_input_error(tmp_path: Path, at: int, change: int):
    """Whatever a damaged file holds, reading ends with a table or with an InputError."""
    content = bytearray(parquet_bytes(_TABLE))
    content[at] ^= change
    path = tmp_path / "t.parquet"
    path.write_bytes(content)
    try:
        table = read_parquet(path)
    except InputError as error:
        table = None
        said = str(error)
    assert table is not None or said.startswith(f"{path}: ")


def test_a_missing_file_or_a_folder_is_named(tmp_path: Path):
    """No file, and a folder in its place, are told in one line."""
    with pytest.raises(InputError, match="no such file"):
        read_parquet(tmp_path / "t.parquet")
    with pytest.raises(InputError, match="not a readable Parquet file"):
        read_parquet(tmp_path)


def test_a_table_of_absurd_dimensions_is_refused_before_it_is_read(tmp_path, monkeypatch):
    """A small file may stand for more rows than memory holds."""
    rows = pa.table({"a": pa.DictionaryArray.from_arrays(pa.array([0] * 1000), ["x"])})
    (tmp_path / "t.parquet").write_bytes(parquet_bytes(rows))
    monkeypatch.setattr("protocols.record.parquet.MAX_ROWS", 999)
    for read in (read_parquet, parquet_shape):
        with pytest.raises(InputError, match=r"says it has 1000 rows; allowed: up to 999"):
            read(tmp_path / "t.parquet")
    monkeypatch.setattr("protocols.record.parquet.MAX_ROWS", 1000)
    assert read_parquet(tmp_path / "t.parquet").num_rows == 1000
    monkeypatch.setattr("protocols.record.parquet.MAX_BYTES", 10)
    with pytest.raises(InputError, match="bytes when unpacked"):
        read_parquet(tmp_path / "t.parquet")
