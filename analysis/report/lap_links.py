"""Points of figures that lead to the laps behind them, in `study.html`."""

from urllib.parse import quote

import pandas as pd

from analysis.lap_pages.study_page import STUDY_PAGE, held_laps
from analysis.report.blocks import Spot
from analysis.results import StudyResults


def lap_spots(results: StudyResults, points: pd.DataFrame) -> tuple[Spot, ...]:
    """Return the points of a figure whose laps the study's page holds, each with its link.

    Parameters
    ----------
    results
        The study's.
    points
        One row per point: participant, lap, x and y in the units of the figure's first axes, and
        ``value``, what the point stands for in words. A point without a finite y is left out.
    """
    held = {(one.participant, one.lap): one for one in held_laps(results)}
    drawn = points[points["y"].notna()].to_dict("records")
    rows = [(held.get((str(row["participant"]), int(row["lap"]))), row) for row in drawn]
    return tuple(
        Spot(
            float(row["x"]),
            float(row["y"]),
            f"{STUDY_PAGE}#{quote(one.key)}",
            f"{one.participant}, lap {one.lap}: {one.condition}, {row['value']}",
        )
        for one, row in rows
        if one is not None
    )
