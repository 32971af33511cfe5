"""Collecting a lap's steps."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.inputs import INPUT_NAMES
from protocols.record.recorder import StepRecorder
from protocols.record.steps import STEP_COLUMNS, STEP_SCHEMA

_NUMBER = st.floats(allow_nan=False, allow_infinity=False, width=64)
_BY_TYPE = {
    pa.float64(): _NUMBER,
    pa.int8(): st.sampled_from([-1, 1]),
    pa.int16(): st.integers(0, 2**15 - 1),
    pa.int32(): st.integers(0, 2**31 - 1),
    pa.bool_(): st.booleans(),
    pa.string(): st.text(st.characters(exclude_categories=("Cs",)), max_size=5),
}
_STREAMS = st.fixed_dictionaries(
    {c.name: _BY_TYPE[c.type] | st.none() if c.nullable else _BY_TYPE[c.type]
     for c in STEP_COLUMNS if c.name not in INPUT_NAMES}
)  # fmt: skip
_STEP = st.tuples(st.lists(_NUMBER, min_size=19, max_size=19), _STREAMS)


@given(st.lists(_STEP, max_size=4))
def test_every_value_of_every_step_is_kept(steps: list[tuple[list[float], dict[str, Any]]]):
    """What goes in comes out, missing values included, in the schema's columns and types."""
    recorder = StepRecorder()
    for x, streams in steps:
        recorder.append(np.array(x), **streams)
    table = recorder.table()
    assert table.schema.equals(STEP_SCHEMA)
    assert len(recorder) == table.num_rows == len(steps)
    rows = [dict(zip(INPUT_NAMES, x, strict=True)) | streams for x, streams in steps]
    assert table.to_pylist() == [{name: row[name] for name in STEP_SCHEMA.names} for row in rows]


def test_inputs_are_copied(make_steps: Callable[..., pa.Table]):
    """A caller may reuse its array of inputs for the next step."""
    streams = make_steps(1, np.random.default_rng(0)).to_pylist()[0]
    for name in INPUT_NAMES:
        del streams[name]
    recorder, x = StepRecorder(), np.zeros(19)
    recorder.append(x, **streams)
    x[:] = 1
    recorder.append(x, **streams)
    assert recorder.table()["user_v"].to_pylist() == [0.0, 1.0]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"x_m": None}, "column x_m: missing in step 0"),
        ({"x_m": float("nan")}, "column x_m: 1 values are not finite"),
        ({"p_help": float("inf")}, "column p_help: 1 values are not finite"),
        ({"speed": 1.0}, "step 0 has unknown columns: speed"),
        ({"contact": "yes"}, "column contact:"),
        ({"h_would": 300}, "column h_would:"),
    ],
)
def test_a_wrong_value_names_its_column(
    make_steps: Callable[..., pa.Table], change: dict[str, Any], message: str
):
    """Nothing wrong gets into the record, and the error says which column it was."""
    streams = make_steps(1, np.random.default_rng(0)).to_pylist()[0]
    for name in INPUT_NAMES:
        del streams[name]
    recorder = StepRecorder()
    recorder.append(np.zeros(19), **(streams | change))
    with pytest.raises(ValueError, match=message):
        recorder.table()


def test_a_forgotten_stream_is_named():
    """A step that lacks a stream is refused by name."""
    recorder = StepRecorder()
    recorder.append(np.zeros(19), step=0)
    with pytest.raises(ValueError, match="step 0 lacks arbitrated_v, "):
        recorder.table()
