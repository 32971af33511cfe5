"""Groups of participants: what is different for some of them from beginning to end."""

from typing import Annotated

from pydantic import Field

from protocols.cohort import DemonstratorChoice
from protocols.condition import Condition
from protocols.files.file_model import FileModel, Name
from protocols.model_choice import ModelChoice


class Group(FileModel):
    """One level of the study's between-subject factor.

    Attributes
    ----------
    ratio
        How many of a block's participants are in it, beside the other groups' ratios.
    conditions
        Conditions that are different for this group, by the name of one of the protocol's.
    model, demonstrator
        In place of the protocol's; None for the same.
    course
        Driven in place of the protocol's; a shipped course's name, or a file's path relative to the
        protocol file. None for the same.
    """

    ratio: Annotated[int, Field(ge=1, le=20)] = 1
    conditions: dict[Name, Condition] = Field(default_factory=dict)
    model: ModelChoice | None = None
    demonstrator: DemonstratorChoice | None = None
    course: Annotated[str, Field(min_length=1)] | None = None
