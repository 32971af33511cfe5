"""What people wrote stands in a figure as they wrote it."""

import pytest
from matplotlib.figure import Figure
from matplotlib.text import Text

from analysis.figures.files import png, settle, svg
from analysis.figures.likert import likert_figure
from analysis.figures.missing_letters import figure_scripts
from analysis.figures.text import label_lines, wrapped
from analysis.tables.survey import _counts
from protocols.instrument import Instrument

ODD = [
    "Between $5_ and 10_$ a day is fair.",
    "Such help is worth $90^$ to me.",
    "I would give $20 to $50 for it.",
    r"\frac{1}{2} of $\alpha$ and \$",
    "100 % <b>sure</b> & certain",
    "\u05e9\u05dc\u05d5\u05dd \u0627\u0644\u0639\u0631\u0628\u064a\u0629",
    "Rene\u0301 \U0001f600 \u65e5\u672c",
    "word " * 60,
    "x" * 300,
]


def shown(figure):
    """Return every text of a figure, line ends taken away."""
    texts = (text.get_text() for text in figure.findobj(Text))
    return ["".join(text.split()) for text in texts]


@pytest.mark.parametrize("text", ODD)
def test_an_item_and_an_anchor_are_drawn_as_written(text):
    """Neither read as mathematics nor cut; and no warning about a character without a glyph."""
    import pandas as pd

    anchors = ("_a $", "b", text[:40], "d", "=e")
    instrument = Instrument(
        name="odd", title=text, anchors=anchors, agreement_from=4, items=[{"id": "q", "text": text}]
    )
    row = {"item": "q", "text": text, "condition": "manual"}
    counts = _counts(pd.Series([1.0, 3.0, 5.0]), 3, instrument, instrument.items[0])
    figure = likert_figure(pd.DataFrame([row | counts]), instrument)
    settle(figure)
    assert "".join(f"q  {text}".split()) in shown(figure)
    assert not any(found.get_parse_math() for found in figure.findobj(Text))
    assert svg(figure)
    assert png(figure)
    labels = [found.get_text().lstrip("\u200b") for found in figure.legends[0].get_texts()]
    assert labels[0] == "_a $"
    assert len(labels) == 5


def test_ticks_that_are_made_while_drawing_are_literal_too():
    """Axis labels that a formatter writes at the last moment."""
    figure = Figure()
    axes = figure.subplots()
    axes.set_xticks([0, 1], ["$a_$", "b$"])
    axes.set_xlim(0, 10)
    axes.xaxis.set_major_formatter(lambda value, _: f"${value}^$")
    settle(figure)
    assert png(figure)


def test_labels_side_by_side_do_not_meet():
    """Ten names of eighty characters in six inches: each line has its share of the room."""
    lines = label_lines(["condition " * 8] * 10, 6.0)
    assert all(len(line) <= 8 for label in lines for line in label.split("\n"))


@pytest.mark.parametrize("text", [*ODD, "", " ", "\n\n"])
def test_no_line_is_longer_than_asked(text):
    """Long words are broken, too; and text without any is one empty line."""
    assert all(len(line) <= 20 for line in wrapped(text, 20).split("\n"))


def test_letters_that_the_figures_lack_stay_text_for_the_browser():
    """Chinese and emoji are not boxes in the SVG; a figure with Latin letters alone has shapes."""
    figures = []
    for text in ("agree", "\u540c\u610f \U0001f9bd"):
        figure = Figure(figsize=(2, 1))
        figure.text(0.1, 0.5, text)
        settle(figure)
        figures.append(figure)
    latin, chinese = (svg(figure).decode() for figure in figures)
    assert "<text" not in latin
    assert "\u540c\u610f" in chinese.split("<text", 1)[1]
    assert figure_scripts(figures[0]) == ()
    assert figure_scripts(figures[1]) == ("CJK", "emoji")


def test_a_line_of_wide_letters_has_half_as_many():
    """A Chinese letter takes the room of two Latin ones."""
    assert max(map(len, wrapped("\u5f88" * 30, 20).split("\n"))) == 10
