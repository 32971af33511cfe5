"""What living people enter on pages: as given, with times; nothing senseless, nothing secret."""

import numpy as np
import pytest

from participants.live.entered import SECONDS, fields_fit
from participants.live.pages import LiveReader, LiveRespondent
from participants.pages import Page
from participants.survey import Question, response_times_of

QUESTIONS = (
    Question("easy", "Q1", points=5, text="It was easy."),
    Question("easy", "check", points=5, text="Choose 2 here.", expected=2.0),
    Question("easy", "load", text="How hard?", answer="number", lowest=0, highest=100),
    Question("easy", "words", text="Anything else?", answer="text"),
)


class Entering:
    """A seat at which prepared entries are made, page by page."""

    def __init__(self, *entries):
        self.entries, self.shown = list(entries), []

    def ask(self, request):
        self.shown.append(request)
        return self.entries.pop(0)


def answered(seat):
    """Return the answers given at a seat, and how long they took."""
    respondent = LiveRespondent(seat)
    answers = respondent.answer(QUESTIONS, None, np.random.default_rng(0))
    return answers, response_times_of(respondent)


def test_answers_are_stored_as_given_with_their_times():
    """A point, a number, words; what was left out is missing, and so is its time."""
    seat = Entering({"easy.Q1": 4, f"easy.Q1{SECONDS}": 2.5, "easy.load": 33, "easy.words": " ok "})
    assert answered(seat) == ((4, None, 33, " ok "), (2.5, None, None, None))


@pytest.mark.parametrize("wrong", [{"easy.Q1": 9}, {"easy.load": -1}, {"easy.Q1": "four"}])
def test_what_is_no_answer_is_asked_again(wrong):
    """A browser cannot put an answer into the record that its question does not have."""
    seat = Entering(wrong, {"easy.Q1": 1})
    assert answered(seat)[0] == (1, None, None, None)
    assert len(seat.shown) == 2


def test_what_an_attention_check_waits_for_is_not_shown():
    """The expected answer never reaches the browser."""
    seat = Entering({})
    answered(seat)
    assert all("expected" not in shown for shown in seat.shown[0].content["questions"])


def test_a_form_keeps_its_own_fields_and_asks_again():
    """Ages out of range and other words are asked again; foreign fields are dropped."""
    page = Page("demographics", fields=("age_years", "gender"))
    seat = Entering({"age_years": 900}, {"age_years": 31, "gender": None, "name": "A. Person"})
    assert LiveReader(seat).read(page) == {"age_years": 31, "gender": None}
    assert not fields_fit(["age_years"], {"age_years": 2.5})
