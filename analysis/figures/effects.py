"""How much each comparison of lap times shows, and how sure that is."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from analysis.comparisons import PairedComparison
from analysis.figures.style import BLACK, GREY, new_figure, say_nothing_to_show, tidy
from analysis.figures.text import wrapped


def effect_figure(comparisons: Sequence[PairedComparison]) -> Figure:
    """Draw mean paired differences of lap times with 95% intervals, confirmatory ones filled."""
    shown = [c for c in comparisons if c.difference is not None and c.difference.computed]
    labels = [_label(c) for c in reversed(shown)]
    lines = sum(max(label.count("\n") + 1, 2) for label in labels)
    figure = new_figure(1.1 + 0.225 * max(lines, 2))
    if not shown:
        return say_nothing_to_show(figure, "No comparison of lap times can be computed.")
    axes = figure.subplots()
    for at, c in enumerate(reversed(shown)):
        found = c.difference
        if found is None:  # pragma: no cover - shown holds no such comparison
            continue
        reach = np.array([[found.estimate - found.low], [found.high - found.estimate]])
        declared = c.kind == "confirmatory"
        axes.errorbar(
            found.estimate, at, xerr=reach, fmt="o" if declared else "s", color=BLACK,
            markerfacecolor=BLACK if declared else "white", capsize=4, markersize=7,
        )  # fmt: skip
        axes.annotate(
            f"{found.estimate:+.1f} s", (found.estimate, at), xytext=(0, 8), ha="center",
            textcoords="offset points", fontsize=9,
        )  # fmt: skip
    axes.axvline(0, color=GREY, linewidth=1)
    axes.margins(x=0.12)  # room for the numbers above the outermost ones
    axes.set_yticks(range(len(shown)), labels)
    axes.set_ylim(-0.5, len(shown) - 0.3)
    axes.set_xlabel("difference of lap times / s (negative: faster)")
    tidy(axes, grid="x")
    return figure


def _label(c: PairedComparison) -> str:
    return f"{wrapped(c.condition, 24, lines=4)}\n{wrapped(f'against {c.reference}', 24, lines=4)}"
