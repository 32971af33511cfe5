"""Answers on a Likert scale as diverging bars: neutral in the middle, agreement to the right."""

from collections.abc import Iterable, Sequence

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import GREY, LIGHT, new_figure, say_nothing_to_show, tidy
from analysis.figures.text import wrapped
from protocols.instrument import Instrument

_LINE = 62
"""Characters of an item's words per line, beside short names of conditions."""

_NAME = 26
"""Characters of a condition's name per line; two lines at most."""


def likert_figure(table: pd.DataFrame, instrument: Instrument) -> Figure:
    """Draw every item's answers by condition.

    Parameters
    ----------
    table
        As ``analysis.tables.survey.survey_table`` returns it.
    instrument
        The questionnaire: its scale and items.
    """
    points = [f"n_{i}" for i in range(1, instrument.points + 1)]
    rows = table[table[points].sum(axis=1) > 0]
    row = 0.24 if _longest(rows["condition"]) <= _NAME else 0.32
    figure = new_figure(1.2 + row * (len(rows) + 0.6 * sum(_words(rows).str.count("\n") + 2)))
    if rows.empty:
        return say_nothing_to_show(figure, f"{instrument.title}: nothing was answered.")
    axes = figure.subplots()
    places = _places(rows)
    shades = _shades(instrument.points)
    _bars(axes, rows, places, instrument, shades)
    axes.axvline(0, color=GREY, linewidth=0.8)
    axes.set_yticks(places, [_two_lines(name) for name in rows["condition"]])
    _item_names(axes, rows, places)
    axes.set_ylim(max(places) + 0.8, -0.3)
    axes.set_xlim(-105, 105)
    ticks = range(-100, 101, 50)
    axes.set_xticks(ticks, [f"{abs(t)}%" for t in ticks])
    axes.set_xlabel("disagree        share of answers        agree")
    tidy(axes, grid="x")
    axes.tick_params(axis="y", labelsize=8)
    longest = _longest(instrument.anchors)
    columns = min(instrument.points, 5 if longest <= 20 else 3 if longest <= 30 else 1)
    figure.legend(loc="outside upper center", ncols=columns, frameon=False,
                  fontsize=8, handlelength=1.2, columnspacing=1.0)  # fmt: skip
    return figure


def _places(rows: pd.DataFrame) -> list[float]:
    """Return each row's height: one below the other, with a gap between items."""
    lines = _words(rows).str.count("\n") + 1
    new_item = (rows["item"] != rows["item"].shift()).to_numpy()
    gap = np.cumsum(new_item * (0.3 + 0.65 * lines.loc[rows["item"]].to_numpy()))
    return [float(i + above) for i, above in enumerate(gap)]


def _words(rows: pd.DataFrame) -> pd.Series:
    """Return each item's words, broken into lines, by item."""
    items = rows.drop_duplicates("item").set_index("item")["text"]
    # The wider the names beside the bars, the less room above them.
    names = min(_longest(rows["condition"]), _NAME)
    line = _LINE - round(1.1 * max(names - 14, 0))
    broken = [wrapped(f"{item}  {text}", line) for item, text in items.items()]
    return pd.Series(broken, index=items.index, dtype=str)


def _longest(names: Iterable[str]) -> int:
    return max(map(len, names), default=0)


def _two_lines(condition: str) -> str:
    """Return a name for a row of two lines: names that begin alike often end otherwise."""
    if len(condition) > 2 * _NAME - 6:
        condition = f"{condition[:20]} ... {condition[-19:]}"
    return wrapped(condition, _NAME, lines=2)


def _anchor(anchor: str) -> str:
    """Return a point's label; matplotlib leaves labels out of a legend that begin with _."""
    return ("\u200b" if anchor.startswith("_") else "") + wrapped(anchor, 60, lines=2)


def _shades(points: int) -> list[str]:
    """Return colours from disagreement (brown) over neutral (grey) to agreement (green)."""
    ends = mpl.colormaps["BrBG"](np.linspace(0.12, 0.88, points))
    shades = [mpl.colors.to_hex(colour) for colour in ends]
    if points % 2:
        shades[points // 2] = LIGHT
    return shades


def _bars(
    axes: Axes,
    rows: pd.DataFrame,
    places: Sequence[float],
    instrument: Instrument,
    shades: Sequence[str],
) -> None:
    names = [f"n_{i}" for i in range(1, instrument.points + 1)]
    shares = rows[names].to_numpy(dtype=np.float64)
    shares = 100 * shares / shares.sum(axis=1, keepdims=True)
    middle = instrument.points // 2
    left = -shares[:, :middle].sum(axis=1)
    if instrument.points % 2:
        left = left - shares[:, middle] / 2
    for i, anchor in enumerate(instrument.anchors):
        axes.barh(places, shares[:, i], left=left, height=0.86, color=shades[i],
                  label=_anchor(anchor), edgecolor="white", linewidth=0.5)  # fmt: skip
        left = left + shares[:, i]


def _item_names(axes: Axes, rows: pd.DataFrame, places: Sequence[float]) -> None:
    """Write each item's words above its bars."""
    tops = rows.assign(place=places).groupby("item", sort=False)["place"].min()
    for item, words in _words(rows).items():
        axes.text(-104, float(tops[str(item)]) - 0.6, words, fontsize=8, va="bottom",
                  fontweight="bold", linespacing=1.05)  # fmt: skip
