"""Figures of twelve conditions: nothing that is written meets what is written beside it."""

import itertools

import numpy as np
import pandas as pd
import pytest

from analysis.figures.lap_times import lap_time_figure
from analysis.figures.model_quality import model_figure
from analysis.roles import Part

NAMES = ["baseline", "limited right turns", "demonstrator helps early", "demonstrator helps late",
         "model after one lap", "model after two laps", "model after three laps",
         "blended control half", "blended control full", "corrections while driving",
         "latent help inferred", "human-assisted"]  # fmt: skip
PARTS = [Part(name, "model", 1) for name in NAMES]
CURVES = pd.DataFrame({"condition": NAMES, "predicted": np.linspace(0.1, 0.9, 12), "observed": 0.5})


def laps():
    """Return laps of four people in every condition."""
    rows = [(f"P{who}", name, 40.0 + who) for name in NAMES for who in range(4)]
    table = pd.DataFrame(rows, columns=["participant", "condition", "lap_time_s"])
    return table.assign(completed=True, duration_s=table["lap_time_s"])


def drawn(which):
    """Return the figure, laid out."""
    measures = laps().assign(when_auc=lambda t: 0.9 + (t["lap_time_s"] - 40) / 100)
    figure = (
        lap_time_figure(laps(), PARTS, {})
        if which == "lap times"
        else model_figure(measures, CURVES, PARTS)
    )
    figure.draw_without_rendering()
    return figure


@pytest.mark.parametrize("which", ["lap times", "model quality"])
def test_labels_of_twelve_conditions_do_not_overlap(which):
    """Neither the conditions' names, nor the numbers at their points."""
    axes = drawn(which).axes[0]
    for texts in (axes.get_xticklabels(), axes.texts):
        boxes = [text.get_window_extent() for text in texts]
        assert len(boxes) == 12
        assert not [(a, b) for a, b in itertools.combinations(boxes, 2) if a.overlaps(b)]


@pytest.mark.parametrize("which", ["lap times", "model quality"])
def test_no_word_of_a_name_is_broken(which):
    """A name goes on in the next line between its words."""
    labels = [text.get_text() for text in drawn(which).axes[0].get_xticklabels()]
    words = {word for label in labels for word in label.split()}
    assert words <= {part for name in NAMES for word in name.split() for part in (
        word, *[f"{first}-" for first in word.split("-")[:-1]], word.split("-")[-1])}  # fmt: skip
