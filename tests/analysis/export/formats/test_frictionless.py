"""The Frictionless data package."""

import json
import shutil

import pandas as pd
import pytest

from protocols.record.codebook import TABLES


@pytest.mark.slow
def test_the_fields_own_checker_accepts_it(exported, checker):
    """`frictionless validate`: keys, references, types and limits of every row."""
    ended = checker("frictionless", "validate", exported("frictionless") / "datapackage.json")
    assert ended.returncode == 0, ended.stdout


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "damage", "fault"),
    [
        ("laps.csv", ("finished", "fnished"), "constraint-error"),
        ("laps.csv", ("P0002,3", "P0002,2"), "primary-key"),
        ("laps.csv", ("P0001,1,", "P0099,1,"), "foreign-key"),
        ("participants.csv", ("true", "perhaps"), "type-error"),
    ],
)
def test_a_damaged_copy_is_refused(file, damage, fault, exported, checker, tmp_path):
    """A value out of its list, a row twice, a lap of nobody, a word for a truth value."""
    copied = shutil.copytree(exported("frictionless"), tmp_path / "copy")
    text = (copied / file).read_text()
    assert damage[0] in text
    (copied / file).write_text(text.replace(*damage, 1))
    ended = checker("frictionless", "validate", copied / "datapackage.json", "--json")
    assert ended.returncode != 0
    kinds = [e["type"] for task in json.loads(ended.stdout)["tasks"] for e in task["errors"]]
    assert fault in kinds


def test_values_are_the_sources(exported, study, read_exactly):
    """Every number of every step and lap, read back by pandas, is the recorded one."""
    folder = exported("frictionless")
    steps = read_exactly(folder / "steps.csv.gz")
    for lap in study.laps.to_pylist():
        wanted = study.steps(lap["participant"], lap["lap"]).to_pandas()
        mine = (steps["participant"] == lap["participant"]) & (steps["lap"] == lap["lap"])
        found = steps[mine].drop(columns=["participant", "lap"]).reset_index(drop=True)
        pd.testing.assert_frame_equal(
            found, wanted, check_dtype=False, check_exact=True, check_column_type=False
        )
    laps = read_exactly(folder / "laps.csv", dtype={"seed": "uint64"})
    source = study.laps.to_pandas().sort_values(["participant", "lap"]).reset_index(drop=True)
    for column in ("lap_time_s", "condition", "seed", "assisted_fraction", "collisions"):
        assert laps[column].tolist() == source[column].tolist(), column


def test_answers_are_the_sources(exported, study):
    """In the order in which they were asked."""
    found = pd.read_csv(exported("frictionless") / "surveys.csv")
    source = study.surveys.to_pandas()
    keys = ["participant", "lap", "instrument", "item", "response"]
    assert found[keys].to_numpy().tolist() == source[keys].to_numpy().tolist()


def test_every_column_is_described_as_in_the_codebook(exported):
    """Name, unit and description of the steps' columns."""
    package = json.loads((exported("frictionless") / "datapackage.json").read_text())
    resources = {r["name"]: r["schema"]["fields"] for r in package["resources"]}
    found = [(f["name"], f.get("unit", ""), f["description"]) for f in resources["steps"]]
    wanted = [(c.name, c.unit, c.description) for c in TABLES["steps"]]
    assert found[2:] == wanted


def test_questions_go_with_the_answers(exported, study):
    """Every item that was asked is there with its wording and the labels of its points."""
    items = pd.read_csv(exported("frictionless") / "items.csv")
    asked = set(study.surveys["item"].to_pylist())
    assert asked <= set(items["item"])
    labels = items["labels"].str.split(" | ", regex=False).str.len()
    assert (labels == items["points"]).all()
