"""Room grows until capacity, then never again."""

import tracemalloc

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lad.hyperparameters import GPHyperparameters
from lad.snapshot import restore_state, state_arrays
from lad.state import State
from lad.stork_gp import StorkGP
from lad.stream import learn_stream
from lad.triangle import LINE, whole


@given(st.integers(1, 300))
def test_there_is_always_room_for_one_more(capacity):
    """Growing keeps what was there and stops at capacity + 1, rounded up to a cache line."""
    state = State(depth=2, n_inputs=3, n_outputs=1, capacity=capacity)
    while state.n < capacity:
        state.make_room()
        state.times[state.n] = state.n
        state.C[state.starts[state.n] + state.n] = 1.0
        state.n += 1
    state.make_room()
    assert state.times[: state.n].tolist() == list(range(capacity))
    assert np.trace(whole(state.C, capacity)) == capacity
    assert capacity + 1 <= state.room < capacity + 1 + LINE


def test_memory_is_constant_at_capacity():
    """Once full, not one array is replaced, however long the stream."""
    rng = np.random.default_rng(0)
    process = StorkGP(GPHyperparameters(lengthscales=[0.3], noise_variance=0.1, capacity=40))
    addresses = []
    for step in range(2000):
        process.observe(rng.normal(size=1))
        process.learn(rng.normal())
        if step in (500, 1999):
            state = process.state
            arrays = (state.C, state.Q, state.alpha, state.basis, state.times, state.work)
            addresses.append([(a.ctypes.data, a.nbytes) for a in arrays])
    assert process.n_basis == 40
    assert addresses[0] == addresses[1]


@pytest.mark.parametrize("novelty", [1e-4, 0.99999])
def test_no_temporaries_of_the_size_of_a_matrix(stream, make_hyperparameters, novelty):
    """A step with 200 vectors, deleting or sparse, allocates less than a tenth of one matrix."""
    x, y = stream(0, 300, 0.05)
    trained = StorkGP(make_hyperparameters(capacity=200), n_outputs=2)
    learn_stream(trained, x[:220], y[:220])
    process = StorkGP(make_hyperparameters(capacity=200, novelty=novelty), n_outputs=2)
    restore_state(process.state, state_arrays(trained.state))
    learn_stream(process, x[220:230], y[220:230])
    tracemalloc.start()
    learn_stream(process, x[230:], y[230:])
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert process.n_basis == 200
    assert peak < 200 * 200 * 8 / 10
