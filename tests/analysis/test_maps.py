"""Smoothed densities on the plan."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import multivariate_normal

from analysis.maps import BANDWIDTH, CELL, counts, density, overlap, plan_grid, smoothed
from protocols.load import load_course

GRID = plan_grid(load_course("lab-office"))


def cloud(seed, centre=(0.0, 0.0), n=50):
    """Return the density of a cloud of points."""
    rng = np.random.default_rng(seed)
    x, y = rng.normal(centre, 0.4, size=(n, 2)).T
    return density(smoothed(counts(x, y, GRID)))


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 1000))
def test_a_density_integrates_to_one(seed):
    """Whatever the number of points."""
    assert cloud(seed).sum() * CELL**2 == pytest.approx(1.0)


def test_one_point_becomes_the_kernel():
    """A single point at a cell's centre is smeared to a Gaussian of the stated width."""
    i, j = 40, 60
    x, y = GRID.x[j] + CELL / 2, GRID.y[i] + CELL / 2
    found = density(smoothed(counts(np.array([x]), np.array([y]), GRID)))
    at = np.stack(np.meshgrid(GRID.x[:-1] + CELL / 2, GRID.y[:-1] + CELL / 2), axis=-1)
    expected = multivariate_normal([x, y], BANDWIDTH**2 * np.eye(2)).pdf(at)
    assert np.abs(found - expected).max() < 0.01 * expected.max()


def test_overlap_of_a_density_with_itself_is_one_and_of_distant_ones_zero():
    """The two ends of the overlap coefficient."""
    here, there = cloud(1), cloud(1, centre=(-4.0, -5.0))
    assert overlap(here, here) == pytest.approx(1.0)
    assert overlap(here, there) == pytest.approx(0.0, abs=1e-3)


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 1000), st.integers(0, 1000))
def test_overlap_is_symmetric_and_between_zero_and_one(a, b):
    """It does not matter which of the two comes first."""
    f, g = cloud(a), cloud(b)
    assert overlap(f, g) == pytest.approx(overlap(g, f))
    assert 0 <= overlap(f, g) <= 1 + 1e-9


def test_no_assistance_has_no_density():
    """Nothing to smooth is missing, not zero."""
    assert np.isnan(density(np.zeros(GRID.shape))).all()
