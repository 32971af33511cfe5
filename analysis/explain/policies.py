"""What the models of a study have learnt about helping, over its participants."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import pandas as pd

from analysis.explain.demonstrators import demonstrated, demonstrators_of, disagreement
from analysis.explain.dependence import dependence
from analysis.explain.moments import unsure_sections
from analysis.explain.recorded import Looked, learnt_model, looked_at
from analysis.randomness import generator
from analysis.stats.mean_difference import mean_difference
from lad.lad_assistant import LADAssistant
from protocols.files.errors import InputError
from protocols.record.reader import Study

MOST_PARTICIPANTS = 24
REPEATS, STEPS = 2, 60
"""Fewer than for one participant: the interval is over people, not over exchanges."""


@dataclass(frozen=True)
class Policies:
    """What was found.

    Attributes
    ----------
    participants
        Whose models were asked.
    dependence
        ``input``, ``when``, ``how`` and their 95% intervals over participants; see
        ``analysis.explain.dependence``.
    sections
        ``section``, ``helping``, ``undecided`` and ``spread``, means over participants; see
        ``analysis.explain.moments``.
    demonstrators
        ``pair`` and the columns of ``analysis.explain.demonstrators.disagreement``; empty where
        one person taught.
    """

    participants: tuple[str, ...]
    dependence: pd.DataFrame
    sections: pd.DataFrame
    demonstrators: pd.DataFrame


def asked_laps(study: Study, participant: str) -> list[int]:
    """Return the laps after a participant's first teaching in which nothing is learnt."""
    laps = study.laps.to_pandas()
    own = laps[laps["participant"] == participant].sort_values("lap")
    first = own.loc[own["training"], "lap"].min()
    return [int(lap) for lap in own.loc[(own["lap"] > first) & ~own["training"], "lap"]]


def policies(study: Study, participants: list[str]) -> Policies | None:
    """Ask the models of these participants, the first 24; None where there is none to ask.

    Parameters
    ----------
    study
        As recorded.
    participants
        Ids. Those who left no model of ours, or drove no lap after it was taught, are left out.
    """
    tables, sections, asked = [], [], []
    rng = generator(study, "policies")
    for participant in participants[:MOST_PARTICIPANTS]:
        known = _known(study, participant)
        if known is None:
            continue
        model, looked = known
        table = dependence(model, looked, rng, REPEATS, STEPS)
        tables.append(table.assign(participant=participant))
        sections.append(unsure_sections(model, looked).assign(participant=participant))
        asked.append(participant)
    if not asked:
        return None
    means = pd.concat(sections).groupby("section", sort=False)[["helping", "undecided", "spread"]]
    return Policies(
        tuple(asked), _over_people(pd.concat(tables)), means.mean().reset_index(),
        _disagreements(study, tuple(asked)),
    )  # fmt: skip


def _known(study: Study, participant: str) -> tuple[LADAssistant, Looked] | None:
    """Return a participant's model and what it looked at; None where there is nothing to ask."""
    try:
        model = learnt_model(study, participant)
    except InputError:
        return None
    asked = asked_laps(study, participant)
    if not asked:
        return None
    looked = looked_at(study, participant, asked, model.parameters.recursion_depth)
    inputs = looked.windows[:, 0]
    known = looked.steps[["p_help", "variance"]].notna().to_numpy().all(axis=1)
    usable = np.flatnonzero(np.isfinite(inputs).all(axis=1) & known)
    if len(usable) < 2:
        return None
    return model, Looked(looked.windows[usable], looked.steps.iloc[usable].reset_index(drop=True))


def _over_people(tables: pd.DataFrame) -> pd.DataFrame:
    rows = []
    for name, part in tables.groupby("input", sort=False):
        row: dict[str, object] = {"input": name}
        for which in ("when", "how"):
            result = mean_difference(part[which].dropna().tolist())
            row |= {
                which: result.estimate,
                f"{which}_low": result.low,
                f"{which}_high": result.high,
            }
        rows.append(row)
    return pd.DataFrame(rows)


def _disagreements(study: Study, participants: tuple[str, ...]) -> pd.DataFrame:
    who = demonstrators_of(study.protocol)
    if len(who) < 2:
        return pd.DataFrame()
    shown = demonstrated(study, participants)
    pairs = combinations(who, 2)
    tables = [disagreement(shown, a, b).assign(pair=f"{a} minus {b}") for a, b in pairs]
    return pd.concat(tables, ignore_index=True)
