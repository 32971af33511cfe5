"""Models that others have taught may be of either shipped kind."""

import numpy as np
import pytest

from harness.session.borrowed import _restored
from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.lad_assistant import LADAssistant
from protocols.files.errors import InputError


@pytest.mark.parametrize("make", [LADAssistant, CorrectionAssistant])
def test_a_borrowed_model_is_what_it_was(make):
    """Its kind and its answers are those of the model that was saved."""
    model, x = make(), np.full(19, 0.3)
    model.start_lap()
    model.assist(x)
    model.learn(helping=True, command=Command(0.2, -0.5))
    borrowed = _restored(model.to_bytes(), "theirs")
    assert type(borrowed) is make
    for one in (model, borrowed):
        one.start_lap()
    said, again = model.assist(x), borrowed.assist(x)
    assert (said.mean, said.p_help, said.variance) == (again.mean, again.p_help, again.variance)


def test_what_is_no_model_is_named():
    """One line, with the protocol's name for it."""
    with pytest.raises(InputError, match="theirs"):
        _restored(b"nothing of the kind", "theirs")
