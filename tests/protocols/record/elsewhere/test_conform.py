"""Tables that somebody else wrote become ours."""

from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from protocols.files.errors import InputError
from protocols.record.elsewhere.conform import conform
from protocols.record.elsewhere.rules import LAPS, PARTICIPANTS, STEPS, SURVEYS

_PATH = Path("laps.parquet")
_LAPS = {
    "participant": ["A", "A", "B"],
    "lap": [0, 1, 0],
    "condition": ["baseline", "limited", "baseline"],
    "completed": [True, False, True],
    "lap_time_s": [40.0, None, 42],
}


def _laps(**columns: object) -> pa.Table:
    return pa.Table.from_pandas(pd.DataFrame({**_LAPS, **columns}), preserve_index=False)


def test_minimal_laps_get_all_columns():
    """Five columns from pandas become the lap table: our order and types, the rest missing."""
    table = conform(_laps(), LAPS, _PATH).table
    assert table.column_names == [c.name for c in LAPS.columns]
    assert [f.type for f in table.schema] == [c.type for c in LAPS.columns]
    assert table["lap_time_s"].to_pylist() == [40, None, 42]
    assert table["practice"].null_count == table["collisions"].null_count == 3


def test_columns_of_ones_own_are_kept():
    """What we don't know stays, after what we do."""
    assert conform(_laps(mood=["a", "b", "c"]), LAPS, _PATH).table.column_names[-1] == "mood"


def test_gaps_as_pandas_writes_them_are_missing_values():
    """Integers with gaps come as floats with NaN; they become integers with missing values."""
    table = conform(_laps(collisions=[0.0, float("nan"), 2.0]), LAPS, _PATH).table
    assert table["collisions"].to_pylist() == [0, None, 2]


def test_an_unfinished_lap_may_have_nan_for_its_time():
    """Writers other than pandas leave NaN where a number is missing; that is no wrong time."""
    laps = _laps().set_column(4, "lap_time_s", pa.array([40.0, float("nan"), 42.0]))
    assert len(conform(laps, LAPS, _PATH).table) == 3


def test_categories_become_text():
    """A categorical column of pandas is text to us."""
    table = conform(_laps(condition=pd.Categorical(_LAPS["condition"])), LAPS, _PATH).table
    assert table["condition"].to_pylist() == _LAPS["condition"]


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (_laps().drop(["condition"]), "laps.parquet: column condition is missing; required: part"),
        (_laps(lap=["a", "b", "c"]), "column lap is .*; allowed: int16"),
        (_laps(lap=[0.5, 1, 2]), "column lap is double; allowed: int16"),
        (_laps(lap=[0, 1, 99999]), "column lap is int64; allowed: int16"),
        (_laps(completed=["yes", "no", "maybe"]), "column completed is .*; allowed: bool"),
        (_laps(condition=["a", None, "b"]), "column condition: missing in row 1; it must be given"),
        (_laps(lap_time_s=[40.0, None, -4.0]), "lap_time_s: -4.0 in row 2; allowed: above 0"),
        (_laps(lap_time_s=[0.0, None, 42.0]), "lap_time_s: 0.0 in row 0; allowed: above 0"),
        (_laps(lap_time_s=[4.0, np.inf, 4.0]), "lap_time_s: inf in row 1; allowed: above 0"),
        (_laps(lap=[0, 0, 0]), "laps.parquet: 2 rows of participant A, lap 0; allowed: one"),
    ],
)
def test_what_cannot_be_used_is_named(table: pa.Table, message: str):
    """A missing column, a wrong type, value or row is told in one line."""
    with pytest.raises(InputError, match=message) as caught:
        conform(table, LAPS, _PATH)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("rules", [PARTICIPANTS, LAPS, SURVEYS, STEPS])
def test_our_own_tables_pass_unchanged(rules):
    """A table of this version's schema comes back as it is."""
    schema = pa.schema([pa.field(c.name, c.type, nullable=c.nullable) for c in rules.columns])
    assert conform(schema.empty_table(), rules, _PATH).table.schema.equals(schema)


@pytest.mark.parametrize("gap", [None, float("nan")])
def test_a_measurement_may_be_missing(gap):
    """A null and a NaN in a required column of floats are the same gap."""
    steps = pa.table({"t_s": [0.0, 0.1], "x_m": pa.array([1.0, gap]), "y_m": [0.0, 0.0]})
    x = conform(steps, STEPS, _PATH).table["x_m"].to_pandas()
    assert x[0] == 1.0
    assert np.isnan(x[1])
