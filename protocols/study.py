"""A study as data: what a protocol file may say."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from lad.hyperparameters import LADParameters
from protocols.cohort import Cohort, Options
from protocols.condition import Condition
from protocols.consistency import check_consistency
from protocols.declared import Comparison, Exclusion
from protocols.files.file_model import FileModel, Name, shipped_or_factory
from protocols.laps import PlannedLap
from protocols.pages import Consent, Particular, Text
from protocols.shipped_parts import MODELS
from protocols.start_noise import StartNoise


class ModelChoice(FileModel):
    """The assistant that learns; Table I of the paper is the default.

    ``lad`` learns the demonstrator's command, as the paper's model does, ``lad-correction`` how it
    differs from the user's. ``parameters`` are those of a shipped model, ``options`` those of
    somebody else's.
    """

    use: shipped_or_factory(*MODELS) = "lad"  # type: ignore[valid-type]
    parameters: LADParameters = LADParameters()
    options: Options = Field(default_factory=dict)

    @model_validator(mode="after")
    def _options_are_for_others(self) -> Self:
        if self.use in MODELS and self.options:
            raise ValueError(f"options are for a model of your own; {self.use} takes parameters")
        return self


CasterName = Literal["sweep", "pybullet"]


class LaserSettings(FileModel):
    """The simulated laser: rays over 240 degrees, and who casts them.

    Attributes
    ----------
    rays
        At least one in each of the model's 12 degree segments.
    caster
        ``sweep`` is our compiled sweep over the course's walls, ``pybullet`` the physics engine.
    """

    rays: Annotated[int, Field(ge=21, le=2000)] = 180
    caster: CasterName = "sweep"


class StudyProtocol(FileModel):
    """A study: its people, its conditions, its laps in order, and what it declares in advance.

    Attributes
    ----------
    schema_version
        Version of the file format; ``schema`` in a file.
    name, title, description
        What the study is called, and what it is about.
    course
        A shipped course's name, or a file's path relative to the protocol file.
    conditions
        Ways of driving a lap, by name.
    laps
        What a participant does, in order.
    control_period_s
        Length of a control step, in s.
    laser
        The simulated laser.
    start_noise
        How exactly the chair is put at the start.
    hold_s
        How long a driver's last command stays in force without a new one, in s; then the chair is
        told to stand.
    consent
        Shown, and agreed to, before anything else; null for none.
    demographics
        What participants are asked about themselves before the first lap.
    debrief
        Shown after everything else; null for none.
    """

    schema_version: Annotated[Literal[1], Field(alias="schema")] = 1
    name: Name
    title: Annotated[str, Field(min_length=1)]
    description: str = ""
    course: Annotated[str, Field(min_length=1)] = "lab-office"
    cohort: Cohort = Cohort()
    conditions: Annotated[dict[Name, Condition], Field(min_length=1)]
    laps: Annotated[tuple[PlannedLap, ...], Field(min_length=1, max_length=200)]
    model: ModelChoice = ModelChoice()
    exclusion: Exclusion = Exclusion()
    analyses: tuple[Comparison, ...] = ()
    control_period_s: Annotated[float, Field(ge=0.02, le=0.5)] = 0.1
    laser: LaserSettings = LaserSettings()
    start_noise: StartNoise = StartNoise()
    hold_s: Annotated[float, Field(gt=0, le=5)] = 0.3
    consent: Consent | None = None
    demographics: tuple[Particular, ...] = ()
    debrief: Text | None = None

    @model_validator(mode="after")
    def _parts_agree(self) -> Self:
        taught = self.model.use not in MODELS  # what a model of one's own knows is not ours to say
        check_consistency(
            self.conditions, self.laps, self.analyses, cohort=self.cohort, taught=taught
        )
        return self
