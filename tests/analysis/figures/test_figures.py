"""Figures: what they show, and that they are the same every time."""

import re

import numpy as np
import pandas as pd
import pytest
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from analysis.comparisons import declared_comparisons
from analysis.figures.assistance_map import assistance_map
from analysis.figures.effects import effect_figure
from analysis.figures.files import png, settle, svg
from analysis.figures.lap_times import lap_time_figure
from analysis.figures.likert import likert_figure
from analysis.figures.model_quality import model_figure
from analysis.figures.section_shares import section_figure
from analysis.figures.style import colours
from analysis.frames import study_frames
from analysis.lap_records import read_laps
from analysis.roles import Part
from analysis.tables.reliability import reliability_table
from analysis.tables.sections import section_table
from analysis.tables.survey import survey_table

HELPED = ("human-assisted", "model-assisted")


def drawn(study):
    """Return every figure of a study by name."""
    frames = study_frames(study)
    records = read_laps(frames)
    instrument = study.instruments[0]
    return {
        "lap times": lap_time_figure(frames.laps, frames.parts, {"limited": 76.7}),
        "effects": effect_figure(declared_comparisons(frames)[:4]),
        "map": assistance_map(records.steps, study.course, HELPED),
        "sections": section_figure(section_table(frames, records), frames.parts),
        "likert": likert_figure(survey_table(frames, instrument), instrument),
        "model": model_figure(records.measures, reliability_table(frames, records), frames.parts),
    }


@pytest.fixture(scope="module")
def figures(study):
    """Return every figure of the uneventful study."""
    return drawn(study)


def test_the_same_figure_is_the_same_bytes(study):
    """Drawn twice, SVG and PNG are identical: no date, no random ids."""
    effects = [effect_figure(declared_comparisons(study_frames(study))[:4]) for _ in range(2)]
    for figure in effects:
        settle(figure)
    assert svg(effects[0]) == svg(effects[1])
    assert png(effects[0]) == png(effects[1])


def test_svg_carries_no_date(figures):
    """Nothing in the file tells when it was drawn."""
    assert not re.search(rb"<dc:date>", svg(figures["lap times"]))


@pytest.mark.parametrize(
    "events",
    [
        {"participants": 1},
        {"participants": 2, "answer": 3},
        {"participants": 2, "unfinished": frozenset((i, j) for i in (1, 2) for j in range(5))},
        {"participants": 2, "withdrew": {1: 1, 2: 1}},
    ],
    ids=["one person", "equal answers", "no one finished", "all left at once"],
)
def test_every_figure_can_be_drawn_whatever_happened(make_study, events):
    """A figure without data says so; none of them fails or warns."""
    for figure in drawn(make_study(**events)).values():
        assert isinstance(figure, Figure)
        settle(figure)


def test_lap_times_show_every_participant_and_the_means(study, figures):
    """A line per participant, through the lap times as recorded."""
    (axes,) = figures["lap times"].axes
    frames = study_frames(study)
    lines = [line for line in axes.lines if len(line.get_xdata()) == 4]
    drawn_times = np.sort(np.concatenate([line.get_ydata() for line in lines]))
    assert drawn_times == pytest.approx(np.sort(frames.laps["lap_time_s"]))


def test_both_maps_share_one_colour_scale(figures):
    """Densities of demonstrator and model can be compared by colour."""
    images = [axes.images[0] for axes in figures["map"].axes if axes.images]
    assert len(images) == 2
    assert images[0].get_clim() == images[1].get_clim()


def test_likert_bars_make_up_the_whole(figures):
    """Every row's bars add up to 100%, centred so that half the neutral ones are on each side."""
    (axes,) = figures["likert"].axes
    rows = {}
    for patch in axes.patches:
        rows.setdefault(round(patch.get_y(), 6), []).append(patch)
    assert all(sum(p.get_width() for p in row) == pytest.approx(100) for row in rows.values())
    middle = [sorted(row, key=lambda p: p.get_x()) for row in rows.values()]
    neutral = [row[2] for row in middle if row[2].get_width() > 0]
    assert all(p.get_x() == pytest.approx(-p.get_width() / 2) for p in neutral)


def test_parts_that_repeat_get_colours_of_their_own():
    """Two models in one study can be told apart."""
    parts = [Part(f"m{i}", "model", i) for i in range(4)]
    assert len(set(colours(parts).values())) == 4


def test_laps_of_one_person_are_lines_of_their_own(study):
    """No line runs from one lap's finish to the next one's start."""
    rows = [("P1", lap, "model", x, lap, 0.0) for lap in (1, 2) for x in range(6)]
    steps = pd.DataFrame(rows, columns=["participant", "lap", "condition", "x_m", "y_m", "helped"])
    figure = assistance_map(steps.astype({"participant": "category"}), study.course, ["model"])
    drawn = [c for c in figure.axes[0].collections if isinstance(c, LineCollection)]
    paths = next(c for c in drawn if len(c.get_segments()) == 2).get_segments()
    assert [set(path[:, 1]) for path in paths] == [{1.0}, {2.0}]


def test_an_empty_study_of_steps_says_so(study):
    """No steps at all: a figure with a sentence instead of a map."""
    nothing = pd.DataFrame(columns=["participant", "condition", "x_m", "y_m", "helped"])
    figure = assistance_map(nothing, study.course, HELPED)
    assert "No steps" in figure.texts[0].get_text()
