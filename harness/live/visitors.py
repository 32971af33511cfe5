"""Which seats of a live study are living people's."""

from dataclasses import dataclass

from harness.session.study_run import StudyRun


@dataclass(frozen=True, slots=True)
class Visitors:
    """Which seats of a visit are living people's.

    Attributes
    ----------
    participant
        Whether a living person drives, answers or reads.
    demonstrator
        Whether a living person demonstrates.
    """

    participant: bool
    demonstrator: bool


def visitors_of(run: StudyRun) -> Visitors:
    """Return which seats a study's protocol gives to living people."""
    cohort = run.study.protocol.cohort
    respondent, demonstrator = cohort.respondent, cohort.demonstrator
    answers = respondent is not None and respondent.use == "live"
    return Visitors(
        participant=cohort.driver.use == "live" or answers,
        demonstrator=demonstrator is not None and demonstrator.use == "live",
    )
