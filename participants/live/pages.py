"""A living person who reads pages and answers questionnaires."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict

import numpy as np

from participants.live.entered import SECONDS, answers_fit, fields_fit
from participants.live.seat import Request, Seat, occupied
from participants.pages import Page
from participants.setup import RespondentSetup
from participants.survey import Answer, LapExperience, Question

SECRET = ("expected",)
"""What of a question is not shown: the answer that an attention check waits for."""


class LiveReader:
    """Reads a session's pages at a seat."""

    def __init__(self, seat: Seat) -> None:
        self._seat = seat

    def read(self, page: Page) -> Mapping[str, Answer]:
        """Return what was entered, by field; a page with a senseless entry is shown again."""
        content = {"text": page.text, "fields": list(page.fields), "seconds": page.seconds}
        while True:
            entered = self._seat.ask(Request(page.kind, content))
            if page.kind != "demographics":
                return entered
            if fields_fit(page.fields, entered):
                return {name: entered.get(name) for name in page.fields}


class LiveRespondent:
    """Answers questionnaires at a seat."""

    def __init__(self, seat: Seat) -> None:
        self._seat = seat
        self._times: tuple[float | None, ...] | None = None

    def answer(
        self,
        questions: Sequence[Question],
        experience: LapExperience,  # noqa: ARG002  # a living person has their own
        rng: np.random.Generator,  # noqa: ARG002  # the same
    ) -> tuple[Answer, ...]:
        """Return one answer per question; None where it was left out.

        An answer that is none to its question cannot be recorded: the page is shown again.
        """
        asked = [
            {name: value for name, value in asdict(question).items() if name not in SECRET}
            for question in questions
        ]
        entered: Mapping[str, Answer] = {}
        names = [f"{q.instrument}.{q.item}" for q in questions]
        fits = False
        while not fits:
            entered = self._seat.ask(Request("questions", {"questions": asked}))
            fits = answers_fit(questions, [entered.get(name) for name in names])
        times = [entered.get(f"{name}{SECONDS}") for name in names]
        self._times = tuple(float(t) if isinstance(t, int | float) else None for t in times)
        return tuple(entered.get(name) for name in names)

    def response_times(self) -> tuple[float | None, ...] | None:
        """Return how long each of the last answers took, s, by the browser's clock."""
        return self._times


def live_respondent(setup: RespondentSetup) -> LiveRespondent:
    """Return a respondent for a seat.

    Raises
    ------
    InputError
        When there is no seat: a living person cannot be simulated.
    """
    return LiveRespondent(occupied("respondent", setup.seat))
