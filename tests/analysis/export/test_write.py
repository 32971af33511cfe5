"""An export is there whole or not at all, and the same study gives the same bytes."""

import shutil
import subprocess
import sys

import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from analysis.export import registry
from analysis.export.registry import SHIPPED, format_named, format_names
from analysis.export.write import export_study
from protocols.files.errors import InputError


def contents(folder):
    """Return the files of a folder by name."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


@pytest.mark.parametrize("name", SHIPPED)
def test_the_same_study_gives_the_same_bytes(name, study, exported, tmp_path):
    """Every format, file by file."""
    first = contents(exported(name))
    export_study(study.folder, name, tmp_path / "again" / name)
    assert contents(tmp_path / "again" / name) == first


@pytest.mark.parametrize("name", SHIPPED)
def test_every_format_comes_with_readme_and_licence(name, exported):
    """Who opens a copy learns what it is, what is left out, and what they may do with it."""
    readme = (exported(name) / "README.md").read_text()
    assert "## What is left out" in readme
    assert "exact ages" in readme
    assert "`lap_time_s` (s)" in readme
    assert "CC0-1.0" in (exported(name) / "LICENSE").read_text()


def test_what_is_there_is_not_overwritten(study, tmp_path):
    """One line, and the folder is as it was."""
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mine.txt").write_text("mine")
    with pytest.raises(InputError, match=r"out: is there already; allowed: a new folder"):
        export_study(study.folder, "r", tmp_path / "out")
    assert contents(tmp_path / "out") == {"mine.txt": b"mine"}


def test_nothing_is_left_of_an_export_that_failed(study, tmp_path, monkeypatch):
    """Neither the folder nor a part of it."""

    def fail(content, folder, tell):
        (folder / "half.csv").write_text("a,b")
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("analysis.export.write.format_named", lambda name: fail)
    with pytest.raises(InputError, match="out: cannot be written: No space left on device"):
        export_study(study.folder, "r", tmp_path / "out")
    assert not list(tmp_path.iterdir())


def test_a_step_file_that_is_damaged_is_named(study, tmp_path):
    """The line has the file; nothing is written."""
    copied = shutil.copytree(study.folder, tmp_path / "study")
    (copied / "sessions" / "P0003" / "steps-2.parquet").write_bytes(b"PAR1 nonsense PAR1")
    with pytest.raises(InputError, match=r"P0003/steps-2\.parquet: not a readable Parquet file"):
        export_study(copied, "frictionless", tmp_path / "out")
    assert not (tmp_path / "out").exists()


def _with_gaps(study):
    """Make a study one of another program that recorded neither pose nor time in step 5."""
    head = (study.folder / "study.yaml").read_text()
    changed = head.replace("origin: simulated", "origin: elsewhere")
    (study.folder / "study.yaml").write_text(changed)
    for path in study.folder.rglob("steps-*.parquet"):
        table = pq.read_table(path)
        for name in ("x_m", "t_s", "segment_03", "user_v", "contact", "control"):
            values = table[name].to_pylist()
            values[5] = None
            at = table.schema.get_field_index(name)
            field = pa.field(name, table.schema.field(name).type)
            table = table.set_column(at, field, pa.array(values, field.type))
        pq.write_table(table, path)
    return study.folder


@pytest.mark.parametrize("name", ["bids", "lerobot", "mcap"])
def test_what_other_programs_did_not_record_is_no_number(name, make_study, tmp_path):
    """Missing poses, times and commands stay missing: a mask, no message, n/a."""
    export_study(_with_gaps(make_study(participants=1)), name, tmp_path / "out")
    if name == "lerobot":
        data = pq.read_table(tmp_path / "out" / "data" / "chunk-000" / "file-000.parquet")
        assert data["pose.start.given"][4:7].to_pylist() == [True, False, True]
        assert data["contact.given"][5].as_py() is False
    if name == "bids":
        path = min((tmp_path / "out").rglob("*_motion.tsv"))
        assert path.read_text().splitlines()[5].startswith("n/a\t")


def test_an_unknown_format_is_refused():
    """One line with every format there is."""
    with pytest.raises(InputError, match=r"called 'lerobo'; .*did you mean 'lerobot'"):
        format_named("lerobo")


def test_an_unknown_inclusion_is_refused(study, tmp_path):
    """One line with what can be included."""
    with pytest.raises(
        InputError, match="--include: 'names' is not known; allowed: ages, words, ids"
    ):
        export_study(study.folder, "r", tmp_path / "out", include=frozenset({"names"}))


def test_a_missing_package_is_one_line(monkeypatch):
    """It names the package, and what to install."""
    monkeypatch.setitem(sys.modules, "mcap.writer", None)
    monkeypatch.delitem(sys.modules, SHIPPED["mcap"], raising=False)
    with pytest.raises(InputError, match=r"--format mcap: .*pip install 'lad-study\[exchange\]'"):
        format_named("mcap")


def test_other_peoples_formats_are_found(monkeypatch, study, tmp_path):
    """An entry point of the group is a format like those that ship."""

    class Point:
        name = "count"

        @staticmethod
        def load():
            return lambda content, folder, tell: (folder / "n").write_text(str(len(content.people)))

    monkeypatch.setattr(registry, "entry_points", lambda **_: [Point])
    assert format_names()[-1] == "count"
    export_study(study.folder, "count", tmp_path / "out")
    assert (tmp_path / "out" / "n").read_text() == "6"


# The parent's memory counts in a child's ru_maxrss; VmHWM begins anew with the program.
PEAK = """
import sys
from pathlib import Path
from analysis.export.write import export_study
export_study(Path(sys.argv[1]), sys.argv[2], Path(sys.argv[3]))
print(Path("/proc/self/status").read_text().partition("VmHWM:")[2].split()[0])
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["frictionless", "lerobot"])
def test_memory_does_not_grow_with_the_study(name, write_made_up, tmp_path):
    """Sixty people take hardly more than ten: their steps alone are 30 MB."""
    peaks = []
    for people in (10, 60):
        study = write_made_up(tmp_path / f"study{people}", "four-lap", people)
        out = tmp_path / f"out{people}"
        ended = subprocess.run(  # noqa: S603  # our own code
            [sys.executable, "-c", PEAK, study.folder, name, out],
            capture_output=True,
            text=True,
            check=True,
        )
        peaks.append(int(ended.stdout) / 1024)
    assert peaks[1] - peaks[0] < 15, peaks
