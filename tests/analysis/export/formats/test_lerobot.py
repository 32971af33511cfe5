"""The LeRobot dataset."""

import json
import shutil

import numpy as np
import pandas as pd
import pyarrow.parquet as pq
import pytest

from analysis.export.formats import lerobot
from analysis.export.formats.lerobot import frames_per_second
from analysis.export.frames import VECTORS
from analysis.export.write import export_study
from protocols.files.errors import InputError


def test_the_fields_own_checker_accepts_it(exported, checker):
    """`lerobot-doctor check`: no failure."""
    ended = checker("lerobot-doctor", "check", exported("lerobot"), "--ci")
    assert ended.returncode == 0, ended.stdout
    assert json.loads(ended.stdout)["summary"]["FAIL"] == 0


def _drop_frames(folder):
    path = folder / "data" / "chunk-000" / "file-000.parquet"
    table = pq.read_table(path)
    pq.write_table(table.slice(0, len(table) - 50), path)


def _no_number(folder):
    path = folder / "data" / "chunk-000" / "file-000.parquet"
    table = pq.read_table(path)
    commands = np.stack(table["action"].to_pylist())
    commands[5] = np.nan
    at = table.column_names.index("action")
    pq.write_table(table.set_column(at, "action", [commands.tolist()]), path)


@pytest.mark.parametrize("damage", [_drop_frames, _no_number])
def test_a_damaged_copy_is_refused(damage, exported, checker, tmp_path):
    """Frames are missing, or a command is no number."""
    copied = shutil.copytree(exported("lerobot"), tmp_path / "copy")
    damage(copied)
    ended = checker("lerobot-doctor", "check", copied, "--ci")
    assert json.loads(ended.stdout)["summary"]["FAIL"] > 0


def test_values_are_the_sources(exported, study):
    """Every vector of every frame, to a float's precision; 0 with a mask where none was recorded.

    The format's own reader loads damaged copies without a word, so the values are compared.
    """
    folder = exported("lerobot")
    data = pq.read_table(folder / "data" / "chunk-000" / "file-000.parquet").to_pandas()
    episodes = pq.read_table(folder / "meta" / "episodes" / "chunk-000" / "file-000.parquet")
    assert len(episodes) == len(study.laps)
    for episode in episodes.to_pylist():
        steps = study.steps(episode["participant"], episode["lap"]).to_pandas()
        frames = data[data["episode_index"] == episode["episode_index"]]
        assert len(frames) == len(steps) == episode["length"]
        assert episode["dataset_to_index"] - episode["dataset_from_index"] == len(steps)
        for name, parts in VECTORS.items():
            found = np.stack(frames[name].to_list())
            wanted = steps[list(parts)].to_numpy(dtype=float)
            there = np.isfinite(wanted)
            np.testing.assert_allclose(found, np.where(there, wanted, 0.0), rtol=1e-6, atol=1e-6)
            if f"{name}.given" in frames:
                assert frames[f"{name}.given"].tolist() == there.all(axis=1).tolist()
        exact = (np.arange(len(steps)) / 10).astype(np.float32)
        assert frames["timestamp"].to_numpy().tolist() == exact.tolist()


def test_statistics_are_those_of_all_frames(exported):
    """Added up lap by lap, they equal numpy's over everything."""
    folder = exported("lerobot")
    stats = json.loads((folder / "meta" / "stats.json").read_text())
    data = pd.read_parquet(folder / "data" / "chunk-000" / "file-000.parquet")
    for name in ("action", "observation.state"):
        values = np.stack(data[name].to_list()).astype(np.float64)
        np.testing.assert_allclose(stats[name]["mean"], values.mean(axis=0), atol=1e-9)
        np.testing.assert_allclose(stats[name]["std"], values.std(axis=0), atol=1e-9)
        np.testing.assert_allclose(stats[name]["max"], values.max(axis=0))
        assert stats[name]["count"] == [len(values)]


def test_many_laps_are_few_parts(study, tmp_path, monkeypatch):
    """A part holds many laps: what a file's writer keeps of each does not fill the memory."""
    monkeypatch.setattr(lerobot, "FRAMES_PER_PART", 2000)
    export_study(study.folder, "lerobot", tmp_path / "out")
    data = pq.ParquetFile(tmp_path / "out" / "data" / "chunk-000" / "file-000.parquet")
    parts = [data.metadata.row_group(i).num_rows for i in range(data.num_row_groups)]
    longest = max(study.laps["steps"].to_pylist())
    assert all(2000 <= part < 2000 + longest for part in parts[:-1])
    assert 1 < len(parts) < len(study.laps) / 2


def test_steps_that_are_no_frames_a_second_are_refused():
    """The format knows whole numbers only."""
    with pytest.raises(InputError, match=r"control steps of 0\.15 s"):
        frames_per_second(0.15)
