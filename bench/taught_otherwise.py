"""What the studies `latent-help` and `corrections` found that their reports do not say.

    lad-study run latent-help --seed 6311 --out studies/latent
    lad-study run corrections --seed 6533 --out studies/corrections
    python bench/taught_otherwise.py studies/latent studies/corrections

Of each study: laps minus the participant's demonstrations, takeovers and shares of help; the area
under the ROC curve of `h_inferred` against the true h over demonstrations of which the model was
not told when help was given; and the demonstrator's seconds at the stick.
"""

import argparse
from pathlib import Path

import numpy as np
import pandas as pd

from analysis.measures.discrimination import area_under_roc
from analysis.stats.mean_difference import mean_difference
from protocols.record.reader import Study, open_study


def inferred(study: Study, laps: pd.DataFrame) -> str | None:
    """Return how well h was inferred; None where it never was."""
    aucs, right, steps_in_all = [], 0, 0
    for row in laps[laps["training"]].to_dict("records"):
        steps = study.steps(row["participant"], int(row["lap"])).to_pandas()
        if steps["h_inferred"].isna().all():
            continue
        p, h = steps["h_inferred"].to_numpy(), steps["h"].to_numpy() > 0
        aucs.append(area_under_roc(p, h))
        right, steps_in_all = right + int(((p >= 0.5) == h).sum()), steps_in_all + len(steps)
    if not aucs:
        return None
    high = np.mean(np.array(aucs) >= 0.99)
    return (
        f"h inferred in {len(aucs)} laps: AUC median {np.median(aucs):.4f}, least {min(aucs):.4f}, "
        f"{high:.0%} at least .99; {right / steps_in_all:.2%} of steps right"
    )


def at_the_stick(study: Study, row: pd.Series) -> float:
    """Return for how long the demonstrator's command counted in a lap, s."""
    steps = study.steps(row["participant"], int(row["lap"])).to_pandas()
    period = float(np.median(np.diff(steps["t_s"])))
    return period * float((steps["control"] == "demonstrator").sum())


def describe(folder: Path) -> None:
    """Print a study's figures."""
    study = open_study(folder)
    laps = study.laps.to_pandas()
    laps["hers_s"] = [at_the_stick(study, row) for _, row in laps.iterrows()]
    shown = laps[laps["assistant"] == "demonstrator"].groupby("participant")["duration_s"].mean()
    print(f"{folder}: {study.protocol.name}, {len(shown)} participants, seed {study.seed}")
    for condition, part in laps.groupby("condition", sort=False):
        behind = part.groupby("participant")["duration_s"].mean() - shown
        found = mean_difference(behind.tolist())
        print(
            f"  {condition}: {part['duration_s'].mean():.1f} s, {found.estimate:+.2f} "
            f"({found.low:.2f} to {found.high:.2f}) from the demonstrations, worst "
            f"{behind.max():+.1f}; finished {part['completed'].mean():.0%}, takeovers "
            f"{part['interventions'].mean():.1f} (most {part['interventions'].max()}), help "
            f"{part['assisted_fraction'].mean():.0%}, demonstrator {part['hers_s'].mean():.1f} s"
        )
    found_h = inferred(study, laps)
    if found_h:
        print(f"  {found_h}")


def main() -> None:
    """Describe the studies named."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", nargs="+", type=Path)
    for folder in parser.parse_args().study:
        describe(folder)


if __name__ == "__main__":
    main()
