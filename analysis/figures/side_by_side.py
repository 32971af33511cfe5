"""Lap times and answers of living and synthetic people, side by side."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    VERMILLION,
    WIDTH,
    new_figure,
    tidy,
)
from analysis.figures.text import label_lines, wrapped

SHADES = (BLUE, ORANGE, GREEN, PURPLE)
MARKERS = ("o", "s", "D", "^")


def times_figure(laps: pd.DataFrame, conditions: Sequence[str], groups: Sequence[str]) -> Figure:
    """Draw the lap times of each group in each condition.

    Parameters
    ----------
    laps
        As ``analysis.side_by_side.SideBySide.laps``.
    conditions, groups
        From left to right.
    """
    width = max(WIDTH, 0.55 * len(conditions) * len(groups) + 1.2)
    figure = new_figure(4.0, width)
    axes = figure.subplots()
    spread = np.linspace(-0.5, 0.5, 2 * len(groups) + 1)[1::2] * 0.8
    for k, group in enumerate(groups):
        for at, condition in enumerate(conditions):
            own = laps[(laps["group"] == group) & (laps["condition"] == condition)]
            _column(axes, own, at + spread[k], k)
        axes.errorbar([], [], yerr=[], fmt=MARKERS[k % 4], color=SHADES[k % 4], capsize=3,
                      markeredgecolor=BLACK, label=f"{group}: mean and sd")  # fmt: skip
    axes.scatter([], [], marker="x", color=VERMILLION, s=30, label="unfinished, when it ended")
    axes.set_xticks(range(len(conditions)), label_lines(list(conditions), width - 0.8))
    axes.set_xlim(-0.6, len(conditions) - 0.4)
    axes.set_ylim(bottom=0)
    axes.set_ylabel("lap time / s")
    tidy(axes, grid="y")
    figure.legend(loc="outside upper center", ncols=2, frameon=False, fontsize=9)
    return figure


def _column(axes: Axes, laps: pd.DataFrame, at: float, k: int) -> None:
    times = laps["lap_time_s"].dropna().to_numpy(float)
    jitter = np.linspace(-0.06, 0.06, len(times)) if len(times) > 1 else np.zeros(len(times))
    axes.scatter(at - 0.06 + jitter, times, s=14, color=SHADES[k % 4], alpha=0.5, linewidths=0)
    if len(times):
        sd = float(times.std(ddof=1)) if len(times) > 1 else 0.0
        axes.errorbar(at + 0.06, times.mean(), yerr=sd, fmt=MARKERS[k % 4], color=SHADES[k % 4],
                      capsize=3, markersize=7, markeredgecolor=BLACK, zorder=4)  # fmt: skip
    cut = pd.to_numeric(laps.loc[~laps["completed"].astype(bool), "duration_s"]).dropna()
    axes.scatter(np.full(len(cut), at - 0.06), cut, marker="x", color=VERMILLION, s=30, zorder=5)


def answers_figure(answers: pd.DataFrame, groups: Sequence[str]) -> Figure:
    """Draw the share of each group that agrees with each item in each condition.

    Parameters
    ----------
    answers
        As ``analysis.side_by_side.SideBySide.answers``.
    groups
        Of these people.
    """
    rows = list(dict.fromkeys(zip(answers["item"], answers["condition"], strict=True)))
    figure = new_figure(1.4 + 0.26 * len(rows), 6.2)
    axes = figure.subplots()
    for k, group in enumerate(groups):
        own = answers[answers["people"] == group].set_index(["item", "condition"])["agree_percent"]
        shares = [float(own.get(row, np.nan)) for row in rows]
        axes.scatter(shares, range(len(rows)), marker=MARKERS[k % 4], color=SHADES[k % 4], s=34,
                     edgecolors=BLACK, linewidths=0.5, label=group, zorder=3)  # fmt: skip
    axes.set_yticks(range(len(rows)), [wrapped(f"{i}, {c}", 40, lines=1) for i, c in rows])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlim(-4, 104)
    axes.set_xlabel("agree / %")
    tidy(axes, grid="x")
    axes.tick_params(axis="y", labelsize=8)
    figure.legend(loc="outside upper center", ncols=len(groups), frameon=False, fontsize=9)
    return figure
