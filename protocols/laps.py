"""Laps as a protocol plans them, and what is asked after each."""

from typing import Annotated, Literal

from pydantic import Field

from protocols.files.file_model import FileModel, Name


class AskedInstrument(FileModel):
    """Questions asked after a lap.

    Attributes
    ----------
    instrument
        A shipped instrument's name, or a file's path relative to the protocol file.
    items
        Ids of the items; ``all`` for every item that applies to the lap (an item about
        assistance does not apply to a lap without an assistant).
    """

    instrument: Annotated[str, Field(min_length=1)]
    items: Annotated[tuple[Name, ...], Field(min_length=1)] | Literal["all"] = "all"


WHOLE_SESSION = "(session)"
"""What stands in place of a condition for an answer that is about the whole session; its lap is -1.
No condition can have this name."""


class PlannedLap(FileModel):
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
    break_s
        How long the participant rests after the lap and its questions, in s; 0 for no break.
    until_comfortable
        Whether a living participant may end the lap by saying that they feel comfortable.
    """

    condition: Name
    practice: bool = False
    time_limit_s: Annotated[float, Field(gt=0, le=3600)] = 300.0
    survey: tuple[AskedInstrument, ...] = ()
    break_s: Annotated[float, Field(ge=0, le=3600)] = 0.0
    until_comfortable: bool = False
