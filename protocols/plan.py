"""The plan of a session: its laps in order, and what is asked after each."""

from typing import Annotated, Literal

from pydantic import Field

from protocols.part import Name, Part


class SurveyPlan(Part):
    """Questions asked after a lap.

    Attributes
    ----------
    instrument
        A shipped instrument's name, or a file's path relative to the protocol file.
    items
        Ids of the items; ``all`` for every item that applies to the lap (an item about
        assistance does not apply to a lap in which nobody could help).
    """

    instrument: Annotated[str, Field(min_length=1)]
    items: Annotated[tuple[Name, ...], Field(min_length=1)] | Literal["all"] = "all"


class PlannedLap(Part):
    """One lap of the session.

    Attributes
    ----------
    condition
        Name of one of the protocol's conditions.
    practice
        Whether the lap is for familiarisation and left out of the analysis.
    time_limit_s
        Time after which the lap ends unfinished, in s.
    survey
        What is asked after the lap.
    """

    condition: Name
    practice: bool = False
    time_limit_s: Annotated[float, Field(gt=0, le=3600)] = 300.0
    survey: tuple[SurveyPlan, ...] = ()
