"""The BIDS dataset."""

import json
import shutil

import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from analysis.export.formats.bids import CHANNELS
from analysis.export.write import export_study


def accepted(checker, folder):
    """Tell whether the checker has no error, and what it says."""
    ended = checker("bids-validator-deno", folder, "--ignoreWarnings", "--max-rows", "-1")
    return ended.returncode == 0, ended.stdout


def test_the_fields_own_checker_accepts_it(exported, checker):
    """`bids-validator`: no error."""
    good, said = accepted(checker, exported("bids"))
    assert good, said


def _drop_a_column(folder):
    path = next(folder.rglob("*_motion.tsv"))
    rows = [line.split("\t")[:-1] for line in path.read_text().splitlines()]
    path.write_text("\n".join("\t".join(row) for row in rows) + "\n")


def _drop_a_sidecar(folder):
    next(folder.rglob("*_motion.json")).unlink()


@pytest.mark.parametrize("damage", [_drop_a_column, _drop_a_sidecar])
def test_a_damaged_copy_is_refused(damage, exported, checker, tmp_path):
    """A column that the list of channels has is missing, or a description."""
    copied = shutil.copytree(exported("bids"), tmp_path / "copy")
    damage(copied)
    good, said = accepted(checker, copied)
    assert not good, said


def test_answers_about_the_whole_session_have_a_column(make_study, tmp_path):
    """Their lap is -1 in the record; the column says session."""
    study = make_study(participants=2)
    surveys = study.surveys
    place = surveys.schema.get_field_index("lap")
    laps = [-1 if lap == 4 else lap for lap in surveys["lap"].to_pylist()]
    changed = surveys.set_column(place, surveys.schema.field(place), pa.array(laps, pa.int16()))
    pq.write_table(changed, study.folder / "surveys.parquet")
    export_study(study.folder, "bids", tmp_path / "out")
    found = pd.read_csv(tmp_path / "out" / "phenotype" / "drivingassistance.tsv", sep="\t")
    assert "session_Q5" in found
    assert not [name for name in found if "-1" in name]


def test_no_file_is_missing(exported, study):
    """The checker does not count files: a recording, its channels and its description per lap."""
    folder = exported("bids")
    for kind in ("motion.tsv", "channels.tsv", "motion.json"):
        assert len(list(folder.rglob(f"*_{kind}"))) == len(study.laps), kind


def test_values_are_the_sources(exported, study, read_exactly):
    """Every channel of every step, and the state after the last one."""
    folder = exported("bids")
    for lap in study.laps.to_pylist():
        pattern = f"sub-{lap['participant']}_*_run-{lap['lap']}_motion.tsv"
        (path,) = (folder / f"sub-{lap['participant']}" / "motion").glob(pattern)
        names = pd.read_csv(
            path.with_name(path.name.replace("motion.tsv", "channels.tsv")), sep="\t"
        )["name"].tolist()
        found = read_exactly(path, sep="\t", header=None, names=names, na_values="n/a")
        steps = study.steps(lap["participant"], lap["lap"]).to_pandas()
        assert names == [channel.column for channel in CHANNELS]
        np.testing.assert_array_equal(
            found[names].iloc[:-1].to_numpy(dtype=float), steps[names].to_numpy(dtype=float)
        )
        assert found["velocity_v"].iloc[-1] == steps["result_v"].iloc[-1]


def test_answers_are_the_sources(exported, study):
    """A column per lap and item, with its wording and the labels of its points."""
    path = exported("bids") / "phenotype" / "drivingassistance.tsv"
    found = pd.read_csv(path, sep="\t", na_values="n/a").set_index("participant_id")
    for row in study.surveys.to_pylist():
        answer = found.loc[f"sub-{row['participant']}", f"lap{row['lap']}_{row['item']}"]
        assert answer == row["response"] or (np.isnan(answer) and row["response"] is None)
    about = json.loads(path.with_suffix(".json").read_text())
    assert set(found.columns) < set(about)
    assert about["lap1_Q1"]["Levels"]["1"]
