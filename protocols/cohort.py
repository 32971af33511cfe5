"""Who takes part: how many, who drives, who helps, who answers."""

import math
from typing import Annotated, Any, Self

from pydantic import Field, model_validator

from protocols.files.file_model import FileModel, Name, part_name
from protocols.shipped_parts import DEMONSTRATORS, DRIVERS, IMPAIRMENTS, RESPONDENTS

Options = dict[str, Any]
"""Settings for the component, as keyword arguments; the component checks them."""

Share = Annotated[float, Field(ge=0, le=1)]


class AgeRange(FileModel):
    """Ages of the people a synthetic cohort is drawn from, in years.

    Attributes
    ----------
    lowest, highest
        Nobody is younger, or older; in years.
    mean, sd
        Mean and standard deviation of the ages, in years.
    """

    lowest: Annotated[float, Field(ge=0, le=120)] = 21
    highest: Annotated[float, Field(ge=0, le=120)] = 38
    mean: Annotated[float, Field(ge=0, le=120)] = 27
    sd: Annotated[float, Field(gt=0, le=60)] = 4.91

    @model_validator(mode="after")
    def _possible(self) -> Self:
        if not self.lowest < self.mean < self.highest:
            raise ValueError("the mean age must lie between lowest and highest")
        largest = ((self.highest - self.mean) * (self.mean - self.lowest)) ** 0.5
        if self.sd >= largest:
            raise ValueError(
                f"no distribution between these ages with this mean has such an sd; "
                f"allowed: below {largest:.2f}"
            )
        return self


class Demographics(FileModel):
    """What a synthetic cohort is drawn from; the default is the paper's sample (section V.B).

    The paper does not report handedness; the default share of left-handers is the estimate of
    Papadatou-Pastou et al. (2020), Psychological Bulletin 146(6), 481-524.

    Attributes
    ----------
    age_years
        How ages are distributed.
    female_share, left_handed_share
        Probability that a person is female, or left-handed.
    """

    age_years: AgeRange = AgeRange()
    female_share: Share = 5 / 12
    left_handed_share: Share = 0.106


class DriverChoice(FileModel):
    """Who drives the wheelchair.

    Attributes
    ----------
    use
        A shipped driver, an installed package's, or ``module:factory`` beside the protocol file.
    options
        Settings of that driver, by name; the driver checks them.
    """

    use: part_name(*DRIVERS) = "human"  # type: ignore[valid-type]
    options: Options = Field(default_factory=dict)


class DemonstratorChoice(FileModel):
    """Who watches and takes over, or as a shadow gives the command that does not count.

    Attributes
    ----------
    use
        A shipped demonstrator, an installed package's, or ``module:factory`` beside the protocol
        file.
    options
        Settings of that demonstrator, by name; the demonstrator checks them.
    """

    use: part_name(*DEMONSTRATORS) = "attentive"  # type: ignore[valid-type]
    options: Options = Field(default_factory=dict)


class RespondentChoice(FileModel):
    """Who answers the questions.

    Attributes
    ----------
    use
        A shipped respondent, an installed package's, or ``module:factory`` beside the protocol
        file.
    options
        Settings of that respondent, by name; the respondent checks them.
    """

    use: part_name(*RESPONDENTS) = "ordinal"  # type: ignore[valid-type]
    options: Options = Field(default_factory=dict)


class ImpairmentChoice(FileModel):
    """An impairment that changes the commands of some participants.

    Attributes
    ----------
    use
        A shipped impairment, an installed package's, or ``module:factory`` beside the protocol
        file.
    share
        Probability that a participant has it; a participant has at most one.
    severity
        From none to severe; the impairment defines its meaning.
    options
        Settings of that impairment, by name; the impairment checks them.
    """

    use: part_name(*IMPAIRMENTS)  # type: ignore[valid-type]
    share: Share = 1.0
    severity: Annotated[float, Field(ge=0, le=1)] = 0.5
    options: Options = Field(default_factory=dict)


class TraitDistribution(FileModel):
    """How one trait is distributed over synthetic people, in place of the calibrated distribution.

    Attributes
    ----------
    median
        The median person's value, in the trait's unit.
    spread
        Standard deviation on the logit scale of the trait's range; 0 when all are alike.
    """

    median: float
    spread: Annotated[float, Field(ge=0, le=10)]


class Cohort(FileModel):
    """The people of a study. A study can be enlarged: only ``participants`` may change then.

    Attributes
    ----------
    participants
        How many.
    driver
        Who drives.
    demonstrator
        Who helps; null for a study without a demonstrator.
    respondent
        Who answers the questions; null for a study without a respondent.
    demographics
        Ages, genders and handedness that synthetic people are drawn from.
    impairments
        What the bodies of some participants do to their own commands. Nobody has more than one,
        so the shares add up to 1 at most.
    traits
        Single traits distributed otherwise than in the calibrated cohort, by the trait's name.
    expected_dropout
        Share of participants expected to give no usable lap; planning takes it into account.
    """

    participants: Annotated[int, Field(ge=1, le=9999)] = 12
    driver: DriverChoice = DriverChoice()
    demonstrator: DemonstratorChoice | None = DemonstratorChoice()
    respondent: RespondentChoice | None = RespondentChoice()
    demographics: Demographics = Demographics()
    impairments: Annotated[tuple[ImpairmentChoice, ...], Field(max_length=100)] = ()
    traits: dict[Name, TraitDistribution] = Field(default_factory=dict)
    expected_dropout: Annotated[float, Field(ge=0, lt=1)] = 0.0

    @model_validator(mode="after")
    def _nobody_has_two(self) -> Self:
        total = math.fsum(impairment.share for impairment in self.impairments)
        if total > 1.0 + 1e-9:
            raise ValueError(
                f"the shares of the impairments add up to {total:g}; allowed: 1 at most, "
                "a participant has at most one"
            )
        return self
