"""Overlap of assistance maps, with participants as units."""

import numpy as np
import pytest

from analysis.stats.map_overlap import EXACT_UP_TO, map_overlap


def maps(n, shift, seed=0, cells=60):
    """Return per-participant counts of two sources whose bumps lie apart by some cells."""
    rng = np.random.default_rng(seed)
    at = np.arange(cells)
    centre = 25 + rng.normal(0, 2, (n, 1))
    bump = np.exp(-0.5 * ((at - centre) / 4) ** 2)
    other = np.exp(-0.5 * ((at - centre - shift - rng.normal(0, 1, (n, 1))) / 4) ** 2)
    return 40 * bump, 40 * other


def test_the_same_maps_overlap_fully():
    """Identical sources: overlap 1, nothing to reject."""
    f, _ = maps(8, 0)
    found = map_overlap(f, f, np.random.default_rng(0))
    assert found.estimate == pytest.approx(1.0)
    assert found.p == 1.0


@pytest.mark.parametrize("n", [8, 20])
def test_maps_in_different_places_are_told_apart(n):
    """Help ten cells further on, for all people: exact for few, drawn for many."""
    found = map_overlap(*maps(n, 10), np.random.default_rng(0))
    assert found.p < 0.05
    assert found.notes[0].startswith("if the sources did not differ, 95% of overlaps")
    assert ("exact" in found.method) == (n <= EXACT_UP_TO)


def test_it_holds_its_size_when_sources_are_interchangeable():
    """Of 200 studies without a difference about 5% are rejected at 5%."""
    rejected = []
    for seed in range(200):
        f, g = maps(7, 0, seed=seed)
        flip = np.random.default_rng(seed).random(7) < 0.5
        f, g = np.where(flip[:, None], f, g), np.where(flip[:, None], g, f)
        rejected.append(map_overlap(f, g, np.random.default_rng(seed)).p <= 0.05)
    assert np.mean(rejected) <= 0.09


def test_who_got_help_from_one_source_only_is_left_out():
    """And counted."""
    f, g = maps(6, 3)
    g[0] = 0
    found = map_overlap(f, g, np.random.default_rng(0))
    assert found.n == 5
    assert "1 participants without help" in found.notes[1]
    assert not map_overlap(f[:1], g[:1], np.random.default_rng(0)).computed
