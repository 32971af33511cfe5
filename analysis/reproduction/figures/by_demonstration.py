"""Accuracy by the number of demonstrations before the lap (the paper's Figures 4b and 4c)."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, BLUE, GREY, LIGHT, VERMILLION, new_figure, tidy
from analysis.reproduction.accuracy import spread


def auc_figure(accuracy: pd.DataFrame, paper: Mapping[int, float]) -> Figure:
    """Draw the AUC of each lap of each run, with median and quartiles.

    Parameters
    ----------
    accuracy
        As ``analysis.reproduction.accuracy.accuracy_table`` returns it.
    paper
        The paper's AUC by demonstrations.
    """
    figure = new_figure(3.6)
    axes = figure.subplots()
    _points(axes, accuracy, "auc", 0.0, BLUE)
    _quartiles(axes, accuracy, "auc", BLUE, "median, quartiles")
    axes.scatter(list(paper), list(paper.values()), marker="D", facecolors="white",
                 edgecolors=BLACK, s=38, zorder=5, label="the paper's")  # fmt: skip
    axes.set_ylim(min(0.93, float(accuracy["auc"].min()) - 0.005), 1.004)
    axes.set_ylabel("AUC of p(h = 1 | x)")
    _laps(axes, accuracy)
    axes.legend(frameon=False, fontsize=9, loc="lower right")
    return figure


def rmse_figure(accuracy: pd.DataFrame) -> Figure:
    """Draw the error of the predicted command where the demonstrator helped."""
    figure = new_figure(3.6, 7.0)
    panels: Sequence[Axes] = figure.subplots(1, 2)
    for axes, column, colour, label in (
        (panels[0], "rmse_v", VERMILLION, "RMSE of a_v / m/s"),
        (panels[1], "rmse_w", BLUE, "RMSE of a_w / rad/s"),
    ):
        _points(axes, accuracy, column, 0.0, colour)
        _quartiles(axes, accuracy, column, colour, "median, quartiles")
        axes.set_ylim(0, float(accuracy[column].max()) * 1.1)
        axes.set_ylabel(label)
        _laps(axes, accuracy)
        axes.legend(frameon=False, fontsize=9, loc="upper right")
    return figure


def _points(axes: Axes, accuracy: pd.DataFrame, column: str, at: float, colour: str) -> None:
    for demonstrations, laps in accuracy.groupby("demonstrations"):
        values = laps[column].to_numpy(float)
        spreads = np.linspace(-0.25, 0.25, len(values)) if len(values) > 1 else np.zeros(1)
        axes.scatter(float(str(demonstrations)) + at + spreads, values, s=7, color=colour,
                     alpha=0.3, linewidths=0, zorder=2)  # fmt: skip


def _quartiles(axes: Axes, accuracy: pd.DataFrame, column: str, colour: str, label: str) -> None:
    found = {
        int(str(before)): spread(laps[column])
        for before, laps in accuracy.groupby("demonstrations")
    }
    medians = np.array([s.median for s in found.values()])
    lows = medians - np.array([s.low for s in found.values()])
    highs = np.array([s.high for s in found.values()]) - medians
    axes.errorbar(
        list(found), medians, yerr=[lows, highs], fmt="o-", color=colour, markersize=5, capsize=3,
        linewidth=1.3, markeredgecolor=BLACK, markeredgewidth=0.5, zorder=4, label=label,
    )  # fmt: skip


def _laps(axes: Axes, accuracy: pd.DataFrame) -> None:
    last = int(accuracy["demonstrations"].max())
    axes.axvspan(last - 0.45, last + 0.45, color=LIGHT, alpha=0.5, linewidth=0, zorder=0)
    axes.annotate("test", (last, 1.0), xycoords=("data", "axes fraction"), fontsize=8,
                  color=GREY, ha="center", va="bottom")  # fmt: skip
    axes.set_xticks(range(last + 1))
    axes.set_xlabel("demonstrations before the lap")
    tidy(axes, grid="y")
