"""The paper's figures."""

import pytest

from analysis.paper import PAPER, paper_figure
from analysis.roles import Part
from protocols.load import load_protocol


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("people/baseline/mean", 48.5),
        ("people/limited/mean", 76.7),
        ("people/demonstrator/mean", 44.55),
        ("people/model-1/mean", 56.1),
        ("people/model-1/gain", 20.6),
        ("people/model-1/speedup", 137),
        ("robot/baseline/mean", 34.59),
        ("robot/limited/mean", 59.11),
        ("robot/model-3/ks", 0.3125),
    ],
)
def test_figures_are_as_printed(key, value):
    """Sections IV and V, word for word."""
    assert PAPER[key].value == value


def test_the_papers_own_sums():
    """What we say about its arithmetic is right: 137% and 20.6 s follow, 62% does not."""
    limited, model = PAPER["people/limited/mean"].value, PAPER["people/model-1/mean"].value
    assert round(100 * limited / model) == PAPER["people/model-1/speedup"].value
    assert round(limited - model, 1) == PAPER["people/model-1/gain"].value
    increase = 100 * (limited / PAPER["people/baseline/mean"].value - 1)
    assert round(increase) == 58 != PAPER["people/limited/increase"].value


def test_a_model_the_paper_has_not_has_no_figure():
    """Two demonstrations before the lap: the paper prints nothing."""
    protocol = load_protocol("four-lap")
    assert paper_figure(protocol, Part("x", "model", 2), "mean") is None
