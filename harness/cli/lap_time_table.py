"""The table of lap times that is printed after a study has run."""

import math
from pathlib import Path

from rich import box
from rich.table import Table

from harness.cli.console import OUT
from protocols.record.reader import open_study


def print_lap_times(folder: Path) -> None:
    """Print lap times by condition, speedups over the limited laps, and the paper's figures."""
    from analysis.summary import lap_summary

    table = Table(box=box.SIMPLE_HEAD, title="Lap time by condition", title_justify="left")
    table.add_column("condition")
    for heading in ("n", "mean s", "sd", "median", "speedup", "paper s"):
        table.add_column(heading, justify="right")
    for row in lap_summary(open_study(folder)).to_dict("records"):
        unfinished = f" (+{row['unfinished']} unfinished)" if row["unfinished"] else ""
        table.add_row(
            row["condition"],
            f"{row['n']}{unfinished}",
            _number(row["mean_s"]),
            _number(row["sd_s"]),
            _number(row["median_s"]),
            _number(row["speedup_percent"], "%", 0),
            _number(row["paper_mean_s"], places=2),
        )
    OUT.print(table)


def _number(value: float, unit: str = "", places: int = 1) -> str:
    return "-" if math.isnan(value) else f"{value:.{places}f}{unit}"
