"""Unbroken stretches of a signal."""

import itertools

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from analysis.measures.episodes import episodes


@given(st.lists(st.booleans(), max_size=60))
def test_episodes_cover_exactly_the_true_steps(on):
    """The stretches, put together, are the steps that were on; none touches its neighbour."""
    found = episodes(np.array(on, dtype=bool))
    covered = [i for e in found for i in range(e.start, e.stop)]
    assert covered == [i for i, value in enumerate(on) if value]
    assert all(a.stop < b.start for a, b in itertools.pairwise(found))
