"""One person's id, written twice."""

import unicodedata

import pyarrow as pa
import pytest

from protocols.record.elsewhere.folders import folders_by_person, lap_shift
from protocols.record.elsewhere.people import probably, strangers, with_known_ids

NFD = unicodedata.normalize("NFD", "Ren\u00e9")


def test_what_nobody_sees_is_no_difference():
    """Blanks around an id, and letters with marks as one or two characters."""
    table = pa.table({"participant": [" 01", NFD, "02", "x"]})
    mended, rows = with_known_ids(table, ["01", "02", "Ren\u00e9"])
    assert mended["participant"].to_pylist() == ["01", "Ren\u00e9", "02", "x"]
    assert rows == 2


def test_two_people_who_look_alike_are_not_joined():
    """Where two known ids would do, neither is taken."""
    table = pa.table({"participant": ["01 "]})
    assert with_known_ids(table, ["01", " 01"]) == (table, 0)


@pytest.mark.parametrize(
    ("given", "known", "meant"),
    [("sub-01", ["01", "02"], "01"), ("1", ["001", "002"], "001"), ("P7", ["p07"], "p07"),
     ("VP_003", ["3", "13"], "3"), ("ann", ["Ann", "Bea"], "Ann"), ("x", ["1"], None),
     ("1", ["01", "001"], None)],
)  # fmt: skip
def test_a_guess_is_made_only_where_one_will_do(given, known, meant):
    """Who may be meant; None where it may be nobody or several."""
    assert probably(given, known) == meant


def test_strangers_are_counted_and_few_are_named():
    """Rows, and at most five names."""
    n, names = strangers([f"s{i}" for i in range(9)] * 2, ["1"])
    assert n == 18
    assert names.endswith("... (9 in all)")
    assert "s1 (1?)" in names


def test_folders_find_their_people(tmp_path):
    """By their own name first; else by the only one that looks like it."""
    for name in ("01", NFD):
        (tmp_path / name).mkdir()
    found = folders_by_person(tmp_path.iterdir(), ["01", "Ren\u00e9", "02"])
    assert {who: path.name for who, path in found.items()} == {"01": "01", "Ren\u00e9": NFD}


def test_step_tables_from_0_of_laps_from_1_are_shifted_only_where_all_are(tmp_path):
    """One participant with a table of the last lap's own number, and nothing is moved."""
    for who, numbers in {"a": (0, 1, 2), "b": (0, 1, 2)}.items():
        (tmp_path / who).mkdir()
        for n in numbers:
            (tmp_path / who / f"steps-{n}.parquet").touch()
    laps = {tmp_path / "a": [1, 2, 3], tmp_path / "b": [1, 2, 3]}
    assert lap_shift(laps) == 1
    (tmp_path / "b" / "steps-3.parquet").touch()
    assert lap_shift(laps) == 0
