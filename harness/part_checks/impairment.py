"""Check an impairment: a driver around a driver, which stays the same kind of participant."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from harness.part_checks.commands import command_fault, driver_commands
from harness.part_checks.driver import drives_again
from harness.part_checks.evidence import Evidence
from harness.part_checks.fault import described
from harness.part_checks.lap_part import Part, check_lap_part
from harness.part_checks.plain import plain
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.role import IMPAIRMENT, SEVERITY, impairment_setup
from harness.part_checks.setting import PARTICIPANT, Setting
from harness.part_checks.source import PartSource
from harness.session.seeds import generator
from lad.command import Command
from participants.driver import ParticipantKind, WithdrewError, kind_of
from participants.sight import Sight

AROUND = "leaves the driver its part"
SILENT = "a driver with nothing new"
NONE = "severity 0"
AROUND_ALLOWED = (
    "its driver is asked once in each step, sees the same sight, gets the lap's rng untouched, "
    "keeps its kind, and may leave"
)
STEPS = 30
"""How long a driver that is under observation drives."""


def check_impairment(
    part: Part, options: Mapping[str, Any] | None = None, setting: Setting | None = None
) -> PartReport:
    """Put an impairment through what a study will ask of it, around the autonomous driver.

    Parameters
    ----------
    part
        A shipped name, ``module:factory``, or the factory itself: a function of an
        ``ImpairmentSetup``.
    options
        What a protocol would give it.
    setting
        Course, control period and seed; the four-lap study's by default.

    Raises
    ------
    InputError
        When there is no such part, or it does not take these options.

    Examples
    --------
    >>> report = check_impairment("tremor")  # doctest: +SKIP
    >>> assert report.passed, report  # doctest: +SKIP
    """
    chosen = setting or Setting()
    return check_lap_part(IMPAIRMENT, part, options, chosen, commands=driver_commands, own=_own)


class _Observed:
    """A driver that notes how it is treated; it has no new command in every third step."""

    kind: ParticipantKind = "scripted"

    def __init__(self, *, silent: bool, leaves_at: int | None = None) -> None:
        self._silent, self._leaves_at = silent, leaves_at
        self.laps: list[tuple[int, str]] = []
        self.seen: list[Sight] = []
        self.given: Command | None = None

    def start_lap(self, lap: int, rng: np.random.Generator) -> None:
        self.laps.append((lap, repr(rng.bit_generator.state)))

    def act(self, sight: Sight) -> Command | None:
        self.seen.append(sight)
        if len(self.seen) == self._leaves_at:
            raise WithdrewError("that is enough")
        n = len(self.seen)
        swing = (n % STEPS) / STEPS
        self.given = (
            None if self._silent and n % 3 == 0 else Command(0.6 * swing, 0.4 - 0.6 * swing)
        )
        return self.given


def _own(source: PartSource, setting: Setting, evidence: Evidence) -> Iterator[CheckResult]:
    yield drives_again(setting, evidence)
    trials: tuple[tuple[str, Callable[..., str | None], str, str], ...] = (
        (
            AROUND,
            _around,
            f"asked once in each of {STEPS} steps; its kind, its draws and its withdrawal stay",
            AROUND_ALLOWED,
        ),
        (SILENT, _silent, "it goes on", "a driver who answers None, as in every third step"),
        (NONE, _severity_0, "commands stay as they are", "severity 0 changes no command"),
    )
    for name, trial, found, allowed in trials:
        try:
            fault = trial(source, setting, evidence)
        except (Exception, SystemExit) as error:  # noqa: BLE001  # other people's code
            fault = f"it raises {described(error)}"
        yield CheckResult.of(name, fault, found, allowed)


def _through(
    source: PartSource, setting: Setting, evidence: Evidence, driver: _Observed, severity: float
) -> tuple[Any, list[tuple[Any, Command | None]]]:
    """Return the impaired driver, and per step its answer, and what its driver gave."""
    setup = impairment_setup(dict(source.options), setting, driver, severity)
    impaired = source.factory(setup)
    impaired.start_lap(0, _lap_numbers(setting))
    sights = [moment.sight for moment in _sights(evidence)]
    return impaired, [(impaired.act(sight), driver.given) for sight in sights]


def _sights(evidence: Evidence) -> Any:
    return evidence.recorded[0][:STEPS]


def _lap_numbers(setting: Setting) -> np.random.Generator:
    return generator(setting.seed, PARTICIPANT, "lap 0/driver")


def _around(source: PartSource, setting: Setting, evidence: Evidence) -> str | None:
    driver = _Observed(silent=False)
    impaired, answers = _through(source, setting, evidence, driver, SEVERITY)
    if driver.laps != [(0, repr(_lap_numbers(setting).bit_generator.state))]:
        starts = len(driver.laps)
        return (
            f"its driver's start_lap is called {starts} times"
            if starts != 1
            else "its driver's lap starts with another number, or draws were taken from its rng"
        )
    if len(driver.seen) != len(answers):
        return f"its driver is asked {len(driver.seen)} times in {len(answers)} steps"
    shown = [moment.sight for moment in _sights(evidence)]
    if plain(driver.seen) != plain(shown):
        return "its driver is shown something else than there is to see"
    if kind_of(impaired) != driver.kind:
        return f"around a {driver.kind} driver its kind is {kind_of(impaired)}"
    return _keeps_from_leaving(source, setting, evidence)


def _keeps_from_leaving(source: PartSource, setting: Setting, evidence: Evidence) -> str | None:
    try:
        _through(source, setting, evidence, _Observed(silent=False, leaves_at=3), SEVERITY)
    except WithdrewError:
        return None
    return "its driver's WithdrewError does not come through"


def _silent(source: PartSource, setting: Setting, evidence: Evidence) -> str | None:
    _, answers = _through(source, setting, evidence, _Observed(silent=True), SEVERITY)
    faults = (command_fault(answer) for answer, _ in answers if answer is not None)
    return next((fault for fault in faults if fault is not None), None)


def _severity_0(source: PartSource, setting: Setting, evidence: Evidence) -> str | None:
    _, answers = _through(source, setting, evidence, _Observed(silent=False), 0.0)
    for step, (given, inner) in enumerate(answers, 1):
        if given is None or inner is None or not np.allclose(given, inner, rtol=0, atol=1e-9):
            return f"in step {step}, {inner} becomes {given}"
    return None
