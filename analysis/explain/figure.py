"""The dependence of when and how on the inputs, as bars with intervals."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, BLUE, GREEN, new_figure, tidy


def dependence_figure(table: pd.DataFrame) -> Figure:
    """Draw the table of ``dependence``: when to help on the left, how on the right."""
    figure = new_figure(2.8, 7.2)
    left, right = figure.subplots(1, 2, sharey=True)
    shown = table.iloc[::-1]
    _bars(left, shown, "when", BLUE, "change of p(h)")
    _bars(right, shown, "how", GREEN, "change of the turn rate, rad/s")
    left.set_title("When to help", fontsize=10, loc="left")
    right.set_title("How to help", fontsize=10, loc="left")
    return figure


def _bars(axes: Axes, table: pd.DataFrame, name: str, colour: str, label: str) -> None:
    value = table[name]
    reach = [value - table[f"{name}_low"], table[f"{name}_high"] - value]
    axes.barh(table["input"], value, color=colour, xerr=reach, ecolor=BLACK, height=0.6)
    axes.set_xlabel(label, fontsize=9)
    tidy(axes, grid="x")
