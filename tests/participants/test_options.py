"""Options from a protocol file are checked, and mistakes are explained in one line."""

import pytest

from participants.options import NoOptions, Options, read_options
from protocols.files.errors import InputError


class Some(Options):
    """An example."""

    reaction_s: float = 0.4
    name: str = "x"


def test_defaults_and_given_values():
    """What is not given has its default."""
    assert read_options("demonstrator 'x'", Some, {"reaction_s": 1}).reaction_s == 1.0
    assert read_options("demonstrator 'x'", Some, {}).name == "x"


def test_an_unknown_option_lists_what_is_allowed():
    """A misspelling is told with the right spellings."""
    with pytest.raises(InputError) as error:
        read_options("demonstrator 'x'", Some, {"reaktion_s": 1})
    assert str(error.value) == (
        "demonstrator 'x': option 'reaktion_s' does not exist; allowed: reaction_s, name"
    )


def test_a_wrong_value_says_what_was_given():
    """The message names the option, what is wrong, and the value."""
    with pytest.raises(InputError, match=r"option 'reaction_s'.*number.*given 'fast'"):
        read_options("demonstrator 'x'", Some, {"reaction_s": "fast"})


def test_every_fault_is_told():
    """Two mistakes make two faults."""
    with pytest.raises(InputError) as error:
        read_options("driver 'y'", NoOptions, {"a": 1, "b": 2})
    assert len(error.value.faults) == 2
