"""Data appendix: the codebook, and what is missing."""

from typing import Any

import pandas as pd

from analysis.frames import as_frame
from analysis.report.blocks import Block, Paragraph, Section, Shown, table
from analysis.report.numbers import NOTHING, count
from analysis.results import StudyResults
from protocols.record.codebook import codebook


def data_section(results: StudyResults) -> Section:
    """Return every column of the record, its unit and meaning, and its missing values."""
    missing = _missing(results)
    blocks: list[Block] = [
        Paragraph(
            "The study directory holds the data behind this page: participants.parquet, "
            "laps.parquet, surveys.parquet, and one step table per lap under sessions/. Beside "
            "this page: tables as CSV with full precision, figures as SVG and PNG, and every "
            "statistic in statistics.json."
        ),
        table("missing_data", "Columns with missing values, over all recorded participants; "
              "columns that are complete are left out.", missing, _MISSING),
    ]  # fmt: skip
    for name, columns in codebook()["tables"].items():
        frame = pd.DataFrame(columns)
        blocks.append(table(f"codebook_{name}", f"Codebook: {name}.", frame, _CODE, folded=True))
    return Section("data", "Data", tuple(blocks))


def _missing(results: StudyResults) -> pd.DataFrame:
    study = results.frames.study
    rows: list[dict[str, Any]] = []
    for name, frame in (
        ("participants", results.frames.everybody),
        ("laps", as_frame(study.laps)),
        ("surveys", results.frames.answers),
    ):
        for column in frame.columns:
            absent = int(frame[column].isna().sum())
            if absent:
                rows.append(
                    {"table": name, "column": column, "missing": absent, "rows": len(frame)}
                )
    return pd.DataFrame(rows, columns=["table", "column", "missing", "rows"])


_MISSING = [
    Shown("table", lambda r: r["table"], words=True),
    Shown("column", lambda r: r["column"], words=True),
    Shown("missing", lambda r: count(r["missing"])),
    Shown("of", lambda r: count(r["rows"])),
]
_CODE = [
    Shown("column", lambda r: r["name"], words=True),
    Shown("type", lambda r: r["type"], words=True),
    Shown("unit", lambda r: r["unit"] or NOTHING, words=True),
    Shown("meaning", lambda r: r["description"], words=True),
    Shown("allowed", lambda r: r["allowed"] or NOTHING, words=True),
    Shown("may be missing", lambda r: "yes" if r["nullable"] else "no", words=True),
]
