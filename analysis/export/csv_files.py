"""The tables of a study as CSV files: the same for every format that holds such files."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from analysis.export.content import Content, Table
from analysis.export.delimited import CSV, Dialect, header_line, lines, write_table, zipped
from analysis.export.field import Field
from analysis.export.registry import Tell

STEPS_FILE = "steps.csv.gz"


class CsvFile(NamedTuple):
    """A written file and what its columns are."""

    name: str
    path: str
    fields: tuple[Field, ...]
    key: tuple[str, ...]
    description: str


def small_tables(content: Content) -> tuple[Table, ...]:
    """Return every table but the steps, those without a row left out."""
    tables = (content.participants, content.laps, content.surveys, content.items)
    return tuple(table for table in tables if len(table.rows))


def write_csv_files(
    content: Content, folder: Path, tell: Tell, dialect: Dialect = CSV
) -> tuple[CsvFile, ...]:
    """Write every table: the steps of all laps as one compressed file, lap after lap."""
    return tuple(_written(content, folder, tell, dialect))


def _written(content: Content, folder: Path, tell: Tell, dialect: Dialect) -> Iterator[CsvFile]:
    for table in small_tables(content):
        path = f"{table.name}.csv"
        write_table(folder / path, table.rows, dialect)
        yield CsvFile(table.name, path, table.fields, table.key, table.description)
    if write_steps(content, folder / STEPS_FILE, tell, dialect):
        yield CsvFile(
            "steps",
            STEPS_FILE,
            content.step_fields,
            ("participant", "lap", "step"),
            "One row per control step",
        )


def write_steps(content: Content, path: Path, tell: Tell, dialect: Dialect) -> int:
    """Write every recorded lap's steps into one compressed file; return how many laps."""
    laps = 0
    with zipped(path) as stream:
        stream.write(header_line([f.name for f in content.step_fields], dialect))
        for lap, steps in content.laps_with_steps():
            tell(f"Steps of {lap['participant']}, lap {lap['lap']}")
            stream.write(lines(steps, dialect))
            laps += 1
    if not laps:
        path.unlink()
    return laps
