"""Where the model is unsure, and which demonstrated moments its takeovers lean on."""

import numpy as np
import pandas as pd

from analysis.explain.recorded import Looked
from analysis.measures.episodes import episodes
from lad.explanation import explain
from lad.lad_assistant import LADAssistant
from lad.latent import LEAST_STEPS
from protocols.record.reader import Study

UNDECIDED = 0.1
"""p(h) within this of the threshold is undecided."""


def unsure_sections(model: LADAssistant, looked: Looked) -> pd.DataFrame:
    """Return, by section of the course, how sure the model was in recorded laps.

    Returns
    -------
    DataFrame
        ``section``, ``steps``, ``helping`` (share with p(h) at the threshold or above),
        ``undecided`` (share with p(h) within a tenth of it) and ``spread`` (root of the
        mean variance of the command it predicts, m/s and rad/s).
    """
    rows = []
    for section, steps in looked.steps.groupby("section", sort=False):
        p = steps["p_help"].to_numpy(dtype=np.float64)
        off = p - model.parameters.threshold
        rows.append(
            {
                "section": section,
                "steps": len(p),
                "helping": float((off >= 0).mean()),
                "undecided": float((np.abs(off) < UNDECIDED).mean()),
                "spread": float(np.sqrt(steps["variance"].to_numpy(dtype=np.float64).mean())),
            }
        )
    return pd.DataFrame(rows)


def leaned_on(
    model: LADAssistant, looked: Looked, study: Study, participant: str, most: int = 3
) -> pd.DataFrame:
    """Return the demonstrated moments behind the command at the start of each takeover.

    Returns
    -------
    DataFrame
        ``lap``, ``t_s`` and ``section`` of the takeover; ``rank``, ``shown_lap``, ``shown_t_s``
        and ``shown_section`` of the moment, its ``likeness`` (0 to 1) and ``turn``, its
        contribution to the turn rate in rad/s.
    """
    life = _life(study, participant)
    shown: dict[int, pd.DataFrame] = {}
    rows = []
    for start, _ in episodes((looked.steps["control"] == "model").to_numpy()):
        model.answer_at(looked.windows[start])
        now = looked.steps.iloc[start]
        for rank, one in enumerate(explain(model.how, most), start=1):
            then_lap, begins = life[one.lap]
            if then_lap not in shown:
                columns = ["t_s", "section"]
                shown[then_lap] = study.steps(participant, then_lap, columns).to_pandas()
            then = shown[then_lap].iloc[one.time - begins]
            rows.append(
                {
                    "lap": int(now["lap"]), "t_s": float(now["t_s"]), "section": now["section"],
                    "rank": rank, "shown_lap": then_lap, "shown_t_s": float(then["t_s"]),
                    "shown_section": then["section"], "likeness": one.likeness,
                    "turn": float(one.contribution[1]),
                }
            )  # fmt: skip
    return pd.DataFrame(rows)


def _life(study: Study, participant: str) -> list[tuple[int, int]]:
    """Return the laps of the model's life: the recorded lap, and how many steps it saw before.

    A lap of which it was not told when help was given it has seen twice, when it was driven and
    when it was learnt (``harness.session.latent_teaching``).
    """
    laps = study.laps.to_pandas()
    laps = laps[laps["participant"] == participant].sort_values("lap")
    life: list[tuple[int, int]] = []
    before = 0
    for row in laps.to_dict("records"):
        condition = study.protocol.conditions.get(row["condition"])
        latent = condition is not None and condition.latent_h is not None
        twice = latent and row["steps"] >= LEAST_STEPS
        for _ in range(2 if twice else 1):
            life.append((int(row["lap"]), before))
            before += int(row["steps"])
    return life
