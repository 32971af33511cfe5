"""A living person who reads pages and answers questionnaires."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict

import numpy as np

from participants.live.seat import Request, Seat, occupied
from participants.pages import Page
from participants.setup import RespondentSetup
from participants.survey import Answer, LapExperience, Question


class LiveReader:
    """Reads a session's pages at a seat."""

    def __init__(self, seat: Seat) -> None:
        self._seat = seat

    def read(self, page: Page) -> Mapping[str, Answer]:
        """Return what was entered, by field."""
        content = {"text": page.text, "fields": list(page.fields), "seconds": page.seconds}
        return self._seat.ask(Request(page.kind, content))


class LiveRespondent:
    """Answers questionnaires at a seat."""

    def __init__(self, seat: Seat) -> None:
        self._seat = seat

    def answer(
        self,
        questions: Sequence[Question],
        experience: LapExperience,  # noqa: ARG002  # a living person has their own
        rng: np.random.Generator,  # noqa: ARG002  # the same
    ) -> tuple[Answer, ...]:
        """Return one answer per question; None where it was left out."""
        asked = [asdict(question) for question in questions]
        entered = self._seat.ask(Request("questions", {"questions": asked}))
        return tuple(entered.get(f"{q.instrument}.{q.item}") for q in questions)


def live_respondent(setup: RespondentSetup) -> LiveRespondent:
    """Return a respondent for a seat.

    Raises
    ------
    InputError
        When there is no seat: a living person cannot be simulated.
    """
    return LiveRespondent(occupied("respondent", setup.seat))
