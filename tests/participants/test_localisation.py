"""Localisation errors have the declared size, and drift."""

import numpy as np
import pytest

from participants.localisation import HEADING_ERROR, PLACE_ERROR, Localisation
from protocols.pose import Pose

HERE = Pose(1.0, 2.0, 3.0)


def errors(period, n, seed=0):
    """Return n estimates' errors, shape (n, 3)."""
    where = Localisation(np.random.default_rng(seed))
    return np.array([where.estimate(i * period, HERE) for i in range(n)]) - HERE


@pytest.mark.parametrize("period", [0.05, 0.5])
def test_errors_have_the_declared_size_at_any_period(period):
    """A few centimetres and about a degree, without bias, however often one asks."""
    found = errors(period, int(6_000 / period))
    assert found.std(axis=0) == pytest.approx([PLACE_ERROR, PLACE_ERROR, HEADING_ERROR], rel=0.1)
    assert np.abs(found.mean(axis=0)).max() < 0.004


def test_errors_drift_and_do_not_jump():
    """From tenth to tenth of a second the estimate moves by millimetres."""
    found = errors(0.1, 5000)
    assert np.diff(found[:, 0]).std() < 0.4 * PLACE_ERROR
