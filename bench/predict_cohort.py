"""Predict the assisted laps over the declared grid, and report where the paper's figures are.

    python bench/predict_cohort.py                        2,400 people a cell: half a day and more
    python bench/predict_cohort.py --people 396 --jobs 2 --centre STUDY   what docs/cohort.md
                                shows, more than an hour; STUDY is a four-lap study of 1,000

A cell's people (bench/cohort/cells.json) drive the shipped study, all five laps through the
session that all laps go through. 200 studies of twelve are drawn from them. With 2,400 people
the studies could be 200 different dozens; with fewer, they share people, and intervals come out
slightly too narrow.
"""

import argparse
import sys
from pathlib import Path

import single_thread  # noqa: F401  # before anything that imports numpy

# isort: split
import joblib
import numpy as np
import pandas as pd
from cohort.grid import Cell, cells, load
from cohort.sessions import laps_of, laps_of_study
from cohort.studies import CONDITIONS, PUBLISHED, as_far_out, draw_studies, predict, table

STUDIES, SIZE, SEED = 200, 12, 1

FULL = 2400
"""People per cell with which no two studies need to share a person."""


def main() -> int:
    """Read the command line and do it."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--people", type=int, default=FULL, help="people a cell")
    parser.add_argument("--keep", type=Path, default=Path("studies/cohort-predictions"))
    parser.add_argument("--only-centre", action="store_true")
    parser.add_argument(
        "--centre", type=Path, metavar="STUDY", help="a four-lap study: its people are the centre's"
    )
    parser.add_argument("--csv", type=Path, help="where to write the predictions")
    parser.add_argument("--jobs", type=int, default=1, help="cells that drive at the same time")
    options = parser.parse_args()
    solved, rows = load(), []
    asked = list(cells())[: 1 if options.only_centre else None]
    if options.centre:
        rows += report(asked.pop(0), laps_of_study(options.centre))
    workers = joblib.Parallel(n_jobs=options.jobs, return_as="generator", pre_dispatch=options.jobs)
    pools = workers(
        joblib.delayed(laps_of)(
            cell,
            solved[cell],
            options.people,
            options.keep / f"{cell.practice:g}-{cell.corners:g}.csv",
        )
        for cell in asked
    )
    for cell, laps in zip(asked, pools, strict=True):
        rows += report(cell, laps)
    if options.csv:
        pd.DataFrame(rows).to_csv(options.csv, index=False)
    return 0


def report(cell: Cell, laps: pd.DataFrame) -> list[dict[str, object]]:
    """Print what a cell predicts, and return it."""
    times = table(laps)
    studies = draw_studies(times, STUDIES, SIZE, SEED)
    slowest = times.dropna().idxmax(axis=1) == "limited"
    ends = laps[~laps["completed"]]["end_reason"].value_counts().to_dict()
    print(f"\n{cell.name}: {len(times)} people; unfinished laps: {ends or 'none'}")
    print(f"limited lap slowest for {slowest.mean():.0%} of those with all four laps")
    pool = ", ".join(f"{c} {times[c].mean():.1f} ({times[c].std():.1f})" for c in CONDITIONS)
    print(f"all people: {pool}")
    print("| figure | median of studies | 95% of studies | published | studies below it |")
    print("|---|---:|---:|---:|---:|")
    rows = []
    for name, found in predict(studies).items():
        columns = (
            name,
            f"{found.median:.2f}",
            f"{found.low:.2f} to {found.high:.2f}",
            f"{PUBLISHED[name]:g}",
            f"{found.below:.0%}",
        )
        print(f"| {' | '.join(columns)} |")
        rows.append(
            {"practice": cell.practice, "corners": cell.corners, "figure": name, **vars(found)}
        )
    far = as_far_out(studies)
    print(f"studies at least as far out as the paper in its three predicted figures: {far:.1%}")
    rows.append(
        {
            "practice": cell.practice,
            "corners": cell.corners,
            "figure": "as far out as the paper",
            "median": far,
            **dict.fromkeys(("low", "high", "below"), np.nan),
        }
    )
    return rows


if __name__ == "__main__":
    sys.exit(main())
