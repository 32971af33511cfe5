"""Measure the memory that exports take: ``python bench/export_memory.py STUDY --people 20 1000``.

A study of many is made of a small one: its sessions again and again under new names, their step
tables cut to the first ``--steps`` rows. Every format writes it in a process of its own, whose
largest resident memory is printed.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq

from analysis.export.registry import SHIPPED
from protocols.record.reader import Study, open_study
from protocols.record.rows import participant_id

# Linux counts the parent's memory in a child's ``ru_maxrss``; VmHWM begins anew with the program.
EXPORT = """
import sys
from pathlib import Path
from analysis.export.write import export_study
export_study(Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]))
print(Path("/proc/self/status").read_text().partition("VmHWM:")[2].split()[0])
"""


def repeated(source: Study, people: int, steps: int, folder: Path) -> None:
    """Write a study of many people: the sessions of a small one in turn, under new names.

    Parameters
    ----------
    source
        The small study.
    people
        How many participants to write.
    steps
        How many steps of each lap to keep.
    folder
        Folder to make.
    """
    (folder / "sessions").mkdir(parents=True)
    shutil.copy(source.folder / "study.yaml", folder)
    names = source.sessions()[:people]
    ours = [(participant_id(i + 1), names[i % len(names)]) for i in range(people)]
    tables = {"participants": source.participants, "laps": source.laps, "surveys": source.surveys}
    for name, table in tables.items():
        parts = {one: table.filter(pc.equal(table["participant"], one)) for one in names}
        rows = pa.concat_tables([_renamed(parts[one], new) for new, one in ours])
        pq.write_table(rows, folder / f"{name}.parquet")
    with tempfile.TemporaryDirectory(dir=folder) as cut_folder:
        cut = {one: list(_cut(source, one, steps, Path(cut_folder) / one)) for one in names}
        for new, one in ours:
            (folder / "sessions" / new).mkdir()
            for path in cut[one]:
                os.link(path, folder / "sessions" / new / path.name)


def _renamed(table: pa.Table, participant: str) -> pa.Table:
    at = table.schema.get_field_index("participant")
    field = table.schema.field(at)
    return table.set_column(at, field, pa.repeat(pa.scalar(participant, field.type), len(table)))


def _cut(source: Study, participant: str, steps: int, folder: Path) -> Iterator[Path]:
    folder.mkdir()
    for path in sorted((source.folder / "sessions" / participant).glob("steps-*.parquet")):
        pq.write_table(pq.read_table(path).slice(0, steps), folder / path.name)
        yield folder / path.name


def peak_mb(study: Path, name: str, out: Path) -> float:
    """Return the largest resident memory of an export in a process of its own, MB."""
    ended = subprocess.run(  # noqa: S603  # our own code
        [sys.executable, "-c", EXPORT, study, name, out],
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    return float(ended.stdout) / 1024


def main() -> None:
    """Print a row for each format and size."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", type=Path)
    parser.add_argument("--people", type=int, nargs="+", default=[20, 1000])
    parser.add_argument("--steps", type=int, default=60)
    parser.add_argument("--formats", nargs="+", default=list(SHIPPED))
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for people in arguments.people:
            many = Path(folder) / f"people{people}"
            repeated(open_study(arguments.study), people, arguments.steps, many)
            for name in arguments.formats:
                begun = time.perf_counter()
                peak = peak_mb(many, name, Path(folder) / "out")
                took = time.perf_counter() - begun
                print(f"{people} people, {name}: {peak:.0f} MB, {took:.0f} s", flush=True)
                shutil.rmtree(Path(folder) / "out")


if __name__ == "__main__":
    main()
