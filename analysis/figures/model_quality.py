"""Whether the model knew when to help: AUC per lap, and the calibration of p(h)."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, GREY, colours, new_figure, say_nothing_to_show, tidy
from analysis.figures.text import label_lines, label_room, wrapped
from analysis.roles import Part

_ROOM, _CONDITION = 2.2, 0.8
"""Least width of the strips, and the least that each condition takes of it, inches."""

_MARGINS = 0.4
"""What the strips have beside their conditions, as conditions."""

_NAMES = 2.2
"""What the names of the curves take beside the reliability diagram, inches."""

_SPREAD = 0.18
"""How far a condition's points stand to each side of its middle; 1 is the next condition."""

_LEGEND = 4
"""Conditions whose names have a place inside the reliability diagram."""


def model_figure(
    measures: pd.DataFrame, reliability: pd.DataFrame, parts: Sequence[Part]
) -> Figure:
    """Draw the AUC of every lap, and the reliability curve.

    Parameters
    ----------
    measures
        One row per lap: condition, when_auc.
    reliability
        As ``analysis.tables.reliability.reliability_table`` returns it.
    parts
        The study's conditions; those with a model's predictions are drawn.
    """
    known = auc_points(measures, parts)
    shown = [part for part in parts if part.condition in set(known["condition"])]
    if not shown:
        return say_nothing_to_show(
            new_figure(3.2, 6.2),
            "No lap has both a model's p(h) and a demonstrator to compare it with.",
        )
    names = [part.condition for part in shown]
    room = max(_ROOM, label_room(names, _CONDITION) * (len(shown) + _MARGINS))
    lines = sum(_name(part).count("\n") + 1 for part in shown)
    aside = len(shown) > _LEGEND  # inside, the names would cover the curves
    height = max(3.2, 0.17 * lines + 0.6) if aside else 3.2
    figure = new_figure(height, 4.0 + room + (_NAMES if aside else 0))
    widths = None if room == _ROOM else (room, 3.0)
    left, right = figure.subplots(1, 2, width_ratios=widths)
    _strips(left, known, shown, colours(parts), room)
    _curves(right, reliability, shown, colours(parts))
    if aside:
        figure.legend(loc="outside right upper", frameon=False, fontsize=8)
    else:
        right.legend(frameon=False, fontsize=8, loc="upper left")
    return figure


def auc_points(measures: pd.DataFrame, parts: Sequence[Part]) -> pd.DataFrame:
    """Return the laps that have an AUC, with ``x``: where each one's point stands.

    Parameters
    ----------
    measures, parts
        As for ``model_figure``.

    Examples
    --------
    >>> laps = pd.DataFrame({"condition": ["a", "b", "b"], "when_auc": [1.0, 0.9, 0.8]})
    >>> auc_points(laps, [Part("a", "model", 1), Part("b", "model", 1)])["x"].round(2).tolist()
    [0.0, 0.82, 1.18]
    """
    known = measures.dropna(subset=["when_auc"])
    shown = [part.condition for part in parts if part.condition in set(known["condition"])]
    known = known[known["condition"].isin(shown)]
    place = known["condition"].map(shown.index).astype("float64")
    group = known.groupby("condition", sort=False)["when_auc"]
    others = group.transform("size") - 1
    share = (group.cumcount() / others.where(others > 0)).fillna(0.5)
    return known.assign(x=place + 2 * _SPREAD * (share - 0.5))


def _strips(
    axes: Axes, known: pd.DataFrame, parts: Sequence[Part], shades: dict[str, str], room: float
) -> None:
    for at, part in enumerate(parts):
        own = known[known["condition"] == part.condition]
        auc = own["when_auc"].to_numpy()
        axes.scatter(own["x"], auc, s=16, color=shades[part.condition], alpha=0.7)
        axes.hlines(np.median(auc), at - 0.28, at + 0.28, color=BLACK, linewidth=2)
        # Above the axes: beside a bar or under the points it would be read as another lap's.
        axes.text(at, 1.01, f"{np.median(auc):.3f}", transform=axes.get_xaxis_transform(),
                  fontsize=9, ha="center", va="bottom")  # fmt: skip
    axes.axhline(0.5, color=GREY, linewidth=0.8, linestyle=":")
    names = [part.condition for part in parts]
    for_names = room * len(parts) / (len(parts) + _MARGINS)
    axes.set_xticks(range(len(parts)), label_lines(names, for_names))
    axes.set_xlim(-0.5 - _MARGINS / 2, len(parts) - 0.5 + _MARGINS / 2)
    lowest = float(known["when_auc"].min())
    axes.set_ylim(min(0.45, lowest - 0.05), 1.02)
    axes.set_ylabel("when-AUC per lap (bar, number: median)")
    tidy(axes, grid="y")


def _curves(
    axes: Axes, reliability: pd.DataFrame, parts: Sequence[Part], shades: dict[str, str]
) -> None:
    axes.plot([0, 1], [0, 1], color=GREY, linewidth=0.8, linestyle=":")
    for part in parts:
        bins = reliability[reliability["condition"] == part.condition]
        axes.plot(
            bins["predicted"], bins["observed"], marker="o" if part.role == "model" else "s",
            color=shades[part.condition], linewidth=1.4, markersize=5,
            label=_name(part),
        )  # fmt: skip
    axes.set_xlim(-0.02, 1.02)
    axes.set_ylim(-0.02, 1.02)
    axes.set_xlabel("predicted p(h = 1 | x)")
    axes.set_ylabel("demonstrator would help")
    tidy(axes, grid="y")


def _name(part: Part) -> str:
    return wrapped(part.condition, 24, lines=3)
