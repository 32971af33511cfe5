"""The table of lap times that is printed after a study has run."""

import math
from pathlib import Path

from rich import box
from rich.table import Table

from harness.cli.console import OUT
from protocols.record.reader import open_study


def print_lap_times(folder: Path) -> None:
    """Print lap times by condition, speedups, and the published figures of a study replicated."""
    from analysis.summary import lap_summary

    table = Table(box=box.SIMPLE_HEAD, title="Lap time by condition", title_justify="left")
    table.add_column("condition")
    study = open_study(folder)
    paper = study.protocol.replicates is not None
    for heading in ("n", "mean s", "sd", "median", "speedup", *(("paper s",) if paper else ())):
        table.add_column(heading, justify="right")
    for row in lap_summary(study).to_dict("records"):
        unfinished = f" (+{row['unfinished']} unfinished)" if row["unfinished"] else ""
        table.add_row(
            row["condition"],
            f"{row['n']}{unfinished}",
            _number(row["mean_s"]),
            _number(row["sd_s"]),
            _number(row["median_s"]),
            _number(row["speedup_percent"], "%", 0),
            *((_number(row["paper_mean_s"], places=2),) if paper else ()),
        )
    OUT.print(table)


def _number(value: float, unit: str = "", places: int = 1) -> str:
    return "-" if math.isnan(value) else f"{value:.{places}f}{unit}"
