"""Conditions: limitation, assistance and safeguard of a lap."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from protocols.files.file_model import FileModel, Name
from protocols.wheelchair import MAX_SPEED, MAX_TURN_RATE

AssistantRole = Literal["none", "demonstrator", "model"]
ArbitrationKind = Literal["takeover", "augment", "blend", "blend-learnt"]


TurnRate = Annotated[float, Field(gt=0, le=MAX_TURN_RATE)]

LEAST_TURN_RAD_S = 0.02
"""A chair that turns neither way faster than this cannot be driven along any course."""


class LimitationSettings(FileModel):
    """The control limitation, one or several at once.

    A mapping without any field is the paper's, right turns of 0.15 rad/s; with other fields and
    not this one, right turns are left alone.

    Attributes
    ----------
    right_turn_rad_s, left_turn_rad_s
        What full deflection to the side still gives, in rad/s; None for no limit.
    speed_m_s
        What full deflection forwards or backwards still gives, in m/s; None for no limit.
    lag_s
        Time constant with which the chair follows the stick, in s; 0 for none.
    dead_zone
        Share of the stick's deflection that does nothing; 0 for none.
    """

    right_turn_rad_s: TurnRate | None = 0.15
    left_turn_rad_s: TurnRate | None = None
    speed_m_s: Annotated[float, Field(ge=0.1, le=MAX_SPEED)] | None = None
    lag_s: Annotated[float, Field(ge=0, le=2)] = 0.0
    dead_zone: Annotated[float, Field(ge=0, le=0.8)] = 0.0

    @model_validator(mode="before")
    @classmethod
    def _only_what_is_named(cls, given: Any) -> Any:
        if isinstance(given, dict) and given and "right_turn_rad_s" not in given:
            return {"right_turn_rad_s": None, **given}
        return given

    @model_validator(mode="after")
    def _leaves_control(self) -> Self:
        turns = (self.right_turn_rad_s, self.left_turn_rad_s)
        if max(MAX_TURN_RATE if t is None else t for t in turns) < LEAST_TURN_RAD_S:
            raise ValueError(
                f"leaves no control: neither side turns faster than {LEAST_TURN_RAD_S} rad/s; "
                f"allowed: one of them at least {LEAST_TURN_RAD_S}"
            )
        if turns == (None, None) and self.speed_m_s is None and not self.lag_s + self.dead_zone:
            raise ValueError("limits nothing; leave limitation out, or give it null")
        return self


class Corrections(FileModel):
    """When a demonstrator takes over from the model that helps.

    Attributes
    ----------
    tolerance
        How far the model's command may be from the demonstrator's, in shares of the chair's top
        speeds; without help the user's own command is compared.
    patience_s
        How long it must be farther off, or no help given where the demonstrator would help, before
        the demonstrator takes over, in s.
    """

    tolerance: Annotated[float, Field(ge=0, le=2)] = 0.3
    patience_s: Annotated[float, Field(ge=0, le=5)] = 0.3


class LatentHelp(FileModel):
    """Training in which the model is not told when help was given.

    Attributes
    ----------
    command_noise
        Standard deviation of the error with which the command that counted is known to the model,
        in m/s and in rad/s; 0 for none.
    """

    command_noise: Annotated[float, Field(ge=0, le=0.5)] = 0.0


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
    corrections
        The model helps, the demonstrator takes over only where needed, and the model learns those
        steps; None for not.
    latent_h
        The model learns after the lap from when it infers that help was given; None where it is
        told.
    demonstrator
        Who watches and helps: ``own``, the cohort's demonstrator, or one of the protocol's
        ``demonstrators``.
    """

    limitation: LimitationSettings | None = None
    assistant: AssistantRole = "none"
    arbitration: ArbitrationKind = "takeover"
    safeguard: bool = True
    training: bool = False
    model: Name = "own"
    corrections: Corrections | None = None
    latent_h: LatentHelp | None = None
    demonstrator: Name = "own"

    @model_validator(mode="after")
    def _training_needs_a_demonstrator(self) -> Self:
        if self.corrections is not None and (self.assistant != "model" or not self.training):
            raise ValueError("corrections need assistant: model and training: true")
        if self.latent_h is not None and (self.assistant != "demonstrator" or not self.training):
            raise ValueError("latent_h needs assistant: demonstrator and training: true")
        if self.training and self.assistant != "demonstrator" and self.corrections is None:
            raise ValueError("training: true needs assistant: demonstrator, or corrections")
        if self.training and self.model != "own":
            raise ValueError("training: true needs model: own; a borrowed model learns nothing")
        return self
