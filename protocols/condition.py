"""Conditions: limitation, assistance and safeguard of a lap."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from protocols.files.file_model import FileModel, Name
from protocols.wheelchair import MAX_TURN_RATE

AssistantRole = Literal["none", "demonstrator", "model"]
ArbitrationKind = Literal["takeover", "augment"]


class LimitationSettings(FileModel):
    """The control limitation: what full deflection to the right still gives, in rad/s."""

    right_turn_rad_s: Annotated[float, Field(gt=0, le=MAX_TURN_RATE)] = 0.15


class Condition(FileModel):
    """One way of driving a lap.

    Attributes
    ----------
    limitation
        What is done to the driver's command; None for nothing.
    assistant
        Who may help.
    arbitration
        How the driver's and the assistant's commands are combined.
    safeguard
        Whether the last guard against hard collisions is on.
    training
        Whether the participant's own model learns from the demonstrator during the lap.
    model
        Whose model predicts, and helps where the assistant is a model: ``own``, or one of the
        protocol's ``models``.
    """

    limitation: LimitationSettings | None = None
    assistant: AssistantRole = "none"
    arbitration: ArbitrationKind = "takeover"
    safeguard: bool = True
    training: bool = False
    model: Name = "own"

    @model_validator(mode="after")
    def _training_needs_a_demonstrator(self) -> Self:
        if self.training and self.assistant != "demonstrator":
            raise ValueError("training: true needs assistant: demonstrator")
        if self.training and self.model != "own":
            raise ValueError("training: true needs model: own; a borrowed model learns nothing")
        return self
