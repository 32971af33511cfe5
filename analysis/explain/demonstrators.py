"""How the demonstrators who taught one model differ: where they help, when, and how they turn."""

import math
from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from analysis.measures.episodes import episodes
from analysis.measures.streams import Steps, stream, words
from analysis.stats.mean_difference import mean_difference
from protocols.record.reader import Study
from protocols.study import StudyProtocol

OWN = "own"
MEASURES: Mapping[str, str] = {
    "share": "share of steps with help",
    "begins_m": "where help begins, m along the course",
    "speed": "speed while helping, m/s",
    "turn": "turn rate while helping, rad/s",
    "surprise": "log density of its commands before they were learnt, nats",
}
"""What is compared, by section of the course in which help begins or is given."""


def demonstrators_of(protocol: StudyProtocol) -> tuple[str, ...]:
    """Return who teaches the model, in the order of their first lap."""
    taught = [protocol.conditions[lap.condition] for lap in protocol.laps]
    return tuple(dict.fromkeys(c.demonstrator for c in taught if c.training))


def demonstrated(study: Study, participants: tuple[str, ...] | None = None) -> pd.DataFrame:
    """Return what each demonstrator showed, one row for each of a participant's laps and sections.

    Parameters
    ----------
    study
        With training laps.
    participants
        Only these; None for all.

    Returns
    -------
    DataFrame
        ``participant``, ``demonstrator``, ``lap``, ``section`` and the columns of ``MEASURES``;
        sections in which nobody helped are left out.
    """
    laps = study.laps.to_pandas()
    laps = laps[laps["training"] & laps["completed"]]
    if participants is not None:
        laps = laps[laps["participant"].isin(participants)]
    conditions = study.protocol.conditions
    rows = []
    for lap in laps.to_dict("records"):
        condition = conditions.get(lap["condition"])
        if condition is None or condition.assistant != "demonstrator":
            continue  # in a lap of corrections help is given only where the model fell short
        who = {"participant": lap["participant"], "demonstrator": condition.demonstrator}
        steps = Steps(study.steps(lap["participant"], int(lap["lap"])))
        rows += [who | {"lap": lap["lap"]} | row for row in _by_section(steps)]
    columns = ["participant", "demonstrator", "lap", "section", *MEASURES]
    return pd.DataFrame(rows, columns=columns)


def _by_section(steps: Steps) -> Iterator[dict[str, float | str]]:
    helped = stream(steps, "h") > 0
    section = words(steps, "section")
    arc = stream(steps, "arc_m")
    begins: dict[object, float] = {}
    for start, _ in episodes(helped):
        begins.setdefault(section[start], float(arc[start]))
    density = _log_density(steps)
    for name in dict.fromkeys(section):
        here, with_help = section == name, (section == name) & helped
        if not with_help.any():
            continue
        known = density[with_help & ~np.isnan(density)]
        yield {
            "section": str(name),
            "share": float(helped[here].mean()),
            "begins_m": begins.get(name, math.nan),
            "speed": float(stream(steps, "a_v")[with_help].mean()),
            "turn": float(stream(steps, "a_w")[with_help].mean()),
            "surprise": float(known.mean()) if len(known) else math.nan,
        }


def _log_density(steps: Steps) -> np.ndarray:
    """Return the log density of each demonstrated command as predicted before it was learnt."""
    squares = sum(np.square(stream(steps, f"a_{c}") - stream(steps, f"mean_{c}")) for c in "vw")
    variance = stream(steps, "variance")
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.asarray(-np.log(2.0 * math.pi * variance) - 0.5 * squares / variance)


def disagreement(shown: pd.DataFrame, one: str, other: str) -> pd.DataFrame:
    """Return by how much one demonstrator differs from another, section by section.

    Differences are taken within participants, each demonstrator's laps averaged first; with one
    participant there is a difference and no interval.

    Parameters
    ----------
    shown
        As ``demonstrated`` returns it.
    one, other
        Names of demonstrators.

    Returns
    -------
    DataFrame
        ``section``, ``measure``, the means ``one`` and ``other``, ``difference`` (one minus other),
        its 95% interval ``low`` to ``high``, and ``n`` participants.
    """
    means = shown.groupby(["section", "participant", "demonstrator"], sort=False)[list(MEASURES)]
    averaged = means.mean().reset_index()
    rows = []
    for section, part in averaged.groupby("section", sort=False):
        for measure in MEASURES:
            wide = part.pivot_table(index="participant", columns="demonstrator", values=measure)
            pairs = wide.reindex(columns=[one, other]).dropna()
            if pairs.empty:
                continue
            result = mean_difference((pairs[one] - pairs[other]).tolist())
            rows.append(
                {
                    "section": section, "measure": measure, "one": float(pairs[one].mean()),
                    "other": float(pairs[other].mean()), "difference": result.estimate,
                    "low": result.low, "high": result.high, "n": len(pairs),
                }
            )  # fmt: skip
    columns = ["section", "measure", "one", "other", "difference", "low", "high", "n"]
    return pd.DataFrame(rows, columns=columns)
