"""The autonomous driver's lap times by condition (the paper's Figure 3)."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, BLUE, GREEN, GREY, ORANGE, new_figure, tidy

COLOURS = {"baseline": GREY, "limited": ORANGE, "demonstrator": BLUE}
"""By condition; the model's laps are green."""


def driver_lap_figure(
    laps: pd.DataFrame, table: pd.DataFrame, paper: Mapping[str, float]
) -> Figure:
    """Draw every lap as a point, the mean with its 95% interval, and the paper's mean.

    Parameters
    ----------
    laps
        The lap table: condition, lap_time_s.
    table
        As ``analysis.reproduction.lap_times`` returns it; its conditions are drawn in its order.
    paper
        The paper's means by condition, s.
    """
    figure = new_figure(4.2, 7.0)
    axes = figure.subplots()
    for at, row in enumerate(table.to_dict("records")):
        condition = str(row["condition"])
        times = laps.loc[laps["condition"] == condition, "lap_time_s"].dropna().to_numpy(float)
        _condition(axes, at, times, row, paper.get(condition))
    _legend(axes)
    axes.set_xticks(
        range(len(table)),
        [f"{_broken(row['condition'])}\nn = {row['n']}" for row in table.to_dict("records")],
    )
    axes.set_xlim(-0.5, len(table) - 0.3)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("lap time / s")
    tidy(axes, grid="y")
    axes.tick_params(axis="x", labelsize=8)
    figure.legend(loc="outside upper center", ncols=3, frameon=False, fontsize=9)
    return figure


def _condition(
    axes: Axes, at: int, times: np.ndarray, row: Mapping[object, object], paper: float | None
) -> None:
    colour = COLOURS.get(str(row["condition"]), GREEN)
    # Spread in the order driven, always the same way: a place within the column means nothing.
    spread = np.linspace(-0.22, 0.02, len(times)) if len(times) > 1 else np.zeros(len(times))
    axes.scatter(at + spread, times, s=13, color=colour, alpha=0.55, linewidths=0, zorder=2)
    mean, low, high = (float(str(row[name])) for name in ("mean_s", "low_s", "high_s"))
    if np.isfinite(mean):
        ends = [[mean - low], [high - mean]] if np.isfinite(low) else None
        axes.errorbar(
            at + 0.14, mean, yerr=ends, fmt="o", color=colour, markersize=7, capsize=4,
            linewidth=1.8, markeredgecolor=BLACK, markeredgewidth=0.6, zorder=4,
        )  # fmt: skip
        top = high if np.isfinite(high) else mean
        axes.annotate(f"{mean:.1f}", (at + 0.14, top), xytext=(0, 9), fontsize=8,
                      textcoords="offset points", ha="center", va="center")  # fmt: skip
    if paper is not None:
        axes.scatter([at - 0.36], [paper], marker="D", facecolors="white", edgecolors=BLACK,
                     s=34, zorder=5)  # fmt: skip


def _legend(axes: Axes) -> None:
    axes.scatter([], [], s=13, color=GREY, alpha=0.55, linewidths=0, label="a lap")
    axes.errorbar(
        [], [], yerr=[], fmt="o", color=GREY, markersize=7, capsize=4, markeredgecolor=BLACK,
        markeredgewidth=0.6, label="mean, 95% interval",
    )  # fmt: skip
    axes.scatter([], [], marker="D", facecolors="white", edgecolors=BLACK, s=34,
                 label="the paper's mean")  # fmt: skip


def _broken(condition: object) -> str:
    """Return a condition's name in lines short enough for an axis."""
    return str(condition).replace(" after ", "\nafter ")
