"""The plot of the lap loop's benchmark."""

from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.figure import Figure

COLOURS = {
    "lad-study": "#0072b2",
    "mujoco": "#009e73",
    "navground": "#cc79a7",
    "ir-sim": "#e69f00",
    "naive pybullet": "#d55e00",
}


def plot(rows: list[dict[str, Any]], path: Path) -> None:
    """Draw RTF over the number of boxes and of rays, for both parts.

    Parameters
    ----------
    rows
        As written to JSON.
    path
        Where to; the suffix decides the format.
    """
    rate_hz = max(row["rate_hz"] for row in rows)
    parts = list(dict.fromkeys(row["part"] for row in rows))
    figure = Figure(figsize=(9, 6.5), layout="constrained")
    for axes_row, part in zip(figure.subplots(len(parts), 2, sharey="row"), parts, strict=True):
        here = [row for row in rows if row["part"] == part and row["rate_hz"] == rate_hz]
        _lines(axes_row[0], [row for row in here if row["rays"] == 180], "boxes", "180 rays")
        _lines(axes_row[1], [row for row in here if row["boxes"] == 60], "rays", "60 boxes")
        axes_row[0].set_ylabel(f"{part}:\nsimulated s / CPU s")
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=len(labels), frameon=False)
    path.parent.mkdir(parents=True, exist_ok=True)
    with mpl.rc_context({"svg.hashsalt": "lap_loop", "svg.fonttype": "none"}):
        figure.savefig(path, metadata={"Date": None} if path.suffix == ".svg" else None)


def _lines(axes: Axes, rows: list[dict[str, Any]], over: str, title: str) -> None:
    for name in dict.fromkeys(row["simulator"] for row in rows):
        points = sorted((row[over], row["rtf"]) for row in rows if row["simulator"] == name)
        width = 2.2 if name == "lad-study" else 1.2
        axes.plot(*zip(*points, strict=True), "o-", lw=width, color=COLOURS.get(name), label=name)
    axes.set(xscale="log", yscale="log", xlabel=f"{over} ({title}, {rows[0]['rate_hz']} Hz)")
    axes.set_xticks(ticks := sorted({row[over] for row in rows}), [str(tick) for tick in ticks])
    axes.minorticks_off()
    axes.set_yticks(marks := [5, 10, 20, 50, 100, 200, 500, 1000], [str(mark) for mark in marks])
    axes.grid(lw=0.3)
