"""The table a person wants to see when a study has been run."""

from pathlib import Path

import pandas as pd
from rich import box
from rich.table import Table

from harness.cli.console import OUT
from protocols.record.reader import open_study


def print_lap_times(folder: Path) -> None:
    """Print lap times by condition, speedups over the limited laps, and the paper's figures."""
    from analysis.summary import lap_summary  # noqa: PLC0415  # slow to import, wanted here only

    table = Table(box=box.SIMPLE_HEAD, title="Lap time by condition", title_justify="left")
    table.add_column("condition")
    for heading in ("n", "mean s", "sd", "median", "speedup", "paper s"):
        table.add_column(heading, justify="right")
    for row in lap_summary(open_study(folder)).itertuples():
        finished = f"{row.n}" if not row.unfinished else f"{row.n} (+{row.unfinished} unfinished)"
        table.add_row(
            str(row.condition),
            finished,
            _number(row.mean_s),
            _number(row.sd_s),
            _number(row.median_s),
            _number(row.speedup_percent, "%", 0),
            _number(row.paper_mean_s),
        )
    OUT.print(table)


def _number(value: object, unit: str = "", places: int = 1) -> str:
    number = float(str(value))
    return "-" if pd.isna(number) else f"{number:.{places}f}{unit}"
