"""A figure as bytes: the same figure gives the same bytes."""

import io

import matplotlib as mpl
from matplotlib.figure import Figure

from analysis.figures.text import literal_text, make_literal

DPI = 150


def settle(figure: Figure) -> None:
    """Lay a figure out for good, its text as written; drawing it does not move anything then."""
    make_literal(figure)
    with literal_text():
        figure.draw_without_rendering()
    figure.set_layout_engine("none")


def svg(figure: Figure) -> bytes:
    """Return a settled figure as SVG, without a date and with reproducible ids."""
    stream = io.BytesIO()
    reproducible = mpl.rc_context({"svg.hashsalt": "lad-study", "svg.fonttype": "path"})
    with reproducible, literal_text():
        figure.savefig(stream, format="svg", dpi=DPI, metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def png(figure: Figure) -> bytes:
    """Return a settled figure as PNG."""
    stream = io.BytesIO()
    with literal_text():
        figure.savefig(stream, format="png", dpi=DPI, metadata={"Software": None})
    return stream.getvalue()
