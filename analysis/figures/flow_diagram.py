"""Participants of each group, from allocation to analysis (CONSORT 2010's flow diagram)."""

from collections.abc import Hashable, Mapping
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, WIDTH, new_figure
from analysis.figures.text import letters_in, wrapped


def flow_figure(flow: pd.DataFrame) -> Figure:
    """Draw a column of boxes for each group.

    Parameters
    ----------
    flow
        One row per group: group, recorded, refused, excluded, reasons, analysed, as
        ``analysis.groups.GroupResults.flow`` has it.
    """
    groups = flow.to_dict("records")
    width = max(WIDTH, 1.7 * len(groups) + 0.4)
    inches = (width - 0.3) / len(groups) - 0.3
    fits = max(letters_in(inches), 8)
    rows = [_boxes(group, fits) for group in groups]
    lines = [max(column[i].count("\n") + 1 for column in rows) for i in range(3)]
    heights = [0.17 * n + 0.2 for n in (1, *lines)]
    total = sum(heights) + 0.3 * len(heights)
    figure = new_figure(total, width)
    axes = figure.subplots()
    axes.set(xlim=(0, width), ylim=(0, total))
    axes.axis("off")
    top = total - heights[0] / 2 - 0.05
    centre = width / 2
    _box(axes, centre, top, f"{flow['recorded'].sum()} recorded")
    for i, column in enumerate(rows):
        x = 0.15 + (i + 0.5) * (width - 0.3) / len(groups)
        y, above, from_x = top, heights[0], centre
        for text, height in zip(column, heights[1:], strict=True):
            below = y - above / 2 - 0.3 - height / 2
            _arrow(axes, (from_x, y - above / 2), (x, below + height / 2))
            _box(axes, x, below, text)
            y, above, from_x = below, height, x
    return figure


def _boxes(group: Mapping[Hashable, Any], fits: int) -> tuple[str, str, str]:
    lost = [f"consent refused: {group['refused']}", f"excluded: {group['excluded']}"]
    lost += [f"  {reason}" for reason in str(group["reasons"]).split("; ") if reason]
    return (
        f"{wrapped(str(group['group']), fits, lines=3)}\nallocated: {group['recorded']}",
        "\n".join(wrapped(line, fits, lines=4) for line in lost),
        f"analysed: {group['analysed']}",
    )


def _box(axes: Axes, x: float, y: float, text: str) -> None:
    frame: dict[str, Any] = {
        "boxstyle": "square,pad=0.45", "facecolor": "white", "edgecolor": BLACK, "linewidth": 0.8
    }  # fmt: skip
    axes.text(x, y, text, ha="center", va="center", fontsize=9, linespacing=1.25, bbox=frame)


def _arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float]) -> None:
    style = {"arrowstyle": "-|>", "color": BLACK, "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=style)
