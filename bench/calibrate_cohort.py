"""Calibrate the synthetic cohort on four published figures, and check it.

    python bench/calibrate_cohort.py                  solve the grid, about an hour
    python bench/calibrate_cohort.py --check 5050     drive the shipped cohort's laps and compare
    python bench/calibrate_cohort.py --keep DIR       keep driven laps, resume after a break

Baseline and limited laps of people of every kind teach an emulator what lap time follows from
which traits; with it the calibrated traits' medians and spreads are solved for, in every cell of
the grid. People of the solved populations drive and are learnt from, too; then it is solved again.
No assisted lap is driven. The same command gives the same numbers on one machine type.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import single_thread  # noqa: F401  # before anything that imports numpy

# isort: split
import numpy as np
from cohort.emulator import LapTime, as_columns
from cohort.grid import CALIBRATED, TARGETS, TOLERANCES, Cell, cells, save
from cohort.keeping import drive
from cohort.lap_pairs import Pair, person_traits
from cohort.people import Numbered, of_cell, of_every_kind
from cohort.solve import Crowd, expected, solve

from participants.population import Marginal
from protocols.cohort import Cohort

EVERY_KIND, PER_CELL = 700, 60
"""How many people of every kind, and of each solved population, are learnt from."""

LONGEST = 600.0
"""Laps are learnt from up to here, s: longer than the study would wait."""

CHECK_SEED = 48_500
"""Of the people who check: neither a study's nor the calibration's."""


def main() -> int:
    """Read the command line and do it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", type=int, metavar="PAIRS", help="only drive and compare")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="where driven laps are kept")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    return check(options) if options.check else calibrate(options)


def calibrate(options: argparse.Namespace) -> int:
    """Solve every cell, drive, solve again; write what was found, and print it."""
    people = of_every_kind(EVERY_KIND)
    pairs = drive(people, options.keep, time_limit=LONGEST, jobs=options.jobs)
    solved = solve_all(people, pairs)
    for i, (cell, found) in enumerate(solved.items(), start=1):
        print(f"{cell.name}: people of the first solution drive", flush=True)
        some = of_cell(cell, found, PER_CELL, first=10_000 * i)
        pairs += drive(some, options.keep, time_limit=LONGEST, jobs=options.jobs)
        people += some
    save(solve_all(people, pairs))
    return 0


def solve_all(people: Numbered, pairs: Sequence[Pair]) -> dict[Cell, dict[str, Marginal]]:
    """Return what gives the four figures in each cell, by what people's laps teach."""
    laps, crowd = learn(people, pairs), Crowd()
    print(f"learnt from {len(pairs)} pairs; noise {laps[0].noise:.3f}, {laps[1].noise:.3f}")
    solved = {}
    for cell in cells():
        solved[cell] = solve(cell, laps, crowd)
        figures = expected(cell, solved[cell], laps, crowd)
        words = [f"{name} {seconds:.1f}" for name, seconds in zip(TARGETS, figures, strict=True)]
        words += [f"{name} {solved[cell][name]}" for name in CALIBRATED]
        print(f"{cell.name}: {', '.join(words)}", flush=True)
    return solved


def learn(people: Numbered, pairs: Sequence[Pair]) -> tuple[LapTime, LapTime]:
    """Return what baseline and limited laps follow from; unfinished ones teach nothing."""
    done = np.array([pair.baseline_done and pair.limited_done for pair in pairs])
    columns = {k: v[done] for k, v in as_columns([traits for _, traits in people]).items()}
    baseline, limited = np.array([(pair.baseline_s, pair.limited_s) for pair in pairs])[done].T
    return LapTime(columns, baseline, lap=1), LapTime(columns, limited, lap=2)


def check(options: argparse.Namespace) -> int:
    """Drive laps of the shipped cohort; return 1 when a figure is missed."""
    people = [(n, person_traits(Cohort(), CHECK_SEED, n)) for n in range(1, options.check + 1)]
    pairs = drive(people, options.keep, jobs=options.jobs, seed=CHECK_SEED)
    missed = False
    for lap in ("baseline", "limited"):
        done = np.array([getattr(p, f"{lap}_s") for p in pairs if getattr(p, f"{lap}_done")])
        print(f"{lap}: {len(done)} of {len(pairs)} laps finished")
        for figure, found, error in (
            ("mean", done.mean(), done.std(ddof=1) / np.sqrt(len(done))),
            ("sd", done.std(ddof=1), standard_error_of_sd(done)),
        ):
            target, allowed = TARGETS[f"{lap} {figure}"], TOLERANCES[figure]
            off = found / target - 1.0
            missed = missed or abs(off) > allowed
            print(
                f"  {figure} {found:.2f} (standard error {error:.2f}), published {target}: "
                f"{off:+.1%}, allowed {allowed:.0%}"
            )
    return int(missed)


def standard_error_of_sd(values: np.ndarray) -> float:
    """Return the standard error of a standard deviation, of any distribution (delta method)."""
    off = values - values.mean()
    return float(np.std(off**2) / (2.0 * off.std() * np.sqrt(len(off))))


if __name__ == "__main__":
    sys.exit(main())
