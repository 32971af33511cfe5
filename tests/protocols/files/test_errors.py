"""The error that means: it is your input."""

import pickle

import pytest

from protocols.files.errors import InputError


def test_message_is_one_line_even_for_several_faults():
    """However many faults there are and however they were written, the message is one line."""
    error = InputError("a.yaml:1: x\n  y", "a.yaml:2: z", "a.yaml:3: w")
    assert str(error) == "a.yaml:1: x y (and 2 more)"
    assert error.faults == ("a.yaml:1: x y", "a.yaml:2: z", "a.yaml:3: w")


def test_survives_the_way_back_from_a_worker_process():
    """Pickled and unpickled, it says the same."""
    error = pickle.loads(pickle.dumps(InputError("one", "two")))  # noqa: S301  # our own bytes
    assert (str(error), error.faults) == ("one (and 1 more)", ("one", "two"))


def test_needs_a_fault():
    """An error that says nothing cannot be made."""
    with pytest.raises(TypeError, match="at least one fault"):
        InputError()
