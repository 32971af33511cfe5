"""Calibration of p(h)."""

from collections.abc import Sequence

from matplotlib.figure import Figure

from analysis.figures.style import BLUE, GREY, LIGHT, ORANGE, new_figure, tidy
from analysis.reproduction.accuracy import pooled
from analysis.reproduction.teaching import Run
from lad.calibration import reliability


def reliability_figure(runs: Sequence[Run]) -> Figure:
    """Draw how often the demonstrator helped against p(h), and how many steps that were."""
    figure = new_figure(4.6)
    axes, counts = figure.subplots(2, 1, sharex=True, height_ratios=(3, 1))
    axes.plot([0, 1], [0, 1], color=GREY, linewidth=0.8, linestyle=":", label="what it should be")
    last = len(runs[0]) - 1
    for place, (demonstrations, colour, marker, label) in enumerate(
        ((1, ORANGE, "s", "after 1"), (last, BLUE, "o", f"after {last} (test)"))
    ):
        bins = reliability(*pooled(runs, demonstrations))
        filled = bins.count > 0
        axes.plot(bins.predicted[filled], bins.observed[filled], color=colour, marker=marker,
                  linewidth=1.4, markersize=5, label=label)  # fmt: skip
        middles = (bins.edges[:-1] + bins.edges[1:]) / 2 + (place - 0.5) * 0.04
        counts.bar(middles, bins.count, width=0.038, color=colour)
    axes.set_ylim(-0.02, 1.02)
    axes.set_ylabel("share of steps\nin which the demonstrator helped")
    axes.legend(frameon=False, fontsize=9, loc="upper left")
    counts.set_yscale("log")
    counts.set_ylabel("steps")
    counts.set_xlabel("predicted p(h = 1 | x), in tenths")
    counts.set_xlim(-0.02, 1.02)
    tidy(axes, grid="y")
    tidy(counts, grid="y")
    counts.set_facecolor("white")
    counts.grid(axis="y", color=LIGHT, linewidth=0.6)
    return figure
