"""How well living people were connected: median, 99th percentile and maximum of each person."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLUE, GREY, VERMILLION, new_figure, say_nothing_to_show, tidy

PANELS = {
    "late_ms": "step late / ms",
    "input_age_ms": "age of the command / ms",
    "round_trip_ms": "round trip / ms",
}


def quality_figure(people: pd.DataFrame, limits: Mapping[str, float]) -> Figure:
    """Draw each person's lateness, age of the command in force, and round trip.

    Parameters
    ----------
    people
        As ``analysis.live_quality.LiveQuality.people``.
    limits
        What the protocol allows, by panel, in its unit; drawn as a line.
    """
    figure = new_figure(1.4 + 0.22 * len(people), 6.6)
    shown = [name for name in PANELS if people[f"{name}_p50"].notna().any()]
    if not shown:
        return say_nothing_to_show(figure, "No step was timed by the wall clock.")
    panels = figure.subplots(1, len(shown), squeeze=False, sharey=True)[0]
    for axes, name in zip(panels, shown, strict=True):
        _panel(axes, people, name, limits.get(name))
    panels[0].set_yticks(range(len(people)), people["participant"])
    panels[0].set_ylim(len(people) - 0.5, -0.5)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=4, frameon=False, fontsize=8)
    return figure


def _panel(axes: Axes, people: pd.DataFrame, name: str, limit: float | None) -> None:
    places = np.arange(len(people))
    p50, p99, top = (people[f"{name}_{of}"].to_numpy(float) for of in ("p50", "p99", "max"))
    axes.hlines(places, p50, p99, color=BLUE, linewidth=2, label="median to 99th percentile")
    axes.scatter(p50, places, s=22, color=BLUE, zorder=3)
    axes.scatter(top, places, s=14, marker="x", color=GREY, label="maximum")
    if limit is not None:
        axes.axvline(limit, color=VERMILLION, linewidth=1, linestyle="--", label="allowed (99th)")
    axes.set_xscale("symlog", linthresh=1)
    axes.set_xlim(left=0)
    axes.set_xlabel(PANELS[name], fontsize=9)
    tidy(axes, grid="x")
