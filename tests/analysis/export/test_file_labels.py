"""Two people never share a file, however alike their names are."""

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from analysis.export.file_labels import file_labels
from analysis.export.write import export_study

NAMES = st.lists(st.text(max_size=6) | st.sampled_from(["a1", "A1", "a-1", "a_1", "a1x2", "x", ""]))
ALIKE = {"P0001": "a-1", "P0002": "a1", "P0003": "A_1"}


@given(NAMES)
def test_no_two_names_have_one_label(names):
    """Not even where a file system takes upper and lower case for the same."""
    labels = file_labels(names)
    assert set(labels) == set(names)
    assert len({label.lower() for label in labels.values()}) == len(labels)
    assert all(label.isascii() and label.isalnum() for label in labels.values())


@pytest.mark.parametrize(
    ("name", "pattern"), [("bids", "sub-*/motion/*_motion.tsv"), ("psych-ds", "data/steps/*.csv")]
)
def test_people_with_names_alike_keep_their_laps(name, pattern, make_study, tmp_path):
    """Every lap's file is there, and the README says whose is whose."""
    study = make_study(participants=len(ALIKE))
    for path in study.folder.glob("*.parquet"):
        table = pq.read_table(path)
        people = pa.array([ALIKE[name] for name in table["participant"].to_pylist()])
        place = table.schema.get_field_index("participant")
        pq.write_table(table.set_column(place, table.schema.field(place), people), path)
    for before, after in ALIKE.items():
        (study.folder / "sessions" / before).rename(study.folder / "sessions" / after)
    export_study(study.folder, name, tmp_path / "out")
    written = list((tmp_path / "out").glob(pattern))
    assert len(written) == len(list(study.folder.glob("sessions/*/steps-*.parquet")))
    assert "In file names, participant `A_1` is `" in (tmp_path / "out" / "README.md").read_text()
