"""The learning assistant a protocol names."""

import numpy as np
import pytest

from harness.session.model import basis_vectors, make_model, saved
from lad.command import Command
from lad.hyperparameters import LADParameters
from lad.lad_assistant import LADAssistant
from protocols.files.errors import InputError
from protocols.model_choice import ModelChoice


def test_the_shipped_model_gets_the_protocols_parameters():
    """What the protocol says of Table I is what the model works with."""
    model = make_model(ModelChoice.model_validate({"parameters": {"capacity": 7}}))
    assert isinstance(model, LADAssistant)
    assert model.parameters.capacity == 7


def test_what_is_saved_is_the_model():
    """The bytes in the record rebuild the model."""
    model = make_model(ModelChoice())
    model.start_lap()
    model.assist(np.zeros(19))
    model.learn(True, Command(0.3, -0.5))
    again = LADAssistant.from_bytes(saved(model))
    again.start_lap()
    model.start_lap()
    assert again.assist(np.ones(19)) == model.assist(np.ones(19))
    assert basis_vectors(model) == {"basis_vectors_when": 1, "basis_vectors_how": 1}


@pytest.mark.parametrize(
    ("use", "options", "part"),
    [
        ("nowhere.at:all", {}, "nowhere"),
        ("subprocess:run", {"args": "true", "shell": True}, "subprocess:run"),
        ("lad.lad_assistant:Missing", {}, "Missing"),
        ("linear", {"size": 3}, "size"),
    ],
)
def test_a_model_that_cannot_be_made_is_said_in_one_line(use, options, part):
    """A name that is nobody's, or a wrong option: named in one line."""
    with pytest.raises(InputError) as fault:
        make_model(ModelChoice(use=use, options=options))
    assert part in str(fault.value)
    assert "\n" not in str(fault.value)


def test_parameters_that_a_shipped_model_does_not_take_are_said_in_one_line():
    """Here and not in the first session; the line names the model and what is allowed."""
    choice = ModelChoice(use="lad-level", parameters=LADParameters(memory_laps=2))
    with pytest.raises(InputError, match=r"^lad-level: memory_laps: .*; allowed: null$"):
        make_model(choice)


def test_a_study_can_start_with_models_that_were_taught(tmp_path):
    """`lad.trained:load` gives each participant the model of that participant's name."""
    model = make_model(ModelChoice())
    for name, v in (("P0001", 0.1), ("P0002", 0.4)):
        model.start_lap()
        model.assist(np.zeros(19))
        model.learn(True, Command(v, -0.5))
        model.save(tmp_path / f"{name}.npz")
    options = {"path": "{folder}/{participant}.npz"}
    choice = ModelChoice(use="lad.trained:load", options=options)
    one, two = (
        make_model(choice, {"folder": str(tmp_path), "participant": name})
        for name in ("P0001", "P0002")
    )
    assert one.assist(np.zeros(19)).mean.v < two.assist(np.zeros(19)).mean.v
    with pytest.raises(InputError, match="P0003"):
        make_model(choice, {"folder": str(tmp_path), "participant": "P0003"})
