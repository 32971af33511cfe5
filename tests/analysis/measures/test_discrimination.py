"""When-AUC and Brier score."""

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sklearn.metrics import brier_score_loss, roc_auc_score

from analysis.measures.discrimination import brier_score, when_auc
from analysis.measures.streams import Steps


def lap(p, h):
    """Return steps with predictions and the demonstrator's wish."""
    return Steps(pa.table({"t_s": np.arange(len(p)) * 0.1, "p_help": p, "h_would": h}))


@given(
    st.lists(st.tuples(st.integers(0, 10), st.booleans()), min_size=2, max_size=80).filter(
        lambda pairs: 0 < sum(h for _, h in pairs) < len(pairs)
    )
)
def test_both_agree_with_an_independent_library(pairs):
    """AUC (ties included) and Brier score equal scikit-learn's."""
    p = np.array([score / 10 for score, _ in pairs])
    h = np.array([1 if positive else -1 for _, positive in pairs])
    assert when_auc(lap(p, h)) == pytest.approx(roc_auc_score(h > 0, p))
    assert brier_score(lap(p, h)) == pytest.approx(brier_score_loss(h > 0, p))


def test_steps_without_a_prediction_are_left_out():
    """A missing p is no prediction of anything."""
    frame = lap([0.9, np.nan, 0.1], [1, 1, -1])
    assert when_auc(frame) == 1.0
    assert brier_score(frame) == pytest.approx(0.01)


def test_one_class_alone_has_no_auc():
    """Where the demonstrator would never help there is nothing to tell apart."""
    assert np.isnan(when_auc(lap([0.1, 0.2], [-1, -1])))
    assert brier_score(lap([0.1, 0.2], [-1, -1])) == pytest.approx(0.025)
