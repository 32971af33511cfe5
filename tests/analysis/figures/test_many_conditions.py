"""Labels do not meet, however many conditions a study has."""

import numpy as np
import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from analysis.figures.files import settle
from analysis.figures.lap_times import lap_time_figure
from analysis.figures.model_quality import model_figure
from analysis.figures.section_shares import section_figure
from analysis.roles import Part

PARTS = tuple(
    Part(f"condition {i} with a longer name", "model" if i > 1 else "baseline", 1)
    for i in range(12)
)
NAMES = [part.condition for part in PARTS]


def lap_times():
    """Return lap times of twelve conditions."""
    rows = [
        (f"P{p:04d}", name, True, 40.0 + i + p, 40.0 + i + p)
        for p in range(6)
        for i, name in enumerate(NAMES)
    ]
    columns = ["participant", "condition", "completed", "lap_time_s", "duration_s"]
    return lap_time_figure(pd.DataFrame(rows, columns=columns), PARTS, {})


def model_quality():
    """Return AUC and reliability of twelve conditions."""
    auc = pd.DataFrame({"condition": NAMES * 3, "when_auc": np.linspace(0.7, 0.99, 36)})
    curve = pd.DataFrame({"condition": NAMES, "predicted": 0.5, "observed": 0.5})
    return model_figure(auc, curve, PARTS)


def section_shares():
    """Return the shares of twelve conditions in six sections."""
    sections = [f"section {i}" for i in range(6)]
    table = pd.MultiIndex.from_product([sections, NAMES], names=["section", "condition"])
    frame = table.to_frame(index=False).assign(kind="left", assisted_percent=50.0)
    return section_figure(frame.assign(would_percent=40.0), PARTS)


@pytest.mark.parametrize("make", [lap_times, model_quality, section_shares])
def test_no_label_covers_another_one_or_a_legend_an_axis(make):
    """Boxes of the letters as they are drawn, of every axis and of the legend."""
    figure = make()
    settle(figure)
    renderer = FigureCanvasAgg(figure).get_renderer()
    for axes in figure.axes:
        ticks = [*axes.get_xticklabels(), *axes.texts]
        boxes = [text.get_window_extent(renderer) for text in ticks if text.get_text()]
        # Slanted labels have boxes that meet where their letters do not.
        if not any(text.get_rotation() for text in ticks):
            for i, one in enumerate(boxes):
                assert not any(one.overlaps(other) for other in boxes[:i])
        for legend in figure.legends:
            assert not legend.get_window_extent(renderer).overlaps(axes.bbox)
    whole = figure.bbox
    for legend in figure.legends:
        box = legend.get_window_extent(renderer)
        assert whole.x0 <= box.x0
        assert whole.y0 <= box.y0
        assert box.x1 <= whole.x1
        assert box.y1 <= whole.y1
