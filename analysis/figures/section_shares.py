"""Share of assisted steps by course section."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from analysis.figures.style import BLACK, colours, new_figure, say_nothing_to_show, tidy
from analysis.figures.text import wrapped
from analysis.roles import Part

KINDS = {"sharp_right": "sharp right", "soft_right": "soft right", "left": "left",
         "straight": "straight"}  # fmt: skip


def section_figure(table: pd.DataFrame, parts: Sequence[Part]) -> Figure:
    """Draw bars of the assisted share per section, the shadow demonstrator's share as a line.

    Parameters
    ----------
    table
        As ``analysis.tables.sections.section_table`` returns it.
    parts
        The study's conditions; those with help are drawn.
    """
    shown = [part for part in parts if part.condition in set(table["condition"])]
    columns = 3 if _short(shown) else 1
    lines = -(-(len(shown) + 1) // columns)
    figure = new_figure(3.4 + 0.18 * max(lines - 2, 0))
    if not shown or table["assisted_percent"].isna().all():
        return say_nothing_to_show(figure, "No steps of assisted laps were recorded.")
    axes = figure.subplots()
    sections = list(dict.fromkeys(table["section"]))
    kinds = dict(zip(table["section"], table["kind"], strict=True))
    width, shades = 0.8 / len(shown), colours(parts)
    at = np.arange(len(sections))
    for i, part in enumerate(shown):
        here = table[table["condition"] == part.condition].set_index("section").loc[sections]
        left = at + (i - (len(shown) - 1) / 2) * width
        axes.bar(left, here["assisted_percent"], width * 0.92, color=shades[part.condition],
                 label=wrapped(part.condition, 34, lines=3),
                 hatch="//" if part.role == "model" else None,
                 edgecolor="white", linewidth=0)  # fmt: skip
        axes.hlines(here["would_percent"], left - width / 2, left + width / 2, color=BLACK,
                    linewidth=1.6, label="demonstrator would help" if i == 0 else "_")  # fmt: skip
    labels = [f"{wrapped(s, 22, lines=4)}\n({KINDS.get(kinds[s], kinds[s])})" for s in sections]
    axes.set_xticks(at, labels, rotation=40, ha="right", rotation_mode="anchor")  # fmt: skip
    axes.set_ylim(0, 105)
    axes.set_ylabel("assisted steps / %")
    tidy(axes, grid="y")
    figure.legend(loc="outside upper center", ncols=columns, frameon=False, fontsize=9)
    return figure


def _short(parts: Sequence[Part]) -> bool:
    return all(len(part.condition) <= 20 for part in parts)
