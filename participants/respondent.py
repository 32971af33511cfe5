"""A synthetic respondent: a latent opinion, put on an ordinal scale in a personal style."""

from collections.abc import Mapping, Sequence

import numpy as np
from pydantic import Field

from participants.loadings import KNOWN, Loadings, impression
from participants.options import Options, read_options
from participants.setup import RespondentSetup
from participants.survey import Answer, LapExperience, Question
from participants.traits import ResponseStyle
from protocols.files.errors import InputError

LINE = 5.0
"""Length of an answering line on the latent scale: as long as five points with cuts one apart."""

NO_STYLE = ResponseStyle(acquiescence=0.0, extremity=1.0, liking=0.0, missing_share=0.0)
"""A respondent without habits."""


class OrdinalOptions(Options):
    """What a protocol may set for ordinal respondents.

    Attributes
    ----------
    loadings
        By instrument and item: what moves answers to items of your own instruments, or other
        numbers for the shipped ones.
    """

    loadings: dict[str, dict[str, Loadings]] = Field(default_factory=dict)


class OrdinalRespondent:
    """An ordered probit model of one person.

    The latent answer is the item's loadings on the experience of the lap, plus the person's
    acquiescence, plus standard normal noise; extremity stretches it. The scale's cuts are one
    apart around 0.

    Parameters
    ----------
    loadings
        By instrument and item.
    style
        The person's habits.
    """

    def __init__(
        self, loadings: Mapping[tuple[str, str], Loadings], style: ResponseStyle = NO_STYLE
    ) -> None:
        self._loadings = dict(loadings)
        self._style = style

    def answer(
        self, questions: Sequence[Question], experience: LapExperience, rng: np.random.Generator
    ) -> tuple[Answer, ...]:
        """Answer the questions about one lap; None where one was left out."""
        felt = impression(experience)
        # The same draws for every item, answered or not: leaving one out changes no other answer.
        noise, draws = rng.normal(size=len(questions)), rng.random(len(questions))
        return tuple(
            None
            if draws[i] < self._style.missing_share
            else self._choose(question, felt, float(noise[i]))
            for i, question in enumerate(questions)
        )

    def _choose(self, question: Question, felt: Mapping[str, float], noise: float) -> Answer:
        if question.answer == "text":
            return None  # the model has no opinion in words
        if question.expected is not None:  # whoever does not leave it out has read it
            whole = question.answer == "point"
            return int(question.expected) if whole else question.expected
        style = self._style
        item = self._loadings[question.instrument, question.item]
        opinion = item.latent(felt, style.liking) + style.acquiescence + noise
        if question.answer == "number":
            felt_as = style.extremity * opinion
            return on_range(felt_as, question.lowest, question.highest, question.step)
        return on_scale(style.extremity * opinion, question.points)


def on_scale(latent: float, points: int) -> int:
    """Return the point of a scale: cuts lie one apart, symmetrically around 0.

    Examples
    --------
    >>> [on_scale(latent, 5) for latent in (-9.0, -0.6, 0.0, 1.6)]
    [1, 2, 3, 5]
    """
    cuts = np.arange(1, points) - points / 2
    return 1 + int(np.searchsorted(cuts, latent))


def on_range(
    latent: float, lowest: float | None, highest: float | None, step: float | None = None
) -> float:
    """Return a number on a line with two ends: its middle for 0, nine tenths of it for 2.

    The ends are those that the item gives, 0 and 100 where it gives none; whole numbers,
    or whole steps from the lowest answer.

    Examples
    --------
    >>> [on_range(latent, 0.0, 100.0) for latent in (-9.0, 0.0, 1.0)]
    [0.0, 50.0, 70.0]
    >>> on_range(0.3, 0.0, 100.0, 5.0)
    55.0
    """
    low = 0.0 if lowest is None else lowest
    high = low + 100.0 if highest is None else highest
    share = min(max(0.5 + latent / LINE, 0.0), 1.0)
    size = 1.0 if step is None else step
    return float(min(low + round(share * (high - low) / size) * size, high))


def ordinal_respondent(setup: RespondentSetup) -> OrdinalRespondent:
    """Return a respondent who can answer everything the study asks; see ``OrdinalOptions``.

    Raises
    ------
    InputError
        When nothing is known about what moves the answers to one of the questions.
    """
    own = read_options("respondent 'ordinal'", OrdinalOptions, setup.options).loadings
    asked = {(q.instrument, q.item) for q in setup.questions if q.expected is None}
    loadings = {}
    for instrument, item in sorted(asked):
        found = own.get(instrument, {}).get(item) or KNOWN.get(instrument, {}).get(item)
        if found is None:
            known = ", ".join(KNOWN.get(instrument, own.get(instrument, {}))) or "none"
            raise InputError(
                f"respondent 'ordinal': does not know what moves answers to item {item!r} of "
                f"instrument {instrument!r}; allowed: {known}, or items with loadings in the "
                "respondent's options"
            )
        loadings[instrument, item] = found
    return OrdinalRespondent(loadings, setup.style if setup.style is not None else NO_STYLE)
