"""docs/protocols.md says what the files may contain."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from pydantic import BaseModel

from lad.hyperparameters import LADParameters
from protocols.cohort import (
    AgeRange,
    Cohort,
    Demographics,
    DriverChoice,
    ImpairmentChoice,
    TraitDistribution,
)
from protocols.condition import Condition, LimitationSettings
from protocols.declared import LAP_OUTCOMES, Comparison, Exclusion
from protocols.instrument import Instrument, Item
from protocols.laps import AskedInstrument, PlannedLap
from protocols.model_choice import ModelChoice
from protocols.start_noise import StartNoise
from protocols.study import LaserSettings, StudyProtocol

_PAGE = (Path(__file__).parents[2] / "docs" / "protocols.md").read_text(encoding="utf-8")
_PROSE = re.sub(r"```.*?```", "", _PAGE, flags=re.DOTALL)
_NAMED = {word for code in re.findall(r"`([^`]+)`", _PROSE) for word in re.findall(r"[\w-]+", code)}
_MODELS = (
    StudyProtocol, Cohort, Demographics, AgeRange, DriverChoice, ImpairmentChoice,
    TraitDistribution, Condition, LimitationSettings, PlannedLap, AskedInstrument, ModelChoice,
    LADParameters, LaserSettings, StartNoise, Exclusion, Comparison, Instrument, Item,
)  # fmt: skip


def _fields(model: type[BaseModel]) -> Iterator[str]:
    for name, field in model.model_fields.items():
        yield field.alias or name


@pytest.mark.parametrize("model", _MODELS)
def test_every_field_is_documented(model: type[BaseModel]):
    """No field of a protocol or instrument file is missing from the page."""
    assert set(_fields(model)) <= _NAMED


def test_outcomes_are_documented():
    """Every outcome that a comparison may name."""
    assert set(LAP_OUTCOMES) <= _NAMED
