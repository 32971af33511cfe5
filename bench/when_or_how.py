"""Cross the model with the demonstrator: is it when to help, or how, that costs laps their time.

    python bench/when_or_how.py --seed 0

Drives the first laps of `rd-laps` three times with the same random numbers. In the laps with the
model, either it decides both when and how, as in the study; or it decides when, and the command is
the demonstrator's (the model's own where the demonstrator would not help); or the demonstrator
decides when, and the command is the model's. Training laps are the same in all three.
"""

import argparse
import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from multiprocessing import get_context
from typing import Literal

import numpy as np

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from lad.assistant import NO_ASSISTANCE, Assistance
from lad.command import Command
from lad.lad_assistant import LADAssistant
from participants.attentive import AttentiveDemonstrator
from participants.sight import Sight
from protocols.load import resolve_study

Deciding = Literal["both", "when", "how"]
LAPS = 8
"""Of rd-laps: up to the one with the model after three demonstrations."""


@dataclass
class Remembering:
    """The demonstrator; its last answer can be asked for again."""

    demonstrator: AttentiveDemonstrator
    last: Assistance = NO_ASSISTANCE

    def start_lap(self) -> None:
        """Forget the last lap."""
        self.demonstrator.start_lap()

    def look(self, sight: Sight) -> None:
        """Look at the room."""
        self.demonstrator.look(sight)

    def assist(self, x: np.ndarray) -> Assistance:
        """Answer as the demonstrator."""
        self.last = self.demonstrator.assist(x)
        return self.last


@dataclass
class Crossed:
    """The model, with a part of its decision taken by the demonstrator."""

    model: LADAssistant
    other: Remembering
    decides: Deciding

    def start_lap(self) -> None:
        """Forget the last lap's history."""
        self.model.start_lap()

    def assist(self, x: np.ndarray) -> Assistance:
        """Answer; the demonstrator has answered in this step already."""
        own, other = self.model.assist(x), self.other.last
        if self.decides == "when" and own.helping and other.helping:
            return replace(own, command=other.command)
        if self.decides == "how":
            return replace(own, helping=other.helping, command=own.mean if other.helping else None)
        return own

    def learn(self, helping: bool, command: Command | None) -> None:
        """Learn as the model."""
        self.model.learn(helping, command)


def drive(seed: int, decides: Deciding, number: int) -> list[tuple[str, float, int]]:
    """Return condition, duration (s) and interventions of one replicate's laps."""
    study = resolve_study("rd-laps")
    protocol = study.protocol.model_copy(update={"laps": study.protocol.laps[:LAPS]})
    world = BulletWorld(
        study.course, protocol.laser, protocol.control_period_s, start_noise=protocol.start_noise
    )
    run = StudyRun(replace(study, protocol=protocol), seed)
    parts = make_parts(run, number)
    other = Remembering(parts.lap.demonstrator)
    crossed = replace(parts.lap, demonstrator=other, model=Crossed(parts.lap.model, other, decides))
    session = Session(run, number, world, replace(parts, lap=crossed))
    try:
        laps = session.run().laps
    finally:
        world.close()
    return [(lap.row.condition, lap.row.duration_s, lap.row.interventions) for lap in laps]


def main() -> None:
    """Print lap times and interventions, by who decides what."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--replicates", type=int, default=16)
    given = parser.parse_args()
    numbers = range(1, given.replicates + 1)
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("spawn")) as pool:
        for decides in ("both", "when", "how"):
            found: dict[str, list[tuple[float, int]]] = {}
            for laps in pool.map(partial(drive, given.seed, decides), numbers):
                for condition, duration, interventions in laps:
                    found.setdefault(condition, []).append((duration, interventions))
            for condition, pairs in found.items():
                if condition.startswith(("demonstrator", "model")):
                    times, helps = np.array(pairs).T
                    print(
                        f"model decides {decides:<4}  {condition:<14} mean {times.mean():6.2f} s, "
                        f"median {np.median(times):6.2f} s, interventions {helps.mean():5.1f}",
                        flush=True,
                    )


if __name__ == "__main__":
    main()
