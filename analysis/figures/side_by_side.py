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
from analysis.figures.text import label_lines, label_room, wrapped

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
    column = label_room(conditions, 0.55 * len(groups))
    width = max(WIDTH, column * len(conditions) + 1.2)
    figure = new_figure(4.0, width)
    axes = figure.subplots()
    points = time_points(laps, conditions, groups)
    for k, group in enumerate(groups):
        for condition in conditions:
            own = points[(points["group"] == group) & (points["condition"] == condition)]
            _column(axes, own, k)
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


def time_points(
    laps: pd.DataFrame, conditions: Sequence[str], groups: Sequence[str]
) -> pd.DataFrame:
    """Return the laps that have a point, with ``x`` and ``y``: where it stands; ``at``: its column.

    Parameters
    ----------
    laps, conditions, groups
        As for ``times_figure``.
    """
    finished = laps["completed"].astype(bool)
    y = pd.to_numeric(laps["lap_time_s"].where(finished, laps["duration_s"]), errors="coerce")
    points = laps.assign(y=y, finished=finished)[y.notna()]
    spread = np.linspace(-0.5, 0.5, 2 * len(groups) + 1)[1::2] * 0.8
    places = {(c, g): i + spread[k] for i, c in enumerate(conditions) for k, g in enumerate(groups)}
    columns = list(zip(points["condition"], points["group"], strict=True))
    points = points.assign(at=[places.get(column, np.nan) for column in columns])
    column = points.groupby(["condition", "group", "finished"], sort=False)["y"]
    others = column.transform("size") - 1
    share = (column.cumcount() / others.where(others > 0)).fillna(0.5)
    jitter = (0.12 * (share - 0.5)).where(points["finished"], 0.0)
    return points.assign(x=points["at"] - 0.06 + jitter).dropna(subset=["at"])


def _column(axes: Axes, points: pd.DataFrame, k: int) -> None:
    done, cut = points[points["finished"]], points[~points["finished"]]
    axes.scatter(done["x"], done["y"], s=14, color=SHADES[k % 4], alpha=0.5, linewidths=0)
    axes.scatter(cut["x"], cut["y"], marker="x", color=VERMILLION, s=30, zorder=5)
    if len(done):
        sd = float(done["y"].std(ddof=1)) if len(done) > 1 else 0.0
        axes.errorbar(done["at"].iloc[0] + 0.06, done["y"].mean(), yerr=sd, fmt=MARKERS[k % 4],
                      color=SHADES[k % 4], capsize=3, markersize=7, markeredgecolor=BLACK,
                      zorder=4)  # fmt: skip


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
