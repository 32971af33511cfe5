"""Where the model is unsure, and which demonstrated moments its takeovers lean on."""

import numpy as np
import pandas as pd

from analysis.explain.recorded import Looked
from analysis.measures.episodes import episodes
from lad.explanation import explain
from lad.lad_assistant import LADAssistant
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
    laps = study.laps.to_pandas()
    laps = laps[laps["participant"] == participant].sort_values("lap")
    begins = dict(zip(laps["lap"], laps["steps"].cumsum() - laps["steps"], strict=True))
    shown: dict[int, pd.DataFrame] = {}
    rows = []
    for start, _ in episodes((looked.steps["control"] == "model").to_numpy()):
        model.answer_at(looked.windows[start])
        now = looked.steps.iloc[start]
        for rank, one in enumerate(explain(model.how, most), start=1):
            if one.lap not in shown:
                columns = ["t_s", "section"]
                shown[one.lap] = study.steps(participant, one.lap, columns).to_pandas()
            then = shown[one.lap].iloc[one.time - int(begins[one.lap])]
            rows.append(
                {
                    "lap": int(now["lap"]), "t_s": float(now["t_s"]), "section": now["section"],
                    "rank": rank, "shown_lap": one.lap, "shown_t_s": float(then["t_s"]),
                    "shown_section": then["section"], "likeness": one.likeness,
                    "turn": float(one.contribution[1]),
                }
            )  # fmt: skip
    return pd.DataFrame(rows)
