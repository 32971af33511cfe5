"""Lap times by condition, every participant a line (the paper's Figure 6)."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, GREY, VERMILLION, WIDTH, colours, new_figure, tidy
from analysis.figures.text import label_lines, label_room
from analysis.roles import Part
from analysis.stats.describe import describe


def lap_time_figure(
    laps: pd.DataFrame, parts: Sequence[Part], paper: Mapping[str, float]
) -> Figure:
    """Draw lap times by condition.

    Parameters
    ----------
    laps
        The analysed laps: participant, condition, completed, lap_time_s, duration_s.
    parts
        The conditions, from left to right.
    paper
        The paper's means by condition, s; may be empty.
    """
    # Conditions side by side need room for their means and their names.
    names = [part.condition for part in parts]
    width = max(WIDTH, label_room(names, 0.9) * len(parts) + 0.8)
    labels = label_lines(names, width - 0.8)
    figure = new_figure(3.85 + 0.15 * max(label.count("\n") + 1 for label in labels), width)
    axes = figure.subplots()
    _lines(axes, laps, parts)
    _means(axes, laps, parts)
    _unfinished(axes, laps, parts)
    _paper(axes, parts, paper)
    axes.set_xticks(range(len(parts)), labels)
    axes.set_xlim(-0.5, len(parts) - 0.5)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("lap time / s")
    tidy(axes, grid="y")
    figure.legend(loc="outside upper center", ncols=2, frameon=False, fontsize=9)
    return figure


def _lines(axes: Axes, laps: pd.DataFrame, parts: Sequence[Part]) -> None:
    times = laps.pivot_table(index="participant", columns="condition", values="lap_time_s")
    times = times.reindex(columns=[part.condition for part in parts]).astype("float64")
    faint = max(0.06, min(0.5, 6 / max(len(times), 1)))
    shades = colours(parts)
    for row in times.to_numpy():
        axes.plot(range(len(parts)), row, color=GREY, alpha=faint, linewidth=0.9)
    axes.plot([], [], color=GREY, linewidth=0.9, label="a participant")
    for at, part in enumerate(parts):
        column = times[part.condition].dropna()
        axes.scatter(np.full(len(column), at), column, s=14, color=shades[part.condition],
                     alpha=max(faint, 0.15), linewidths=0, zorder=2)  # fmt: skip


def _means(axes: Axes, laps: pd.DataFrame, parts: Sequence[Part]) -> None:
    shades = colours(parts)
    for at, part in enumerate(parts):
        found = describe(laps.loc[laps["condition"] == part.condition, "lap_time_s"])
        if found.n == 0:
            continue
        axes.errorbar(
            at + 0.16, found.mean, yerr=0 if np.isnan(found.sd) else found.sd, fmt="o",
            color=shades[part.condition], markersize=8, capsize=4, linewidth=1.8, zorder=4,
            markeredgecolor=BLACK, markeredgewidth=0.6,
        )  # fmt: skip
        axes.annotate(
            f"{found.mean:.1f}", (at + 0.16, found.mean), xytext=(8, 0),
            textcoords="offset points", va="center", fontsize=9,
        )  # fmt: skip
    axes.errorbar([], [], yerr=[], fmt="o", color=GREY, markersize=8, capsize=4,
                  markeredgecolor=BLACK, markeredgewidth=0.6, label="mean and sd")  # fmt: skip


def _unfinished(axes: Axes, laps: pd.DataFrame, parts: Sequence[Part]) -> None:
    label: str | None = "unfinished, when it ended"
    for at, part in enumerate(parts):
        cut = laps[(laps["condition"] == part.condition) & ~laps["completed"].astype(bool)]
        ends = pd.to_numeric(cut["duration_s"]).dropna()
        if len(ends):
            axes.scatter(np.full(len(ends), at), ends, marker="x", color=VERMILLION, s=30,
                         zorder=5, label=label)  # fmt: skip
            label = None


def _paper(axes: Axes, parts: Sequence[Part], paper: Mapping[str, float]) -> None:
    known = [(at, paper[part.condition]) for at, part in enumerate(parts)
             if part.condition in paper]  # fmt: skip
    if known:
        at, means = zip(*known, strict=True)
        axes.scatter(np.array(at) - 0.16, means, marker="D", facecolors="white", edgecolors=BLACK,
                     s=42, zorder=4, label="the paper's mean")  # fmt: skip
