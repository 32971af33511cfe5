"""Where on the course help was given: shares by section."""

import pandas as pd

from analysis.frames import StudyFrames, on_own_course
from analysis.lap_records import LapRecords
from protocols.course.centreline import Centreline


def section_table(frames: StudyFrames, records: LapRecords) -> pd.DataFrame:
    """Return one row per section of the course and assisted condition.

    Of those who drove the study's own course.

    Columns: section, kind, condition, steps, ``assisted_percent`` (of the steps in the section),
    ``share_of_assistance_percent`` (of all assisted steps in the condition), and
    ``would_percent`` (steps in which the shadow demonstrator would have helped).
    """
    steps = on_own_course(frames, records.steps)
    rows = []
    for part in frames.parts:
        if part.role not in ("demonstrator", "model"):
            continue
        laps = steps[(steps["condition"] == part.condition) & steps["helped"].notna()]
        total = float(laps["helped"].sum())
        for section in Centreline(frames.study.course).sections:
            here = laps[laps["section"] == section.name]
            helped = float(here["helped"].sum())
            shadowed = here["h_would"].dropna()
            rows.append(
                {
                    "section": section.name,
                    "kind": section.kind,
                    "condition": part.condition,
                    "role": part.role,
                    "steps": len(here),
                    "assisted_percent": _percent(helped, len(here)),
                    "share_of_assistance_percent": _percent(helped, total),
                    "would_percent": _percent((shadowed > 0).sum(), len(shadowed)),
                }
            )
    columns = ["section", "kind", "condition", "role", "steps", "assisted_percent",
               "share_of_assistance_percent", "would_percent"]  # fmt: skip
    return pd.DataFrame(rows, columns=columns)


def _percent(part: float, whole: float) -> float:
    return 100 * float(part) / whole if whole else float("nan")
