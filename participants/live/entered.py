"""Whether what a browser entered can be an answer: nothing senseless reaches the record."""

from collections.abc import Mapping, Sequence

from participants.survey import Answer, Question
from protocols.instrument import Item
from protocols.pages import Particular
from protocols.record.rows import response_fields
from protocols.record.tables import GENDERS, HANDEDNESS

SECONDS = "#s"
"""Behind an item's name: how long its answer took, s."""

AGES = range(1, 131)
_WORDS: Mapping[Particular, tuple[str, ...]] = {"gender": GENDERS, "handedness": HANDEDNESS}


def fields_fit(fields: Sequence[str], entered: Mapping[str, Answer]) -> bool:
    """Tell whether a form about a person holds what the record can hold, or nothing.

    Examples
    --------
    >>> fields_fit(["age_years", "gender"], {"age_years": 31, "gender": None})
    True
    >>> fields_fit(["gender"], {"gender": "tall"})
    False
    """
    return all(entered.get(name) is None or _fits(name, entered[name]) for name in fields)


def _fits(name: str, value: Answer) -> bool:
    if name in _WORDS:
        return value in _WORDS[name]  # type: ignore[index]  # a particular that has words
    return isinstance(value, int) and value in AGES


def answers_fit(questions: Sequence[Question], answers: Sequence[Answer]) -> bool:
    """Tell whether every answer is one to its question, or missing."""
    for question, answer in zip(questions, answers, strict=True):
        item = Item(
            id=question.item, text=question.text or question.item, answer=question.answer,
            lowest=question.lowest, highest=question.highest, step=question.step,
        )  # fmt: skip
        try:
            response_fields(item, answer, question.points)
        except ValueError:
            return False
    return True
