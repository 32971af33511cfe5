"""The window: newest first, zeros at the start, and nothing else."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from lad.errors import InvalidInputError
from lad.window import Window

finite = st.floats(-1e6, 1e6, allow_subnormal=False)


@given(arrays(np.float64, st.tuples(st.integers(1, 9), st.just(3)), elements=finite))
def test_holds_the_last_inputs_newest_first(inputs):
    """After any inputs the window is the last tau of them, newest first, zeros where missing."""
    window = Window(np.array([0.5, 1.0, 2.0]), depth=4)
    for x in inputs:
        window.observe(x)
    wanted = np.zeros((4, 3))
    recent = inputs[::-1][:4]
    wanted[: len(recent)] = recent
    assert np.array_equal(window.inputs, wanted)
    assert window.time == len(inputs) - 1
    assert window.seen == len(inputs)


def test_reset_forgets_the_past_and_counts_laps():
    """A reset leaves zeros and opens a lap, but an empty lap does not count; time continues."""
    window = Window(np.ones(2), depth=3)
    window.reset()
    assert window.lap == 0
    window.observe([1.0, 2.0])
    window.reset()
    window.reset()
    assert not window.scaled.any()
    assert (window.lap, window.seen, window.time) == (1, 0, 0)
    window.observe([1.0, 2.0])
    assert (window.lap, window.seen, window.time) == (1, 1, 1)


@pytest.mark.parametrize(
    ("x", "message"),
    [
        ([1.0, np.nan], "given nan at index 1"),
        ([np.inf, 1.0], "given inf at index 0"),
        ([1.0, -np.inf], "given -inf at index 1"),
        ([1e200, 1.0], "given 1e\\+200 at index 0; allowed are finite numbers up to 1e\\+150"),
        ([1.0], "given shape \\(1,\\); allowed is \\(2,\\)"),
        ([[1.0, 2.0]], "given shape \\(1, 2\\); allowed is \\(2,\\)"),
        (3.0, "given shape \\(\\); allowed is \\(2,\\)"),
        ([1.0, 2.0, 3.0], "given shape \\(3,\\)"),
        ([[1.0], [2.0, 3.0]], "given list; allowed are 2 real numbers"),
        (["a", "b"], "given list"),
        (None, "given NoneType"),
        (np.array([True, False]), "given dtype bool"),
        (np.array([1j, 2.0]), "given dtype complex128"),
        (np.array(["1", "2"]), "given dtype <U1"),
        (np.array([1.0, 2.0], dtype=object), "given dtype object"),
    ],
)
def test_bad_input_changes_nothing(x, message):
    """Whatever cannot be looked at raises a named error, and the window is as it was."""
    window = Window(np.ones(2), depth=2)
    window.observe([5.0, 6.0])
    before = (window.scaled.copy(), window.time, window.lap, window.seen, window.version)
    with pytest.raises(InvalidInputError, match=message):
        window.observe(x)
    after = (window.scaled, window.time, window.lap, window.seen, window.version)
    assert np.array_equal(before[0], after[0])
    assert before[1:] == after[1:]


@pytest.mark.parametrize("dtype", [np.float32, np.int64, np.uint8, np.float16])
def test_any_real_dtype_is_taken(dtype):
    """Real numbers of any width become float64."""
    window = Window(np.ones(2), depth=1)
    window.observe(np.array([1, 2], dtype=dtype))
    assert window.inputs.tolist() == [[1.0, 2.0]]


def test_the_input_is_copied():
    """Changing an array after it was observed changes nothing here."""
    window = Window(np.ones(2), depth=1)
    x = np.array([1.0, 2.0])
    window.observe(x)
    x[:] = 9.0
    assert window.inputs.tolist() == [[1.0, 2.0]]
