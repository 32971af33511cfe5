"""Files written as YAML load to what was written."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel

from protocols.files.document import parse
from protocols.files.dump import plain_yaml, to_yaml
from protocols.files.validation import validate
from protocols.load import load_course, load_instrument, load_protocol, resolve_study

_TEXT = st.text(st.characters(exclude_categories=("Cs",)), max_size=60)
_LEAF = (
    st.none() | st.booleans() | st.integers() | _TEXT
    | st.floats(allow_nan=False, allow_infinity=False)
)  # fmt: skip
_DATA = st.recursive(
    _LEAF, lambda inside: st.lists(inside, max_size=3) | st.dictionaries(_TEXT, inside, max_size=3),
    max_leaves=8,
)  # fmt: skip


@given(_DATA)
def test_any_plain_value_survives(data: Any):
    """Text with every kind of break, numbers and words that look like others come back as given."""
    assert parse(plain_yaml({"k": data}).encode(), "f").data == {"k": data}


@pytest.mark.parametrize(
    "model",
    [
        load_protocol("four-lap"),
        resolve_study("four-lap").protocol,
        load_course("lab-office"),
        load_instrument("driving-assistance"),
    ],
    ids=["protocol", "resolved", "course", "instrument"],
)
def test_what_is_shown_validates(model: BaseModel):
    """`show` prints what `validate` accepts, and it is the same study."""
    text = to_yaml(model)
    assert validate(parse(text.encode(), "f"), type(model)) == model


def test_a_missing_value_is_written_as_null():
    """A field without a value is written as null."""
    assert plain_yaml({"a": None, "b": [1, None]}) == "a: null\nb: [1, null]\n"
