"""The Psych-DS dataset. Its checker is in no registry: the rules are checked here."""

import json
import re
import shutil

import pandas as pd
import pytest

NAME = re.compile(r"^([a-z]+-[A-Za-z0-9]+)(_[a-z]+-[A-Za-z0-9]+)*_data\.csv$")


def faults(folder):
    """Return what breaks the rules: names, undeclared columns, declared ones that are nowhere."""
    description = json.loads((folder / "dataset_description.json").read_text())
    found = [
        f"lacks {field}"
        for field in ("@context", "@type", "name", "description", "variableMeasured")
        if field not in description
    ]
    declared = {variable["name"] for variable in description["variableMeasured"]}
    seen = set()
    for path in (folder / "data").rglob("*.*"):
        if not NAME.match(path.name):
            found.append(f"{path.name} is no data file")
            continue
        seen |= set(pd.read_csv(path, nrows=0).columns)
    found += [f"{name} is not declared" for name in sorted(seen - declared)]
    return found + [f"{name} is nowhere" for name in sorted(declared - seen)]


def test_names_and_columns_keep_the_rules(exported):
    """Every file is one that the format reads, and every column is declared."""
    assert faults(exported("psych-ds")) == []


def _rename(folder):
    path = next((folder / "data" / "steps").iterdir())
    path.rename(path.with_name("steps.csv"))


def _add_a_column(folder):
    path = next((folder / "data").glob("*laps*"))
    path.write_text(path.read_text().replace("participant,lap", "participant,round", 1))


@pytest.mark.parametrize("damage", [_rename, _add_a_column])
def test_a_damaged_copy_is_refused(damage, exported, tmp_path):
    """A name that tools would pass over in silence, or a column nobody declared."""
    copied = shutil.copytree(exported("psych-ds"), tmp_path / "copy")
    damage(copied)
    assert faults(copied)


def test_there_is_a_file_for_every_lap_with_its_values(exported, study, read_exactly):
    """As many as there are laps, and the recorded numbers in them."""
    steps = exported("psych-ds") / "data" / "steps"
    assert len(list(steps.iterdir())) == len(study.laps)
    read = read_exactly(steps / "subject-P0002_trial-3_description-steps_data.csv")
    source = study.steps("P0002", 3).to_pandas()
    assert read["x_m"].tolist() == source["x_m"].tolist()
    assert read["h"].tolist() == source["h"].tolist()
