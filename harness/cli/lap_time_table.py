"""The table of lap times that is printed after a study has run."""

import math
from typing import TYPE_CHECKING

from rich import box
from rich.table import Table

from harness.cli.console import print_table

if TYPE_CHECKING:
    from analysis.results import StudyResults


def print_lap_times(results: "StudyResults") -> None:
    """Print lap times by condition, speedups, and the published figures of a study replicated."""
    from analysis.summary import lap_summary

    table = Table(box=box.SIMPLE_HEAD, title="Lap time by condition", title_justify="left")
    table.add_column("condition")
    paper = results.frames.study.protocol.replicates is not None
    for heading in ("n", "mean s", "sd", "median", "speedup", *(("paper s",) if paper else ())):
        table.add_column(heading, justify="right", no_wrap=True)
    for row in lap_summary(results).to_dict("records"):
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
    print_table(table)


def _number(value: float, unit: str = "", places: int = 1) -> str:
    return "-" if math.isnan(value) else f"{value:.{places}f}{unit}"
