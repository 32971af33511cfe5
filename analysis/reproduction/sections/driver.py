"""The autonomous driver's lap times."""

from typing import Any

from analysis.report.blocks import Paragraph, Picture, Section, Shown, table
from analysis.report.numbers import count, number, p_value, percent, with_interval
from analysis.reproduction.driver_rows import PARTS, driver_rows
from analysis.reproduction.evidence import Evidence
from analysis.reproduction.figures.lap_times import driver_lap_figure
from analysis.reproduction.lap_times import DEMONSTRATOR, MARGIN


def driver_section(evidence: Evidence) -> Section:
    """Return Figure 3 and the table behind it."""
    times = evidence.lap_times
    shown = times[times["condition"].isin(list(PARTS))]
    paper = {
        row.quantity.removeprefix("rd lap "): row.paper
        for row in driver_rows(times)
        if row.quantity.removeprefix("rd lap ") in PARTS and row.paper is not None
    }
    means = ", ".join(
        f"{row['condition']} {number(row['mean_s'])} s" for row in shown.to_dict("records")
    )
    return Section(
        "driver",
        "Autonomous driver: lap times (Figure 3)",
        (
            Paragraph(
                f"{int(shown['n'].max())} independent replicates, each with its own sensor, "
                "control and start noise, and a model of its own that learns in its own "
                "demonstrations and learns nothing in the laps it helps in. No lap is left out."
            ),
            Picture(
                "driver_lap_times",
                "Lap times of the autonomous driver by condition, every lap a point "
                f"(n = {int(shown['n'].max())} each), with mean and 95% interval, and the paper's "
                "mean. Within a column, points are in the order of the replicates.",
                f"Mean lap times: {means}.",
                driver_lap_figure(evidence.laps.laps, shown, paper),
            ),
            table(
                "driver_lap_times",
                "Lap times by condition; 95% intervals. Takeovers: per lap, mean. Speedup: limited "
                "over condition, ratio of means. "
                f"Behind: condition minus {DEMONSTRATOR}, replicate by replicate, with the "
                f"90% interval of the equivalence test (TOST, margin {MARGIN:g} s; p below .05 "
                "means equivalent). KS: Kolmogorov-Smirnov against the demonstrator, as the paper "
                "tested; with enough laps it rejects any difference, so it has no verdict.",
                times,
                _COLUMNS,
            ),
        ),
    )  # fmt: skip


def _behind(row: dict[str, Any]) -> str:
    return with_interval(row["behind_s"], row["tost_low"], row["tost_high"])


_COLUMNS = [
    Shown("condition", lambda r: r["condition"], words=True),
    Shown("n", lambda r: count(r["n"])),
    Shown("unfinished", lambda r: count(r["unfinished"])),
    Shown("mean s", lambda r: with_interval(r["mean_s"], r["low_s"], r["high_s"])),
    Shown("sd s", lambda r: number(r["sd_s"], 2)),
    Shown("median s", lambda r: number(r["median_s"])),
    Shown("longest s", lambda r: number(r["longest_s"])),
    Shown("takeovers", lambda r: number(r["takeovers"])),
    Shown("speedup", lambda r: percent(r["speedup_percent"])),
    Shown("behind s", _behind),
    Shown("TOST p", lambda r: p_value(r["tost_p"])),
    Shown("KS D", lambda r: number(r["ks"], 3)),
    Shown("KS p", lambda r: p_value(r["ks_p"])),
]
