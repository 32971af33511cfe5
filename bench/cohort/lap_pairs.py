"""A person's baseline and limited lap, and nothing else: no helper, no model, no record.

An assistant that only watches changes nothing: these are the laps of the study, at a third of
their price. The familiarisation lap before them may be left out, too: a person takes a first
impression of how far the chair obeys from it, which moves lap times by about a tenth of a second.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import joblib
import numpy as np
from numpy.typing import NDArray

from harness.session.arbitration import ARBITRATIONS
from harness.session.clock import VirtualClock
from harness.session.lap import Ending, Lap, LapParts, Rules, Step
from harness.session.limitation import right_turn_limit, unlimited
from harness.session.seeds import generator
from harness.world.bullet_world import BulletWorld
from lad.assistant import NO_ASSISTANCE, Assistance
from participants.cohort import draw_person
from participants.registry import make_driver
from participants.setup import DriverSetup
from participants.traits import Traits
from protocols.cohort import Cohort
from protocols.course.gates import GateCounter
from protocols.load import resolve_study

LIMITATIONS = {0: unlimited, 1: unlimited, 2: right_turn_limit(0.15)}
"""Familiarisation, baseline and limited lap, by their position in the session."""

FOREVER = 3000.0
"""A patience that does not end, s."""


@dataclass(frozen=True, slots=True)
class Pair:
    """A person's two laps: seconds, and whether each was driven to its end."""

    baseline_s: float
    limited_s: float
    baseline_done: bool
    limited_done: bool


class _NoModel:
    """A model that never helps."""

    def start_lap(self) -> None:
        """Nothing to forget."""

    def assist(self, x: NDArray[np.float64]) -> Assistance:  # noqa: ARG002  # the seam's
        """Do not help."""
        return NO_ASSISTANCE


class _NoRecord:
    """A recorder that keeps nothing."""

    def record(self, step: Step) -> None:
        """Forget the step."""


class PairTrack:
    """The shipped study's course, where people drive their two laps.

    Parameters
    ----------
    seed
        The study's seed.
    time_limit
        Seconds after which a lap ends unfinished; None for the protocol's.
    familiarised
        Whether the familiarisation lap is driven before.
    """

    def __init__(
        self, seed: int, time_limit: float | None = None, *, familiarised: bool = False
    ) -> None:
        study = resolve_study("four-lap")
        protocol = study.protocol
        self._seed, self._course, self._laps = seed, study.course, protocol.laps
        self._time_limit, self._first = time_limit, 0 if familiarised else 1
        self._world = BulletWorld(study.course, protocol.laser, protocol.control_period_s)

    def drive(self, number: int, traits: Traits) -> Pair:
        """Drive both laps as participant ``number`` of the study with these traits."""
        rng = generator(self._seed, number, "driver")
        driver = make_driver("human", DriverSetup(self._course, rng, traits))
        parts = LapParts(driver, None, _NoModel())
        *_, baseline, limited = (self._lap(number, lap, parts) for lap in range(self._first, 3))
        return Pair(
            baseline.t, limited.t, baseline.reason == "finished", limited.reason == "finished"
        )

    def _lap(self, number: int, lap: int, parts: LapParts) -> Ending:
        self._world.reset(generator(self._seed, number, f"lap {lap}/world"))
        parts.driver.start_lap(lap, generator(self._seed, number, f"lap {lap}/driver"))
        rules = Rules(
            limitation=LIMITATIONS[lap],
            assistant="none",
            arbitration=ARBITRATIONS["takeover"],
            safeguarded=True,
            training=False,
            time_limit_s=self._time_limit or self._laps[lap].time_limit_s,
        )
        race = Lap(self._world, parts, rules, GateCounter(self._course))
        return race.drive(_NoRecord(), VirtualClock())


def person_traits(cohort: Cohort, seed: int, number: int) -> Traits:
    """Return the traits of a participant of the study, the same as its sessions draw."""
    traits = draw_person(cohort, generator(seed, number, "person")).traits
    assert traits is not None
    return traits


def patient(traits: Traits) -> Traits:
    """Return the same person with a patience that does not end."""
    return replace(traits, patience_s=FOREVER)


def drive_all(
    people: Iterable[tuple[int, Traits]],
    seed: int,
    *,
    time_limit: float | None = None,
    jobs: int = 1,
    tell: Callable[[int], None] = lambda _: None,
) -> list[Pair]:
    """Return the pair of laps of each person, in the order of ``people``.

    Parameters
    ----------
    people
        Numbers of participants and their traits.
    seed, time_limit
        As for ``PairTrack``.
    jobs
        Number of processes.
    tell
        Called with how many have been driven.
    """
    pairs = []
    for pair in _driven(list(people), seed, time_limit, jobs):
        pairs.append(pair)
        tell(len(pairs))
    return pairs


def _driven(
    people: list[tuple[int, Traits]], seed: int, time_limit: float | None, jobs: int
) -> Iterator[Pair]:
    if jobs == 1:
        track = PairTrack(seed, time_limit)
        yield from (track.drive(*person) for person in people)
        return
    workers = joblib.Parallel(n_jobs=jobs, return_as="generator", batch_size=1)
    parts = [people[i : i + 25] for i in range(0, len(people), 25)]
    for part in workers(joblib.delayed(_part)(part, seed, time_limit) for part in parts):
        yield from part


def _part(people: list[tuple[int, Traits]], seed: int, time_limit: float | None) -> list[Pair]:
    return list(_driven(people, seed, time_limit, jobs=1))
