"""The flow of each group: every number is drawn, and no box leaves the figure or covers another."""

import pandas as pd
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from analysis.figures.flow_diagram import flow_figure

LONG = "Participants who have never used a joystick or a game controller before this study"


def flow(*names):
    """Return a flow of these groups with two reasons of exclusion each."""
    why = "fewer than 3 completed laps: 2; max_late_share above 0.05: 1"
    rows = [(name, 20 + i, 1, 3, why, 16 + i) for i, name in enumerate(names)]
    columns = ["group", "recorded", "refused", "excluded", "reasons", "analysed"]
    return pd.DataFrame(rows, columns=columns)


def boxes(figure):
    """Return the drawn boxes of the texts, in pixels."""
    FigureCanvasAgg(figure).draw()
    texts = [text for text in figure.axes[0].texts if text.get_text()]
    return [(text.get_text(), text.get_bbox_patch().get_window_extent()) for text in texts]


@pytest.mark.parametrize(
    "names", [("usual", "eager"), ("a", "b", "c", "d", "e"), (LONG, "$x^2$ <b>组</b>")]
)
def test_boxes_are_in_the_figure_and_apart(names):
    """Also with five groups, long names and other scripts."""
    figure = flow_figure(flow(*names))
    drawn = [box for _, box in boxes(figure)]
    assert len(drawn) == 1 + 3 * len(names)
    for i, one in enumerate(drawn):
        assert one.x0 >= 0
        assert one.x1 <= figure.bbox.width
        assert one.y0 >= 0
        assert one.y1 <= figure.bbox.height
        for other in drawn[i + 1 :]:
            assert not one.overlaps(other)


def test_every_number_is_drawn():
    """Recorded in all, and for each group what became of them."""
    said = "\n".join(text for text, _ in boxes(flow_figure(flow("usual", "eager"))))
    for words in ("41 recorded", "allocated: 20", "allocated: 21",
                  "excluded: 3", "consent refused: 1", "analysed: 16", "analysed: 17"):  # fmt: skip
        assert words in said
