"""What a benchmark of assistants varies: settings, and how often help was demonstrated."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from protocols.cohort import Cohort, DemonstratorChoice, DriverChoice, ImpairmentChoice
from protocols.condition import Condition, LimitationSettings
from protocols.laps import PlannedLap
from protocols.model_choice import BorrowedModel, ModelChoice
from protocols.start_noise import StartNoise
from protocols.study import StudyProtocol

ALONE, DEMONSTRATION, TEST = "alone", "demonstration", "test"
"""Conditions of a benchmark's studies, besides those of ``helped``."""

DEMONSTRATIONS = (1, 2, 3, 5)
"""After how many demonstrations the assistant helps in a lap, unless asked otherwise."""

EXACT = DriverChoice(use="autonomous", options={"control_noise": 0.02})
"""The driver of ``rd-laps``."""


@dataclass(frozen=True, slots=True)
class Setting:
    """One kind of world, person and demonstrator.

    Attributes
    ----------
    name
        Unique; usable as a folder's name.
    limitation
        As a condition has it.
    course
        A shipped course's name, or a file's path.
    driver
        Who drives.
    demonstrator
        Options of the attentive demonstrator.
    impairment
        Of every driver; None for none.
    taught_on
        The setting in which the assistant was taught, when it is not taught in this one.
    """

    name: str
    limitation: Mapping[str, float]
    course: str = "lab-office"
    driver: DriverChoice = EXACT
    demonstrator: Mapping[str, Any] = field(default_factory=dict)
    impairment: ImpairmentChoice | None = None
    taught_on: str | None = None


RIGHT, LEFT = {"right_turn_rad_s": 0.15}, {"left_turn_rad_s": 0.15}

SETTINGS: tuple[Setting, ...] = (
    Setting("right", RIGHT),
    Setting("left", LEFT, "lab-office-mirror", demonstrator={"turns": "left"}),
    Setting("both", RIGHT | LEFT, "ward-corridor", demonstrator={"turns": "both"}),
    Setting("right-and-slow", RIGHT | {"speed_m_s": 0.45}),
    Setting("right-and-lag", RIGHT | {"lag_s": 0.4}),
    Setting("right-and-dead-zone", RIGHT | {"dead_zone": 0.2}),
    Setting("people", RIGHT, driver=DriverChoice(use="human")),
    *(
        Setting(name, RIGHT, impairment=ImpairmentChoice(use=name, severity=0.5))
        for name in ("tremor", "spasticity", "bias", "delay")
    ),
    Setting("slow-to-react", RIGHT, demonstrator={"reaction_s": 0.8, "reaction_spread": 0.5}),
    Setting("elsewhere", RIGHT, "ward-corridor", taught_on="right"),
)
"""The shipped benchmark. The first is the paper's; in the last an assistant drives in a building
in which nothing was demonstrated."""

ELSEWHERE = "taught elsewhere"
"""The model of a setting in which nothing is demonstrated."""


def helped(demonstrations: int) -> str:
    """Return the condition of a lap that the assistant helps after so many demonstrations."""
    return f"after {demonstrations}"


def benchmark_protocol(
    setting: Setting,
    model: ModelChoice,
    replicates: int,
    demonstrations: tuple[int, ...],
    taught_in: str | None = None,
) -> StudyProtocol:
    """Return the study of one assistant in one setting.

    Every replicate drives alone, then demonstrations and helped laps alternate as
    ``demonstrations`` says; the last lap is a demonstration that is not learnt. The study is
    called after the setting, not after the assistant: with the same seed all assistants meet the
    same people, noise and demonstrations.

    Parameters
    ----------
    setting
        Where, and with which people.
    model
        The assistant.
    replicates
        Participants, 1 or more.
    demonstrations
        Rising numbers, each 1 or more.
    taught_in
        Where it is not taught here: the folder of the study in which it was, for each participant.

    Examples
    --------
    >>> protocol = benchmark_protocol(SETTINGS[0], ModelChoice(), 2, (1, 3))
    >>> [lap.condition for lap in protocol.laps][1:]
    ['demonstration', 'after 1', 'demonstration', 'demonstration', 'after 3', 'test']
    """
    limitation = LimitationSettings.model_validate(dict(setting.limitation))
    taught_here = taught_in is None
    whose = "own" if taught_here else ELSEWHERE
    conditions = {
        ALONE: Condition(limitation=limitation),
        DEMONSTRATION: Condition(
            limitation=limitation, assistant="demonstrator", training=taught_here
        ),
        TEST: Condition(limitation=limitation, assistant="demonstrator"),
        **{
            helped(n): Condition(limitation=limitation, assistant="model", model=whose)
            for n in demonstrations
        },
    }
    order = _order(demonstrations) if taught_here else [ALONE, DEMONSTRATION, *_helped(conditions)]
    return StudyProtocol(
        name=f"benchmark {setting.name}"[:80],
        title=f"Benchmark: {setting.name}",
        course=setting.course,
        cohort=Cohort(
            participants=replicates,
            driver=setting.driver,
            demonstrator=DemonstratorChoice(options=dict(setting.demonstrator)),
            respondent=None,
            impairments=() if setting.impairment is None else (setting.impairment,),
        ),
        conditions=conditions,
        laps=tuple(PlannedLap(condition=name) for name in order),
        model=model,
        models={}
        if taught_in is None
        else {ELSEWHERE: BorrowedModel.model_validate({"from": "own laps", "path": taught_in})},
        start_noise=StartNoise(position_m=0.1, heading_rad=0.1),
    )


def _order(demonstrations: tuple[int, ...]) -> list[str]:
    order, shown = [ALONE], 0
    for n in demonstrations:
        order += [DEMONSTRATION] * (n - shown) + [helped(n)]
        shown = n
    return [*order, TEST]


def _helped(conditions: Mapping[str, Condition]) -> Iterator[str]:
    """Yield the last helped condition: the model is taught all demonstrations."""
    yield [name for name, condition in conditions.items() if condition.assistant == "model"][-1]
