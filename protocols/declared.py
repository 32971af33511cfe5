"""What a study declares before its first lap: who is excluded, and what is compared."""

from typing import Annotated, Literal

from pydantic import AfterValidator, Field

from protocols.files.file_model import FileModel, Name

LAP_OUTCOMES = (
    "lap_time_s",
    "duration_s",
    "collisions",
    "contact_time_s",
    "assisted_fraction",
    "interventions",
)
"""Columns of the lap table that a comparison may name."""


Unfinished = Literal["complete pairs", "limit", "worst rank"]
"""What an unfinished lap counts as: no time; its time limit; slower than every finished lap."""


def _lap_outcome_or_item(value: str) -> str:
    instrument, _, item = value.rpartition(".")
    if value in LAP_OUTCOMES or (instrument and item):
        return value
    allowed = (
        f"{', '.join(LAP_OUTCOMES)}, instrument.item (driving-assistance.Q7) or instrument.subscale"
    )
    raise ValueError(f"'{value}' is not an outcome; allowed: {allowed}")


class Exclusion(FileModel):
    """Rules that exclude a participant from every analysis; None switches a rule off.

    A participant who is not excluded but lacks a lap is left out of the comparisons that need
    that lap, and counted there as missing.

    Attributes
    ----------
    min_completed_laps
        Fewer completed laps than this, practice apart.
    max_collisions
        More collisions than this in all laps together, practice apart.
    max_late_share
        A larger share of steps than this started late, practice apart (living people).
    max_input_age_s
        The 99th percentile of the age of the driver's command is higher than this, in s.
    max_interruptions
        More laps than this were paused, stopped or disconnected.
    """

    min_completed_laps: Annotated[int, Field(ge=1)] | None = None
    max_collisions: Annotated[int, Field(ge=0)] | None = None
    max_late_share: Annotated[float, Field(ge=0, le=1)] | None = None
    max_input_age_s: Annotated[float, Field(gt=0)] | None = None
    max_interruptions: Annotated[int, Field(ge=0)] | None = None


class Comparison(FileModel):
    """Two conditions compared within participants, or two groups of them, declared in advance.

    Attributes
    ----------
    name
        Unique name, used in tables.
    outcome
        A column of the lap table, ``instrument.item`` for a survey answer, or
        ``instrument.subscale`` for a composite score.
    condition, reference
        Names of the two conditions; the effect is condition minus reference. Between groups the
        reference may be left out: then it is the condition itself that differs.
    groups
        Names of two groups: the effect is the first one's minus the second one's, of the condition
        or of the difference between condition and reference (group x condition). None compares
        within participants.
    kind
        Confirmatory comparisons of one family are corrected together (Holm).
    family
        Name of that family.
    equivalence_margin
        Margin of an equivalence test (TOST) in the outcome's unit; None for none.
    margin_reason
        Why that margin is the largest difference that does not matter; a registration asks for it.
    unfinished
        What an unfinished lap counts as where lap times are compared: ``complete pairs`` leaves the
        pair out, ``limit`` takes the time limit for its time, ``worst rank`` ranks it behind every
        finished lap. The report shows the other two beside it.
    """

    name: Name
    outcome: Annotated[str, AfterValidator(_lap_outcome_or_item)] = "lap_time_s"
    condition: Name
    reference: Name | None = None
    groups: tuple[Name, Name] | None = None
    kind: Literal["confirmatory", "exploratory"] = "exploratory"
    family: Name = "primary"
    equivalence_margin: Annotated[float, Field(gt=0)] | None = None
    margin_reason: str = ""
    unfinished: Unfinished = "complete pairs"

    @property
    def conditions(self) -> tuple[str, ...]:
        """The conditions it needs laps of: one, or two."""
        return (self.condition,) if self.reference is None else (self.condition, self.reference)

    @property
    def pair(self) -> tuple[str, str]:
        """Condition and reference; ``ValueError`` for a comparison of groups in one condition."""
        if self.reference is None:
            raise ValueError(f"'{self.name}' compares groups in one condition")
        return self.condition, self.reference

    @property
    def item(self) -> tuple[str, str] | None:
        """Instrument and item (or subscale) of a survey outcome; None for a lap outcome."""
        if self.outcome in LAP_OUTCOMES:
            return None
        instrument, _, item = self.outcome.rpartition(".")
        return instrument, item
