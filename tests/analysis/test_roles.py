"""What part each condition plays."""

from analysis.roles import condition_roles, first, reference_condition
from protocols.load import load_protocol


def test_the_four_laps_have_their_parts():
    """Baseline, limited, demonstrator and model follow from the conditions' settings."""
    parts = condition_roles(load_protocol("four-lap"))
    assert [p.role for p in parts] == ["baseline", "limited", "demonstrator", "model"]
    assert [p.demonstrations for p in parts] == [0, 0, 0, 1]
    assert [p.taught for p in parts] == [False, False, True, True]
    assert first(parts, "model") == "model-assisted"
    assert reference_condition(parts) == "limited"


def test_without_a_limitation_the_baseline_is_the_yardstick():
    """Speedups need something to be measured from."""
    parts = tuple(p for p in condition_roles(load_protocol("four-lap")) if p.role != "limited")
    assert reference_condition(parts) == "baseline"
    assert reference_condition(()) is None
