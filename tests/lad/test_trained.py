"""Files of assistants that another version wrote: named errors, and never half a model."""

import numpy as np
import pytest

from lad.command import Command
from lad.correction import CorrectionAssistant
from lad.errors import ModelFileError
from lad.hyperparameters import LADParameters
from lad.lad_assistant import LADAssistant
from lad.model_file import pack, unpack
from lad.trained import from_bytes

both = pytest.mark.parametrize("make", [LADAssistant, CorrectionAssistant])


def changed(make, change):
    """Return a taught model's file with another header."""
    model = make(LADParameters(memory_laps=2))
    model.start_lap()
    for step in range(6):
        model.assist(np.full(19, 0.1 * step))
        model.learn(helping=True, command=Command(0.2, -0.3))
    header, arrays = unpack(model.to_bytes(), make.kind)
    change(header)
    return pack(make.kind, header, arrays)


@both
def test_an_unchanged_file_is_the_model(make):
    """The other tests' files differ from one that is read by their change alone."""
    model = from_bytes(changed(make, lambda header: None), "theirs")
    assert type(model) is make
    assert model.how.n_basis > 0


@both
@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda h: h.update(format_version=2), "given format version 2; this library reads 1"),
        (lambda h: h["parameters"].update(depth_m=1.0), "depth_m: no such field; allowed are"),
        (lambda h: h["parameters"].update(tune="guessing"), "tune"),
        (lambda h: h.update(third_process={}), "'third_process' is of another version"),
        (lambda h: h.pop("health"), "'health' is missing"),
        (lambda h: h["parameters"].update(capacity=2), "theirs: "),
    ],
)
def test_another_versions_file_is_a_named_error(make, change, message):
    """One line with the file's name; what is not understood is not left out."""
    with pytest.raises(ModelFileError, match=message) as error:
        from_bytes(changed(make, change), "theirs")
    assert str(error.value).startswith("theirs: ")
    assert "\n" not in str(error.value)


def test_a_kind_of_a_later_version_is_named():
    """An assistant that this version does not know is not taken for Table I's."""
    with pytest.raises(ModelFileError, match="theirs: holds a 'lad-later'"):
        from_bytes(pack("lad-later", {}, {}), "theirs")
