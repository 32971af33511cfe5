"""Driven paths, and where assistance was given (the paper's Figure 7)."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.image import AxesImage

from analysis.figures.plan import draw_plan
from analysis.figures.style import GREY, new_figure, say_nothing_to_show
from analysis.figures.text import wrapped
from analysis.maps import Grid, counts, density, plan_grid, smoothed
from analysis.measures.streams import Numbers
from protocols.course.schema import Course

MOST_PATHS = 60
"""Paths drawn at most; the density is of all laps."""

FAINTEST = 0.02
"""Share of the densest spot below which the plan shows through."""


def assistance_map(steps: pd.DataFrame, course: Course, conditions: Sequence[str]) -> Figure:
    """Draw one plan per condition, all densities on one colour scale.

    Parameters
    ----------
    steps
        One row per step: participant, lap, condition, x_m, y_m, helped.
    course
        Where it was driven.
    conditions
        The conditions, from left to right.
    """
    columns = max(len(conditions), 1)
    figure = new_figure(3.5 * -(-columns // 2), 6.4 if columns > 1 else 4.0)
    if not conditions or steps.empty:
        return say_nothing_to_show(figure, "No steps of assisted laps were recorded.")
    grid = plan_grid(course)
    maps = {c: assistance_density(steps[steps["condition"] == c], grid) for c in conditions}
    known = [m[np.isfinite(m)].max(initial=0.0) for m in maps.values()]
    top = max([*known, 1e-9])
    panels = figure.subplots(-(-columns // 2), min(columns, 2), squeeze=False).ravel()
    image: AxesImage | None = None
    for axes, condition in zip(panels, conditions, strict=False):
        image = _density(axes, maps[condition], grid, top)
        _paths(axes, steps[steps["condition"] == condition])
        draw_plan(axes, course)
        axes.set_title(wrapped(condition, 34, lines=3), fontsize=10)
    for axes in panels[len(conditions) :]:
        axes.axis("off")
    if image is not None:
        bar = figure.colorbar(image, ax=list(panels), orientation="horizontal", shrink=0.5,
                              aspect=30, pad=0.02)  # fmt: skip
        bar.set_label("density of assisted steps / m⁻²", fontsize=9)
        bar.ax.tick_params(labelsize=8)
    return figure


def assistance_density(steps: pd.DataFrame, grid: Grid) -> Numbers:
    """Return the smoothed density of the steps in which assistance counted, in 1/m^2."""
    helped = steps[steps["helped"] == 1]
    x, y = (helped[c].to_numpy(dtype=np.float64) for c in ("x_m", "y_m"))
    return density(smoothed(counts(x, y, grid)))


def _density(axes: Axes, values: Numbers, grid: Grid, top: float) -> AxesImage:
    shown = np.ma.masked_less(np.nan_to_num(values), FAINTEST * top)
    return axes.imshow(
        shown, origin="lower", extent=(grid.x[0], grid.x[-1], grid.y[0], grid.y[-1]),
        cmap="YlGnBu", vmin=0, vmax=top, interpolation="nearest",
    )  # fmt: skip


def _paths(axes: Axes, steps: pd.DataFrame) -> None:
    everyone = steps["participant"].astype(str).unique()
    chosen = everyone[:: -(-len(everyone) // MOST_PATHS) or 1]
    driven = steps[steps["participant"].isin(chosen)]
    # One path per lap: joined, a line from finish to start would link a person's laps.
    laps = driven.groupby(["participant", "lap"], observed=True)
    lines = [lap[["x_m", "y_m"]].to_numpy()[::3] for _, lap in laps]
    alpha = max(0.12, min(0.6, 8 / max(len(lines), 1)))
    axes.add_collection(LineCollection(lines, colors=GREY, linewidths=0.5, alpha=alpha))
