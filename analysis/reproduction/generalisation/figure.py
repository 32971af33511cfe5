"""Models on courses they were not taught on: lap times, and where they help."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from analysis.figures.section_shares import KINDS
from analysis.figures.style import BLACK, ROLE_COLOURS, new_figure, tidy
from analysis.roles import Role

ROLES: tuple[Role, ...] = ("baseline", "limited", "demonstrator", "model")


def generalisation_figure(laps: pd.DataFrame, shares: pd.DataFrame) -> Figure:
    """Draw mean lap times by course and condition, and the shares of assisted steps.

    Parameters
    ----------
    laps, shares
        As ``analysis.reproduction.generalisation.tables`` returns them.
    """
    courses = list(dict.fromkeys(laps["course"]))
    figure = new_figure(1.2 + 0.95 * len(courses), 7.4)
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    _lap_times(left, laps, courses)
    _shares(right, shares, courses)
    figure.legend(*left.get_legend_handles_labels(), loc="outside upper center", ncols=4,
                  frameon=False, fontsize=9)  # fmt: skip
    return figure


def _lap_times(axes: Axes, laps: pd.DataFrame, courses: list[str]) -> None:
    for i, role in enumerate(ROLES):
        here = laps[laps["condition"] == role].set_index("course").loc[courses]
        at = -np.arange(len(courses)) + 0.24 - 0.16 * i
        mean = here["mean_s"].to_numpy(dtype=np.float64)
        reach = np.array([mean - here["low_s"], here["high_s"] - mean])
        axes.errorbar(mean, at, xerr=reach, fmt="o", color=ROLE_COLOURS[role], markersize=5,
                      linewidth=1.4, capsize=2, label=role)  # fmt: skip
    axes.set_yticks(-np.arange(len(courses)), courses, fontsize=9)
    axes.set_xlim(left=0)
    axes.set_xlabel("lap time / s")
    tidy(axes, grid="x")


def _shares(axes: Axes, shares: pd.DataFrame, courses: list[str]) -> None:
    at = 0
    places, labels = [], []
    for course in courses:
        for row in shares[shares["course"] == course].to_dict("records"):
            axes.barh(-at, 100 * row["assisted"], color=ROLE_COLOURS["model"], height=0.7)
            axes.hlines(-at, 100 * row["low"], 100 * row["high"], color=BLACK, linewidth=1)
            axes.plot([100 * row["would"]] * 2, [-at - 0.4, -at + 0.4], color=BLACK, linewidth=1.6)
            places.append(-at)
            labels.append(f"{KINDS.get(row['kind'], row['kind'])} ({_short(course)})")
            at += 1
        at += 1
    axes.set_yticks(places, labels, fontsize=7)
    axes.set_xlim(0, 100)
    axes.set_xlabel("assisted steps / %")
    tidy(axes, grid="x")


def _short(course: str) -> str:
    return course if len(course) < 12 else course.rsplit("-", 1)[-1]
