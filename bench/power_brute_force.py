"""Power by drawing from a pool against power by simulating whole studies.

    python bench/power_brute_force.py [--protocol FILE] [--n 7] [--studies 300] --out DIR

Simulates as many fresh people as the studies need, cuts them into studies of n, and analyses each
study as its report does: how often each declared analysis is significant is its true power, but for
the error of so many studies. Beside it stands what ``lad-study power`` says from a pool of other
people: with the cohort's own effect, and with the effect stated that all the fresh people show.
Both simulations resume: the same command goes on where it was stopped, and more --studies go on
after fewer. The default protocol has two laps without an assistant, the shipped cohort, and a mild
limitation: an effect between chance and certainty, for little computing (a lap is about 0.25 s of
one core, 300 studies with their pool 20 minutes).
"""

import argparse
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd

from analysis.comparisons import declared_comparisons
from analysis.frames import StudyFrames, study_frames
from analysis.power.pool import pool_of
from analysis.power.power import PowerRow, power_rows
from harness.running.runner import run_study
from harness.session.study_run import StudyRun
from protocols.load import resolve_study
from protocols.record.reader import open_study
from protocols.record.rows import participant_number
from protocols.resolved import ResolvedStudy

PROTOCOL = Path(__file__).with_name("power_two_laps.yaml")
POOL_SEED, FRESH_SEED = 0, 1


def main() -> None:
    """Simulate, analyse, print a table in Markdown."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--protocol", default=str(PROTOCOL))
    parser.add_argument("--n", type=int, default=7)
    parser.add_argument("--studies", type=int, default=300)
    parser.add_argument("--pool", type=int, default=400)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True)
    o = parser.parse_args()
    study = resolve_study(o.protocol)
    pool = simulated(study, o.pool, POOL_SEED, o.out / "pool", o.jobs)
    fresh = simulated(study, o.n * o.studies, FRESH_SEED, o.out / "fresh", o.jobs)
    rejected = [significant(part) for part in whole_studies(fresh, o.n)]
    people = pool_of(pool, study.protocol.analyses)
    everyone = pool_of(fresh, study.protocol.analyses)
    truth = {
        row.analysis: row.effect
        for row in power_rows(study.protocol, everyone, (o.n,), {}, seed=0, studies=1)
    }
    own = power_rows(study.protocol, people, (o.n,), {}, seed=0)
    stated = power_rows(study.protocol, people, (o.n,), truth, seed=0)
    print(f"{len(rejected)} studies of {o.n}; a pool of {people.size}.\n")
    print("| analysis | whole studies | effect from the pool | effect stated |")
    print("|---|---|---|---|")
    for i, (a, b) in enumerate(zip(own, stated, strict=True)):
        share = float(np.mean([found[i] for found in rejected]))
        error = np.sqrt(share * (1 - share) / len(rejected))
        print(f"| {a.analysis} | {share:.3f} ± {error:.3f} | {shown(a)} | {shown(b)} |")


def simulated(study: ResolvedStudy, people: int, seed: int, out: Path, jobs: int) -> StudyFrames:
    """Return people of a study's cohort, each simulated only once."""
    cohort = study.protocol.cohort.model_copy(update={"participants": people})
    enlarged = replace(study, protocol=study.protocol.model_copy(update={"cohort": cohort}))
    run_study(StudyRun(enlarged, seed), out, jobs)
    return study_frames(open_study(out))


def whole_studies(frames: StudyFrames, n: int) -> list[StudyFrames]:
    """Return studies of n people each, in the order of their numbers."""

    def part(table: pd.DataFrame, study: int) -> pd.DataFrame:
        numbers = table["participant"].map(participant_number).astype("int64")
        return table[(numbers - 1) // n == study].reset_index(drop=True)

    return [
        replace(
            frames,
            everybody=part(frames.everybody, study),
            participants=part(frames.participants, study),
            laps=part(frames.laps, study),
            surveys=part(frames.surveys, study),
            answers=part(frames.answers, study),
        )
        for study in range(len(frames.everybody) // n)
    ]


def significant(frames: StudyFrames) -> list[bool]:
    """Return which declared analyses are significant in a study, as its report says."""
    found = declared_comparisons(frames)
    return [(c.p_holm if c.kind == "confirmatory" else c.p_declared) < 0.05 for c in found]


def shown(row: PowerRow) -> str:
    """Return a power with its standard error: of the drawing and of the pool together."""
    return f"{row.power:.3f} ± {np.hypot(row.mc_error, row.pool_error):.3f}"


if __name__ == "__main__":
    main()
