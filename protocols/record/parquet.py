"""Parquet the way this project writes and reads it."""

import io
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from protocols.files.errors import InputError


def parquet_settings(schema: pa.Schema) -> dict[str, Any]:
    """Return how a table is written: everything that changes the bytes, so no default can.

    Measured floats hardly repeat: a dictionary makes them larger. Sorting their bytes by place
    before compression makes them a fifth smaller.
    """
    floats = [field.name for field in schema if pa.types.is_floating(field.type)]
    return {
        "compression": "zstd",
        "compression_level": 3,
        "version": "2.6",
        "data_page_version": "1.0",
        "write_page_checksum": True,
        "use_dictionary": [field.name for field in schema if field.name not in floats],
        "use_byte_stream_split": floats,
    }


def parquet_bytes(table: pa.Table) -> bytes:
    """Return a table as a Parquet file's content; the same table gives the same bytes."""
    sink = io.BytesIO()
    pq.write_table(
        table.combine_chunks(), sink, row_group_size=1 << 20, **parquet_settings(table.schema)
    )
    return sink.getvalue()


def parquet_shape(path: Path) -> tuple[pa.Schema, int]:
    """Return a Parquet file's columns and its number of rows, without reading them.

    Raises
    ------
    InputError
        When the file is missing or damaged; names it.
    """
    with _readable(path) as file:
        return file.schema_arrow, file.metadata.num_rows


def read_parquet(path: Path, columns: Sequence[str] | None = None) -> pa.Table:
    """Return a Parquet file's table.

    Parameters
    ----------
    path
        The file.
    columns
        Those to read, in this order, of those that are there; None for all.

    Raises
    ------
    InputError
        When the file is missing or damaged; names it.
    """
    with _readable(path) as file:
        if columns is not None:
            there = file.schema_arrow.names
            columns = [c for c in columns if c in there]
        # Threads cost more than they save in tables of a few hundred rows; there are thousands.
        return file.read(columns=columns, use_threads=False)


@contextmanager
def _readable(path: Path) -> Iterator[pq.ParquetFile]:
    """Open a Parquet file; every error while it is open is reported as the file's fault."""
    try:
        with pq.ParquetFile(path, page_checksum_verification=True) as file:
            _refuse_absurd(path, file.metadata)
            yield file
    except FileNotFoundError:
        raise InputError(f"{path}: no such file") from None
    except (pa.ArrowException, OSError, ValueError, MemoryError) as error:
        reason = str(error).partition("\n")[0].rstrip(".")
        raise InputError(f"{path}: not a readable Parquet file: {reason}") from None


MAX_ROWS, MAX_COLUMNS, MAX_BYTES = 10_000_000, 2_000, 4_000_000_000
"""What no table of a study comes near: a few bytes may claim to stand for any number of rows."""


def _refuse_absurd(path: Path, about: pq.FileMetaData) -> None:
    """Refuse a table that no memory holds, before any of it is read."""
    size = sum(about.row_group(i).total_byte_size for i in range(about.num_row_groups))
    for what, found, most in (
        ("rows", about.num_rows, MAX_ROWS),
        ("columns", about.num_columns, MAX_COLUMNS),
        ("bytes when unpacked", size, MAX_BYTES),
    ):
        if not 0 <= found <= most:
            raise InputError(f"{path}: says it has {found} {what}; allowed: up to {most}")
