"""Whole sessions of a cell's people: the pool that simulated studies are drawn from."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import pandas as pd
from cohort.grid import Cell, overrides

from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from harness.world.bullet_world import BulletWorld
from participants.population import Marginal
from protocols.cohort import Cohort
from protocols.load import resolve_study
from protocols.record.reader import open_study

SEED = 56_100
"""Of all people in the pools: the same people in each cell, as far as their traits are the same."""

KEPT = (
    "participant", "lap", "condition", "practice", "completed", "end_reason", "withdrawal",
    "lap_time_s", "duration_s", "assisted_fraction", "interventions", "collisions",
)  # fmt: skip
"""What is kept of a lap's row."""


def run_of(cell: Cell, solved: Mapping[str, Marginal]) -> StudyRun:
    """Return the shipped study with a cell's people."""
    study = resolve_study("four-lap")
    cohort = Cohort.model_validate({"traits": overrides(cell, solved)})
    return StudyRun(
        replace(study, protocol=study.protocol.model_copy(update={"cohort": cohort})), SEED
    )


def laps_of(
    cell: Cell, solved: Mapping[str, Marginal], people: int, keep: Path,
    tell: Callable[[str], None] = print,
) -> pd.DataFrame:  # fmt: skip
    """Return every lap of a cell's first people, one row each.

    Those in the file are not driven again: a pool can be enlarged.

    Parameters
    ----------
    cell, solved
        Who they are.
    people
        How many.
    keep
        The cell's file (CSV).
    tell
        Called with how far it is.
    """
    known = pd.read_csv(keep) if keep.exists() else pd.DataFrame(columns=["number"])
    missing = sorted(set(range(1, people + 1)) - set(known["number"]))
    for i in range(0, len(missing), 20):
        fresh = pd.DataFrame(list(_rows(run_of(cell, solved), missing[i : i + 20])))
        known = fresh if known.empty else pd.concat([known, fresh], ignore_index=True)
        keep.parent.mkdir(parents=True, exist_ok=True)
        known.to_csv(keep, index=False)
        tell(f"{cell.name}: {known['number'].nunique()} people")
    return known[known["number"] <= people]


def laps_of_study(folder: Path) -> pd.DataFrame:
    """Return every lap of a study of the shipped cohort: the people of the grid's centre.

    Parameters
    ----------
    folder
        A study directory of ``four-lap``, without traits of its own.
    """
    study = open_study(folder)
    assert study.protocol == resolve_study("four-lap").protocol.model_copy(
        update={"cohort": study.protocol.cohort}
    )
    assert not study.protocol.cohort.traits
    laps = study.laps.to_pandas()[list(KEPT)]
    return laps.assign(number=laps["participant"].str[1:].astype(int))


def _rows(run: StudyRun, numbers: list[int]) -> Iterator[dict[str, object]]:
    protocol = run.study.protocol
    world = BulletWorld(run.study.course, protocol.laser, protocol.control_period_s)
    for number in numbers:
        for lap in Session(run, number, world, make_parts(run, number)).run().laps:
            yield {"number": number, **{name: getattr(lap.row, name) for name in KEPT}}
    world.close()
