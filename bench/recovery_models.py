"""The study `recovery` with other models than its own: help given against help needed.

    python bench/recovery_models.py --seed 8123 --out studies/recovery-models

Runs the shipped study once for each model, with the same people, noise and demonstrations, and
prints one table. A run that was stopped goes on where it was when the same command is given again.
"""

import argparse
from dataclasses import replace
from pathlib import Path

from analysis.stats.mean_difference import mean_difference
from harness.running.runner import run_study
from harness.session.study_run import StudyRun
from lad.hyperparameters import LADParameters
from protocols.load import resolve_study
from protocols.model_choice import ModelChoice
from protocols.record.reader import open_study
from protocols.shipped_parts import CORRECTION, LAD

CAUTIOUS = LADParameters(prior_help=0.35)
MODELS = {
    "lad-correction-.35": ModelChoice(use=CORRECTION, parameters=CAUTIOUS),
    "lad-correction": ModelChoice(use=CORRECTION),
    "lad": ModelChoice(use=LAD),
    "lad-.35": ModelChoice(use=LAD, parameters=CAUTIOUS),
    "neighbours": ModelChoice(use="neighbours"),
    "linear": ModelChoice(use="linear"),
    "network-refitted": ModelChoice(use="network-refitted"),
}
"""By folder: .35 is `prior_help`, .5 elsewhere. The first is the study's own."""

COMPARED = (
    ("helped at 0.15", "alone at 0.15"),
    ("helped at 0.3", "alone at 0.3"),
    ("helped at 0.5", "alone at 0.5"),
    ("helped at 0.5 after abstention", "alone at 0.5"),
    ("helped at 0.15 after abstention", "alone at 0.15"),
)


def rows(name: str, folder: Path) -> list[str]:
    """Return the lines of a model's part of the table."""
    laps = open_study(folder).laps.to_pandas()
    times, shares, ends = (
        laps.pivot_table(index="participant", columns="condition", values=value)
        for value in ("duration_s", "assisted_fraction", "completed")
    )
    lines = []
    for helped, alone in COMPARED:
        found = mean_difference((times[helped] - times[alone]).tolist())
        cells = (
            name, helped.removeprefix("helped at "), str(len(times)), f"{times[alone].mean():.1f}",
            f"{times[helped].mean():.1f}",
            f"{found.estimate:+.2f} ({found.low:.2f} to {found.high:.2f})",
            f"{shares[helped].mean():.1%}", f"{ends[helped].mean():.0%}",
        )  # fmt: skip
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def main() -> None:
    """Run what is missing, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=Path("studies/recovery-models"))
    parser.add_argument("--participants", type=int, default=16)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--model", action="append", choices=MODELS, help="only these")
    args = parser.parse_args()
    study = resolve_study("recovery", participants=args.participants)
    head = ("model", "right turns, rad/s", "n", "alone, s", "helped, s", "minus alone, s (95%)",
            "steps with help", "finished")  # fmt: skip
    table = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for name in args.model or MODELS:
        protocol = study.protocol.model_copy(update={"model": MODELS[name]})
        run = StudyRun(replace(study, protocol=protocol), args.seed)
        outcome = run_study(run, args.out / name, args.jobs)
        if outcome.failed:
            raise SystemExit(f"{name}: {len(outcome.failed)} sessions failed: {args.out / name}")
        table += rows(name, args.out / name)
    print("\n".join(table))


if __name__ == "__main__":
    main()
