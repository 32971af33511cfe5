"""Which of the variants matter: their changes against the default, with intervals."""

from itertools import groupby

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, GREY, LIGHT, VERMILLION, new_figure, tidy

PANELS = (
    ("d_auc_1", "AUC after 1"),
    ("d_lap_1", "lap after 1 / s"),
    ("d_lap_3", "lap after 3 / s"),
)
"""Columns of the table and what their panel is called; the first is better to the right."""

FARTHEST = 30.0
"""Changes of lap times beyond this are drawn as triangles at the edge, s."""


def robustness_figure(table: pd.DataFrame) -> Figure:
    """Draw a row per variant, a panel per outcome: the mean change and its 95% interval.

    Parameters
    ----------
    table
        As ``analysis.reproduction.robustness.table.variant_table`` returns it.
    """
    shown = table[table["group"] != "default"].reset_index(drop=True)
    figure = new_figure(1.2 + 0.26 * max(len(shown), 1), 7.4)
    panels = figure.subplots(1, len(PANELS), sharey=True, squeeze=False)[0]
    heights = -np.arange(len(shown), dtype=np.float64)
    for axes, (column, title) in zip(panels, PANELS, strict=True):
        _dots(axes, shown, heights, column)
        _bands(axes, shown)
        axes.axvline(0, color=GREY, linewidth=1)
        axes.set_xlabel(f"change of {title}", fontsize=9)
        tidy(axes, grid="x")
    panels[0].set_yticks(heights, shown["label"].tolist(), fontsize=8)
    panels[0].set_ylim(-len(shown) + 0.4, 0.6)
    return figure


def _dots(axes: Axes, shown: pd.DataFrame, heights: np.ndarray, column: str) -> None:
    at, low, high = (
        shown[name].to_numpy(dtype=np.float64)
        for name in (column, f"{column}_low", f"{column}_high")
    )
    is_lap = "lap" in column
    better = high < 0 if is_lap else low > 0
    worse = low > 0 if is_lap else high < 0
    beyond = (np.abs(at) > FARTHEST) & is_lap
    known = np.isfinite(at) & ~beyond
    axes.hlines(heights[known], low[known], high[known], color=BLACK, linewidth=1.2)
    if is_lap:
        axes.set_xlim(-FARTHEST * 1.05, FARTHEST * 1.05)
        _triangles(axes, at[beyond], heights[beyond])
    for mask, colour, filled in ((better, BLACK, True), (worse, VERMILLION, True),
                                 (~better & ~worse, BLACK, False)):  # fmt: skip
        here = mask & known
        axes.scatter(at[here], heights[here], s=26, zorder=3, edgecolors=colour,
                     color=colour if filled else "white")  # fmt: skip


def _triangles(axes: Axes, at: np.ndarray, heights: np.ndarray) -> None:
    for value, height in zip(at, heights, strict=True):
        edge = np.sign(value) * FARTHEST
        axes.plot(edge, height, marker=">" if value > 0 else "<", color=VERMILLION, markersize=6)
        axes.annotate(f"{value:+.0f}", (edge, height), xytext=(-8 * np.sign(value), 0),
                      textcoords="offset points", ha="right" if value > 0 else "left",
                      va="center", fontsize=7)  # fmt: skip


def _bands(axes: Axes, shown: pd.DataFrame) -> None:
    """Shade every other group of variants."""
    top = 0
    for i, (_, members) in enumerate(groupby(shown["group"])):
        size = len(list(members))
        if i % 2 == 0:
            axes.axhspan(-top - size + 0.5, -top + 0.5, color=LIGHT, alpha=0.35, linewidth=0)
        top += size
