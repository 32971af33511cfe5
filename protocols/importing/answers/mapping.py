"""What a mapping file for answers may say."""

import re
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from protocols.files.file_model import FileModel, Name


class Participant(FileModel):
    """Which column says who answered.

    Attributes
    ----------
    column
        Its name in the file.
    ids
        The study's id of what stands there, such as ``{"17": P0001}``; what is not listed is taken
        as it stands.
    """

    column: Annotated[str, Field(min_length=1)]
    ids: dict[str, Name] = Field(default_factory=dict)


class Drop(FileModel):
    """Rows to pass over: those with one of these values in a column."""

    column: Annotated[str, Field(min_length=1)]
    values: Annotated[tuple[str, ...], Field(min_length=1)]


class Wide(FileModel):
    """One row per person, a column per lap and item.

    Attributes
    ----------
    columns
        Pattern of the columns' names with ``{item}`` and, unless ``lap`` is given, ``{lap}``.
    lap
        The lap that every answer is about, counted from 0.
    """

    columns: Annotated[str, Field(min_length=1)]
    lap: Annotated[int, Field(ge=0)] | None = None

    @model_validator(mode="after")
    def _has_its_parts(self) -> Self:
        if self.columns.count("{item}") != 1:
            raise ValueError("columns must have {item} once, such as Lap{lap}_{item}")
        if (self.columns.count("{lap}") == 1) == (self.lap is not None):
            raise ValueError("give the lap once: as {lap} in columns, or as lap")
        return self

    def pattern(self) -> re.Pattern[str]:
        """Return the pattern as a regular expression with the groups ``lap`` and ``item``."""
        text = re.escape(self.columns)
        text = text.replace(r"\{item\}", r"(?P<item>[A-Za-z0-9_.-]+)")
        return re.compile(text.replace(r"\{lap\}", r"(?P<lap>\d+)"))


class Long(FileModel):
    """One row per answer.

    Attributes
    ----------
    item, answer
        Columns with the item and the answer.
    lap
        Column with the lap, or its number for all.
    """

    item: Annotated[str, Field(min_length=1)]
    answer: Annotated[str, Field(min_length=1)]
    lap: Annotated[str, Field(min_length=1)] | Annotated[int, Field(ge=0)]


class AnswersMapping(FileModel):
    """What is where in a questionnaire export.

    Attributes
    ----------
    participant
        Who answered.
    instrument
        The study's instrument that was asked.
    wide, long
        How the answers lie; exactly one of the two.
    first_lap
        Number of the session's first lap in the file: 1 where it counts from 1.
    items
        The instrument's item of what the file calls it; what is not listed is taken as it stands.
    labels
        Point of the scale of a label, or ``anchors``: the instrument's own labels. Numbers are
        understood without them.
    reversed
        Items whose points stand in the opposite order in the file: 1 means the highest.
    missing
        What stands for no answer.
    drop
        Rows to pass over, such as previews and unfinished ones.
    skip_rows
        How many rows below the names are no answers (Qualtrics: 2).
    doubled
        What to do about a question that a person answered twice.
    encoding, separator, decimal
        Of the file.
    """

    schema_version: Annotated[Literal[1], Field(alias="schema")] = 1
    participant: Participant
    instrument: Name
    wide: Wide | None = None
    long: Long | None = None
    first_lap: Annotated[int, Field(ge=0)] = 0
    items: dict[str, Name] = Field(default_factory=dict)
    labels: dict[str, int] | Literal["anchors"] = Field(default_factory=dict)
    reversed: tuple[Name, ...] = ()
    missing: tuple[str, ...] = ("",)
    drop: tuple[Drop, ...] = ()
    skip_rows: Annotated[int, Field(ge=0, le=100)] = 0
    doubled: Literal["refuse", "last"] = "refuse"
    encoding: Literal["utf-8", "utf-16", "latin-1", "cp1252"] = "utf-8"
    separator: Literal[",", ";", "\t"] = ","
    decimal: Literal[".", ","] = "."

    @model_validator(mode="after")
    def _one_layout(self) -> Self:
        if (self.wide is None) == (self.long is None):
            raise ValueError("give either wide or long")
        return self

    @model_validator(mode="after")
    def _labels_differ(self) -> Self:
        if self.labels != "anchors":
            folded = [label.casefold() for label in self.labels]
            again = next((label for i, label in enumerate(folded) if label in folded[:i]), None)
            if again is not None:
                raise ValueError(f"labels: {again!r} is there twice; upper and lower case are one")
        return self
