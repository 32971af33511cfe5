"""What holds for every measure."""

import numpy as np
import pyarrow as pa
import pytest

from analysis.measures.registry import MEASURES, measure
from analysis.measures.streams import Steps
from protocols.record.steps import STEP_COLUMNS


@pytest.mark.parametrize("m", MEASURES, ids=lambda m: m.name)
def test_a_measure_of_a_recorded_lap_is_one_number(m, steps):
    """On a lap in which the model helped, every measure is a finite number."""
    assert np.isfinite(m.of(Steps(pa.table(steps))))


@pytest.mark.parametrize("m", MEASURES, ids=lambda m: m.name)
def test_a_measure_without_its_columns_is_missing_or_needs_only_the_minimum(m, steps):
    """With nothing but time and position, a measure is NaN unless it needs no more than that."""
    least = Steps(pa.table({name: steps[name] for name in ("t_s", "x_m", "y_m")}))
    computable = m.name in ("driving_time_s", "path_length_m")
    assert np.isfinite(m.of(least)) == computable


@pytest.mark.parametrize("m", MEASURES, ids=lambda m: m.name)
def test_a_measure_of_empty_columns_is_missing(m, steps):
    """A study recorded elsewhere: columns are there, and nothing is in them."""
    columns = {c.name: pa.nulls(5, c.type) for c in STEP_COLUMNS}
    columns |= {"t_s": np.arange(5) * 0.1, "x_m": np.zeros(5), "y_m": np.zeros(5)}
    assert np.isnan(m.of(Steps(pa.table(columns)))) or m.name in ("driving_time_s", "path_length_m")


@pytest.mark.parametrize("m", MEASURES, ids=lambda m: m.name)
@pytest.mark.parametrize("n", [0, 1])
def test_a_measure_of_hardly_any_steps_does_not_break(m, n, steps):
    """A lap cut short at its start gives a number or NaN, never an error."""
    assert isinstance(m.of(Steps(pa.table(steps).slice(0, n))), float)


@pytest.mark.parametrize("m", MEASURES, ids=lambda m: m.name)
def test_a_measure_leaves_the_steps_alone(m, steps):
    """Measuring changes nothing: measures can be computed in any order."""
    before = {name: values.copy() for name, values in steps.items()}
    together, alone = Steps(pa.table(steps)), Steps(pa.table(steps))
    for other in reversed(MEASURES):
        other.of(together)
    np.testing.assert_array_equal(m.of(together), m.of(alone))
    np.testing.assert_equal(steps, before)


def test_an_unknown_measure_is_a_key_error():
    """Asking for a measure that does not exist fails at once."""
    with pytest.raises(KeyError):
        measure("happiness")


def test_names_are_unique():
    """No two measures write into one column."""
    assert len({m.name for m in MEASURES}) == len(MEASURES)
