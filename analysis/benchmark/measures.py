"""What one assistant did in one setting: a row of measures for each replicate and helped lap."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from analysis.measures.discrimination import brier_score
from analysis.measures.episodes import episodes
from analysis.measures.streams import Steps, stream, words
from protocols.benchmark import ALONE, DEMONSTRATION, TEST
from protocols.record.reader import Study

CHATTER_S = 0.5
"""A takeover shorter than this is chatter, s."""

Z90 = 1.6448536269514722
"""Half the width of a central 90% interval, in standard deviations of a Gaussian."""

MEASURES: dict[str, str] = {
    "lap_s": "lap time, s",
    "minus_demonstrator_s": "lap time minus the demonstrator's mean, s; an unfinished lap counts "
    "as long as it took, one from which the person withdrew not at all",
    "minus_alone_s": "lap time minus the lap alone, s",
    "finished": "whether the lap reached its last gate",
    "takeovers": "unbroken stretches of help",
    "chatter": "of these, shorter than half a second",
    "brier_own": "Brier score of p(h) in the lap it drives itself, against what the demonstrator "
    "would do",
    "brier_demonstrated": "Brier score of p(h) in the next lap that the demonstrator helps",
    "p_at_onset": "p(h) in the step in which the demonstrator takes over, mean over that lap",
    "coverage_90": "share of that lap's demonstrated commands inside the 90% interval",
    "log_density": "mean log density of these commands, nats per (m/s)(rad/s)",
    "help_elsewhere": "share of steps with help in soft bends and turns to the free side",
}
"""Every measure, and what it is."""


def measures_of(study: Study, free_side: str | None = "left") -> pd.DataFrame:
    """Return a row for each replicate and number of demonstrations.

    Parameters
    ----------
    study
        Of a benchmark (``protocols.benchmark``).
    free_side
        Kind of section, besides soft bends, in which no help is needed; None for none.

    Returns
    -------
    DataFrame
        ``participant``, ``demonstrations`` and the columns of ``MEASURES``; NaN where an
        assistant says no probability or variance, or no demonstration follows.
    """
    laps = study.laps.to_pandas()
    rows = [
        row
        for participant, own in laps.groupby("participant", sort=False)
        for row in _of_participant(study, str(participant), own, free_side)
    ]
    return pd.DataFrame(rows, columns=["participant", "demonstrations", *MEASURES])


def _of_participant(
    study: Study, participant: str, laps: pd.DataFrame, free_side: str | None
) -> Iterator[dict[str, Any]]:
    shown = laps[laps["condition"].isin([DEMONSTRATION, TEST])]
    demonstrator = float(shown["duration_s"].mean())
    alone = float(laps.loc[laps["condition"] == ALONE, "duration_s"].mean())
    for _, lap in laps[laps["assistant"] == "model"].iterrows():
        steps = Steps(study.steps(participant, int(lap["lap"])))
        later = shown.loc[shown["lap"] > lap["lap"], "lap"]
        following = Steps(study.steps(participant, int(later.iloc[0]))) if len(later) else None
        withdrew = lap.get("end_reason") == "withdrew"  # when it was left says nothing of help
        duration = math.nan if withdrew else float(lap["duration_s"])
        yield {
            "participant": participant,
            "demonstrations": int(str(lap["condition"]).split()[-1]),
            "lap_s": duration,
            "minus_demonstrator_s": duration - demonstrator,
            "minus_alone_s": duration - alone,
            "finished": float(lap["completed"]),
            "takeovers": lap["interventions"],
            **_in_its_own(steps, free_side),
            **_before_it_learnt(following),
        }


def _in_its_own(steps: Steps, free_side: str | None) -> dict[str, float]:
    helping = words(steps, "control") == "model"
    period = float(np.median(np.diff(stream(steps, "t_s"))))
    lengths = [(stop - start) * period for start, stop in episodes(helping)]
    free = np.isin(words(steps, "section_kind"), np.array(["soft_right", free_side], object))
    return {
        "chatter": float(sum(length < CHATTER_S - 1e-9 for length in lengths)),
        "brier_own": brier_score(steps),
        "help_elsewhere": float(helping[free].mean()) if free.any() else math.nan,
    }


def _before_it_learnt(steps: Steps | None) -> dict[str, float]:
    if steps is None:
        return {}
    helped = stream(steps, "h") > 0
    p = stream(steps, "p_help")
    onsets = [start for start, _ in episodes(helped)]
    errors = [stream(steps, f"a_{c}")[helped] - stream(steps, f"mean_{c}")[helped] for c in "vw"]
    variance = stream(steps, "variance")[helped]
    inside = [np.abs(e) <= Z90 * np.sqrt(variance) for e in errors]
    density = -np.log(2.0 * math.pi * variance) - 0.5 * (errors[0] ** 2 + errors[1] ** 2) / variance
    known = bool(helped.any()) and not np.isnan(variance).any()
    return {
        "brier_demonstrated": brier_score(steps),
        "p_at_onset": float(p[onsets].mean()) if onsets else math.nan,
        "coverage_90": float(np.mean(inside)) if known else math.nan,
        "log_density": float(density.mean()) if known else math.nan,
    }
