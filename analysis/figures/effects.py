"""How much each comparison of lap times shows, and how sure that is."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from analysis.comparisons import PairedComparison
from analysis.figures.style import BLACK, GREY, new_figure, say_nothing_to_show, tidy
from analysis.figures.text import wrapped


def effect_figure(comparisons: Sequence[PairedComparison]) -> Figure:
    """Draw changes of lap time in percent with 95% intervals, confirmatory ones filled."""
    shown = [c for c in comparisons if c.lap_time is not None and c.lead.computed]
    labels = [_label(c) for c in reversed(shown)]
    lines = sum(max(label.count("\n") + 1, 2) for label in labels)
    figure = new_figure(1.1 + 0.225 * max(lines, 2))
    if not shown:
        return say_nothing_to_show(figure, "No comparison of lap times can be computed.")
    axes = figure.subplots()
    for at, c in enumerate(reversed(shown)):
        change, low, high = (
            100 * math.expm1(v) for v in (c.lead.estimate, c.lead.low, c.lead.high)
        )
        reach = np.array([[change - low], [high - change]])
        declared = c.kind == "confirmatory"
        axes.errorbar(
            change, at, xerr=reach, fmt="o" if declared else "s", color=BLACK,
            markerfacecolor=BLACK if declared else "white", capsize=4, markersize=7,
        )  # fmt: skip
        axes.annotate(
            f"{change:+.0f}%", (change, at), xytext=(0, 8), ha="center",
            textcoords="offset points", fontsize=9,
        )  # fmt: skip
    axes.axvline(0, color=GREY, linewidth=1)
    axes.margins(x=0.12)  # room for the numbers above the outermost ones
    axes.set_yticks(range(len(shown)), labels)
    axes.set_ylim(-0.5, len(shown) - 0.3)
    axes.set_xlabel("change of lap time / % (negative: faster)")
    tidy(axes, grid="x")
    return figure


def _label(c: PairedComparison) -> str:
    return f"{wrapped(c.condition, 24, lines=4)}\n{wrapped(f'against {c.reference}', 24, lines=4)}"
