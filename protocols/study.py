"""A study as data: the fields of a protocol file."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from protocols.cohort import Cohort, DemonstratorChoice
from protocols.condition import Condition
from protocols.consistency import check_consistency
from protocols.declared import Comparison, Exclusion
from protocols.files.file_model import FileModel, FormatVersion, Name
from protocols.groups import Group
from protocols.laps import AskedInstrument, PlannedLap
from protocols.live import LiveSettings
from protocols.model_choice import BorrowedModel, ModelChoice, Sha256
from protocols.orders import Orders
from protocols.pages import Consent, Particular, Text
from protocols.start_noise import StartNoise
from protocols.wheelchair import LASER_RANGE

Publication = Literal["soh-demiris-2013"]
"""Published studies that the analysis knows the figures of."""

CasterName = Literal["sweep", "pybullet"]


class LaserSettings(FileModel):
    """The simulated laser: rays over 240 degrees, and who casts them.

    Attributes
    ----------
    rays
        At least one in each of the model's 12 degree segments.
    caster
        ``sweep`` is our compiled sweep over the course's walls, ``pybullet`` the physics engine.
    model_reach_m
        The farthest that the model's segments say, in m; drivers see as far as the laser does.
    """

    rays: Annotated[int, Field(ge=21, le=2000)] = 180
    caster: CasterName = "sweep"
    model_reach_m: Annotated[float, Field(ge=0.5, le=LASER_RANGE)] = LASER_RANGE


class StudyProtocol(FileModel):
    """A study: its people, its conditions, its laps in order, and what it declares in advance.

    Attributes
    ----------
    schema_version
        Version of the file format; ``schema`` in a file.
    name, title
        What the study is called: the short name stands in file names, the title in the report.
    description
        What the study is about.
    course
        A shipped course's name, or a file's path relative to the protocol file.
    cohort
        Who takes part.
    conditions
        Ways of driving a lap, by name.
    laps
        What a participant does, in order.
    orders
        In which orders participants drive the analysed laps; fixed by default.
    groups
        Groups of participants and what is different for them, by name; empty for none.
    model
        The model that a participant teaches: the conditions' model ``own``.
    models
        Models that others have taught, by the name that conditions give them.
    demonstrators
        Further demonstrators, by the name that conditions give them; they teach the same model.
    exclusion
        Rules that exclude a participant from every analysis.
    analyses
        Comparisons declared in advance.
    registration
        SHA-256 of the registration that the study follows; filled in by ``run --registration``.
    control_period_s
        Length of a control step, in s.
    laser
        The simulated laser.
    start_noise
        How exactly the chair is placed at the start.
    hold_s
        How long a driver's last command stays in force without a new one, in s; then the chair is
        told to stop.
    consent
        Shown, and agreed to, before anything else; null for none.
    demographics
        What participants are asked about themselves before the first lap.
    survey
        What is asked once, after the last lap, about the whole session.
    debrief
        Shown after everything else; null for none.
    live
        What living people see and may do.
    replicates
        The published study that this one repeats, whose figures its report shows beside its own;
        null for a study of its own. It changes nothing that is run or recorded.
    """

    schema_version: Annotated[Literal[1], FormatVersion, Field(alias="schema")] = 1
    name: Name
    title: Annotated[str, Field(min_length=1, max_length=5000)]
    description: str = ""
    course: Annotated[str, Field(min_length=1)] = "lab-office"
    cohort: Cohort = Cohort()
    conditions: Annotated[dict[Name, Condition], Field(min_length=1, max_length=200)]
    laps: Annotated[tuple[PlannedLap, ...], Field(min_length=1, max_length=200)]
    orders: Orders = Orders()
    groups: dict[Name, Group] = Field(default_factory=dict)
    model: ModelChoice = ModelChoice()
    models: dict[Name, BorrowedModel] = Field(default_factory=dict)
    demonstrators: Annotated[dict[Name, DemonstratorChoice], Field(max_length=20)] = Field(
        default_factory=dict
    )
    exclusion: Exclusion = Exclusion()
    analyses: Annotated[tuple[Comparison, ...], Field(max_length=500)] = ()
    control_period_s: Annotated[float, Field(ge=0.02, le=0.5)] = 0.1
    laser: LaserSettings = LaserSettings()
    start_noise: StartNoise = StartNoise()
    hold_s: Annotated[float, Field(gt=0, le=5)] = 0.3
    consent: Consent | None = None
    demographics: Annotated[tuple[Particular, ...], Field(max_length=100)] = ()
    survey: Annotated[tuple[AskedInstrument, ...], Field(max_length=100)] = ()
    debrief: Text | None = None
    live: LiveSettings = LiveSettings()
    replicates: Publication | None = None
    registration: Sha256 | None = None

    @model_validator(mode="after")
    def _parts_agree(self) -> Self:
        check_consistency(
            self.conditions,
            self.laps,
            self.analyses,
            cohort=self.cohort,
            model=self.model.use,
            survey=self.survey,
            orders=self.orders,
            groups=self.groups,
            models=self.models,
            demonstrators=self.demonstrators,
        )
        return self
