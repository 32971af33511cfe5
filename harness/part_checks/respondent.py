"""Check a respondent: it answers what it is asked, in the way the question asks for."""

import math
from collections.abc import Mapping
from typing import Any

from harness.part_checks.common import SAME, same_answers, unchanged
from harness.part_checks.elsewhere import ALLOWED, There, same_elsewhere
from harness.part_checks.elsewhere import NAME as ELSEWHERE
from harness.part_checks.lap_part import Part, made_and_fitting
from harness.part_checks.plain import type_name
from harness.part_checks.play import Played, play
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.role import RESPONDENT, questions_of
from harness.part_checks.setting import PARTICIPANT, Setting
from harness.part_checks.shown import Laps, Survey
from harness.part_checks.source import PartSource
from harness.session.seeds import generator
from participants.survey import LapExperience, Question

QUESTIONNAIRES = "questionnaires"
ANSWERS = "answers"

EXPERIENCES = (
    LapExperience(61.0, None, 0.0, 0, 0.0, 0, True),
    LapExperience(74.0, 61.0, 0.0, 0, 0.0, 2, True),
    LapExperience(66.0, 61.0, 0.21, 3, 0.02, 0, True),
    LapExperience(58.0, 61.0, 1.0, 1, 1.0, 0, True),
    LapExperience(300.0, 61.0, 0.4, 40, 0.3, 12, False),
    LapExperience(0.1, 61.0, 0.0, 0, 0.0, 1, False),
)
"""Laps to be asked about: the own baseline, a bad one, one with help, one that was all help, one
that ran out of time, and one that was left at once."""


def check_respondent(
    part: Part, options: Mapping[str, Any] | None = None, setting: Setting | None = None
) -> PartReport:
    """Put a respondent through what a study will ask of it.

    Parameters
    ----------
    part
        A shipped name, ``module:factory``, or the factory itself: a function of a
        ``RespondentSetup``.
    options
        What a protocol would give it.
    setting
        The instrument it is asked, and the seed; ``driving-assistance`` by default.

    Raises
    ------
    InputError
        When there is no such part, it does not take these options, or cannot answer the
        instrument.

    Examples
    --------
    >>> report = check_respondent("ordinal")  # doctest: +SKIP
    >>> assert report.passed, report  # doctest: +SKIP
    """
    chosen = setting or Setting()
    source = PartSource(part, RESPONDENT.name, RESPONDENT.shipped, options)
    _, fitting = made_and_fitting(RESPONDENT, source, chosen)
    if fitting.state == "failed":
        return PartReport(source.label, RESPONDENT.name, (fitting,))
    surveys = surveys_of(chosen)
    first, again = (
        play(RESPONDENT, source.make(RESPONDENT, chosen), surveys, chosen.seed) for _ in range(2)
    )
    results = (
        fitting,
        _goes_through(first),
        answers_fit(first, questions_of(chosen)),
        same_answers(first, again),
        unchanged((first, again), source),
        _elsewhere(source, chosen, surveys, (first, again)),
    )
    return PartReport(source.label, RESPONDENT.name, results)


def surveys_of(setting: Setting) -> Laps:
    """Return a questionnaire about each of ``EXPERIENCES``, with random numbers of its own."""
    questions = questions_of(setting)
    return [
        [Survey(questions, experience, generator(setting.seed, PARTICIPANT, f"lap {lap}/survey"))]
        for lap, experience in enumerate(EXPERIENCES)
    ]


def answers_fit(played: Played, questions: tuple[Question, ...]) -> CheckResult:
    """Check that each question has an answer of its kind, or is left out."""
    allowed = (
        f"for {len(questions)} questions as many answers: a point of 1 to the scale's last, a "
        "finite number within the item's bounds, text, or None where one was left out"
    )
    faults = (
        f"{fault}, about lap {lap}"
        for lap, answers in enumerate(played.answers, 1)
        for given in answers
        if (fault := _misfit(given, questions)) is not None
    )
    given = [answer for lap in played.answers for answers in lap for answer in _listed(answers)]
    left_out = sum(answer is None for answer in given)
    found = f"{len(given)} answers, {left_out} left out"
    return CheckResult.of(ANSWERS, next(faults, None), found, allowed)


def _listed(answers: Any) -> Any:
    return answers if isinstance(answers, tuple | list) else ()


def _misfit(given: Any, questions: tuple[Question, ...]) -> str | None:
    if not isinstance(given, tuple | list):
        return f"a {type_name(given)}, {given!r}"[:120]
    if len(given) != len(questions):
        return f"{len(given)} answers to {len(questions)} questions"
    for question, answer in zip(questions, given, strict=True):
        if answer is not None and not _fits(question, answer):
            return f"{answer!r} ({type_name(answer)}) to {question.item}"
    return None


def _fits(question: Question, answer: Any) -> bool:
    if question.answer == "text":
        return isinstance(answer, str)
    if question.answer == "number":
        low = -math.inf if question.lowest is None else question.lowest
        high = math.inf if question.highest is None else question.highest
        return isinstance(answer, int | float) and low <= answer <= high and math.isfinite(answer)
    return isinstance(answer, int) and 1 <= answer <= question.points


def _goes_through(played: Played) -> CheckResult:
    fault = None if played.fault is None else f"about lap {played.fault.lap + 1}, it raises "
    if fault is not None and played.fault is not None:
        fault += played.fault.what
    found = f"{len(played.answers)} without an error"
    return CheckResult.of(QUESTIONNAIRES, fault, found, "no error")


def _elsewhere(
    source: PartSource, setting: Setting, surveys: Laps, played: tuple[Played, Played]
) -> CheckResult:
    first, again = played
    if same_answers(first, again).state != "passed":
        why = f"it does not pass '{SAME}'"
        return CheckResult(ELSEWHERE, "not checked", why, ALLOWED)
    return same_elsewhere(RESPONDENT.name, source, setting, surveys, There(first.plain()))
