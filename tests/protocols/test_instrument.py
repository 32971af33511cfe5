"""Questionnaires as data, and the one that ships."""

from typing import Any

import pytest
from pydantic import ValidationError

from protocols.instrument import Instrument
from protocols.load import load_instrument, shipped_instruments

_STATEMENTS = (
    "I found navigating the obstacle course with the wheelchair easy.",
    "I found navigating the obstacle course frustrating.",
    "I performed well on the task.",
    "The task was difficult at times.",
    "I found the driving assistance to be helpful.",
    "The driving assistance interfered with my driving in a negative way.",
    "The driving assistance enabled me to complete the task faster.",
    "I found the driving assistance to be timely.",
    "The driving assistance negatively impacted my driving ability.",
    "I would have completed the task easily even without the driving assistance.",
    "I liked having driving assistance for this task.",
)


def _instrument(**changes: Any) -> Instrument:
    values = {"name": "x", "title": "X", "anchors": ["no", "so", "yes"], "agreement_from": 3,
              "items": [{"id": "A", "text": "a"}]}  # fmt: skip
    return Instrument.model_validate({**values, **changes})


def test_the_papers_eleven_statements_ship_word_for_word():
    """Section V.A: eleven statements on a five-point scale, the first four after every lap."""
    instrument = load_instrument("driving-assistance")
    assert shipped_instruments() == ("driving-assistance", "nasa-tlx", "sus")
    assert tuple(item.text for item in instrument.items) == _STATEMENTS
    assert instrument.ids(assisted=True) == tuple(f"Q{n}" for n in range(1, 12))
    assert instrument.ids(assisted=False) == ("Q1", "Q2", "Q3", "Q4")
    assert (instrument.points, instrument.agreement_from) == (5, 4)


def test_agreeing_with_a_reversed_statement_is_bad_news():
    """Reverse-coded are those whose agreement speaks against the driving or the assistance."""
    items = load_instrument("driving-assistance").items
    assert {item.id for item in items if item.reverse} == {"Q2", "Q4", "Q6", "Q9", "Q10"}
    assert {item.id for item in items if item.subscale == "task"} == {"Q1", "Q2", "Q3", "Q4"}


def test_items_are_found_by_id():
    """Known ids give the item; an unknown one raises KeyError."""
    assert _instrument().item("A").text == "a"
    with pytest.raises(KeyError):
        _instrument().item("B")


def test_ids_are_unique_and_agreement_is_on_the_scale():
    """A repeated id, and agreement beyond the last point, are refused."""
    with pytest.raises(ValidationError, match="ids are unique"):
        _instrument(items=[{"id": "A", "text": "a"}, {"id": "A", "text": "b"}])
    with pytest.raises(ValidationError, match="allowed: 2 to 3"):
        _instrument(agreement_from=4)
