"""Interventions and driving: every measure by condition."""

from typing import Any

import pandas as pd

from analysis.measures.registry import MEASURES, measure
from analysis.report.blocks import Paragraph, Section, Shown, table
from analysis.report.numbers import NOTHING, number
from analysis.results import StudyResults


def measure_section(results: StudyResults) -> Section:
    """Return means and standard deviations of all measures, and what each of them is."""
    meanings = pd.DataFrame(
        [{"measure": m.title, "unit": m.unit, "meaning": m.meaning, "source": m.source}
         for m in MEASURES]
    )  # fmt: skip
    wide = _wide(results.measures)
    return Section(
        "measures",
        "Interventions and driving",
        (
            Paragraph(
                "Measures of single laps, computed from the recorded steps of finished laps. The "
                "shadow demonstrator is what the demonstrator would have done in laps it did not "
                "drive."
            ),
            table("measures_by_condition", "Mean (standard deviation; n) by condition.", wide,
                  [Shown("measure", _title, words=True),
                   *(_column(c) for c in results.frames.conditions)]),
            table("measures", "What each measure is.", meanings, _MEANINGS, folded=True),
        ),
    )  # fmt: skip


def _wide(measures: pd.DataFrame) -> pd.DataFrame:
    rows: dict[str, dict[str, Any]] = {}
    for found in measures.to_dict("records"):
        row = rows.setdefault(found["measure"], {"measure": found["measure"]})
        row |= {f"{found['condition']} {what}": found[what] for what in ("mean", "sd", "n")}
    return pd.DataFrame(list(rows.values()))


def _title(row: dict[str, Any]) -> str:
    m = measure(row["measure"])
    return f"{m.title} / {m.unit}" if m.unit else m.title


def _column(condition: str) -> Shown:
    def cell(row: dict[str, Any]) -> str:
        n = int(row[f"{condition} n"])
        if not n:
            return NOTHING
        mean, sd = row[f"{condition} mean"], row[f"{condition} sd"]
        return f"{number(mean, 2)} ({number(sd, 2)}; {n})"

    return Shown(condition, cell)


_MEANINGS = [
    Shown("measure", lambda r: r["measure"], words=True),
    Shown("unit", lambda r: r["unit"] or "1", words=True),
    Shown("meaning", lambda r: r["meaning"], words=True),
    Shown("source", lambda r: r["source"] or NOTHING, words=True),
]
