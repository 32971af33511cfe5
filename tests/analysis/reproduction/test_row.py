"""A verdict follows from the numbers of its row, whatever they are."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from analysis.reproduction.row import FIELDS, Row, verdict_of
from analysis.reproduction.tolerances import TOLERANCES, judged

NUMBERS = st.floats(-1e3, 1e3) | st.just(math.nan)
RULES = st.sampled_from(["near paper", "at least", "near zero", "interval near zero"])


def row(**changes):
    """Return a row with some numbers of its own."""
    given_ = {"section": "s", "quantity": "q", "unit": "s", "paper": 10.0, "ours": 10.0, "n": 3,
              "low": 9.0, "high": 11.0, "kind": "predicted"}  # fmt: skip
    return Row(**{**given_, **changes})


@given(NUMBERS, NUMBERS, NUMBERS, st.none() | st.floats(-1e3, 1e3),
       st.none() | st.floats(0.01, 100), RULES)  # fmt: skip
def test_the_verdict_recomputes_from_the_json(ours, low, high, paper, tolerance, rule):
    """Read back from the JSON, a row's numbers give its verdict again."""
    made = row(ours=ours, low=low, high=high, paper=paper, tolerance=tolerance, rule=rule)
    text = json.dumps(made.as_json(), allow_nan=False)
    assert verdict_of(json.loads(text)) == json.loads(text)["verdict"] == made.verdict
    assert (made.verdict == "none") == (tolerance is None)


@given(st.floats(-100, 100), st.floats(0.1, 10), st.floats(0, 3))
def test_near_paper_is_symmetric(paper, tolerance, share):
    """Too much and too little by the same amount get the same verdict."""
    above, below = (
        row(paper=paper, ours=paper + sign * share * tolerance, tolerance=tolerance).verdict
        for sign in (1, -1)
    )
    if not 0.999 < share < 1.001:
        assert above == below == ("holds" if share < 1 else "differs")


def test_at_least_has_no_upper_end():
    """More than the paper's AUC is no difference; less is."""
    rule = {"rule": "at least", "tolerance": 0.0, "paper": 0.95}
    assert row(ours=0.999, **rule).verdict == "holds"
    assert row(ours=0.95, **rule).verdict == "holds"
    assert row(ours=0.9499, **rule).verdict == "differs"


@pytest.mark.parametrize(
    ("quantity", "paper"), [("auc training median", 0.9905), ("auc test median", 0.9881)]
)
def test_the_medians_limit_is_0_985_to_the_last_digit(quantity, paper):
    """0.9905 - 0.0055 is not 0.985 in binary; the verdict does not mind."""
    assert judged(row(quantity=quantity, paper=paper, ours=0.985)).verdict == "holds"
    assert judged(row(quantity=quantity, paper=paper, ours=0.98499)).verdict == "differs"


@pytest.mark.parametrize(
    ("low", "high", "verdict"),
    [(-1.9, 1.9, "holds"), (-2.0, 1.0, "differs"), (0.9, 2.1, "differs"), (-3, -2.5, "differs")],
)
def test_equivalence_needs_the_whole_interval(low, high, verdict):
    """TOST at 2 s passes exactly when the 90% interval lies inside the margin."""
    made = judged(row(quantity="tost model after 3", paper=None, ours=0.0, low=low, high=high))
    assert made.verdict == verdict


def test_a_difference_from_zero_does_not_look_at_the_paper():
    """Within 3 s of the demonstrator is a matter of our laps."""
    quantity = "model after 1 minus demonstrator"
    assert judged(row(quantity=quantity, paper=2.6, ours=-2.9)).verdict == "holds"
    assert judged(row(quantity=quantity, paper=2.6, ours=3.1)).verdict == "differs"


def test_a_number_that_could_not_be_computed_differs():
    """NaN is no success."""
    assert row(ours=math.nan, tolerance=1.0).verdict == "differs"


def test_every_declared_tolerance_is_judged():
    """Each of the three calibrated and five predicted figures gets its tolerance, others none."""
    assert len(TOLERANCES) == 8
    assert all(judged(row(quantity=name)).tolerance is not None for name in TOLERANCES)
    assert judged(row(quantity="rd lap model after 1")).verdict == "none"


def test_the_json_has_the_fields_in_order():
    """The row's fields, and the verdict at the end."""
    assert list(row().as_json()) == [*FIELDS, "verdict"]
