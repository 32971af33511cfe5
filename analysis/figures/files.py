"""A figure as bytes: the same figure gives the same bytes."""

import io

import matplotlib as mpl
from matplotlib.figure import Figure

DPI = 150


def settle(figure: Figure) -> None:
    """Lay a figure out for good; drawing it does not move anything afterwards."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")


def svg(figure: Figure) -> bytes:
    """Return a settled figure as SVG, without a date and with reproducible ids."""
    stream = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "lad-study", "svg.fonttype": "path"}):
        figure.savefig(stream, format="svg", dpi=DPI, metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def png(figure: Figure) -> bytes:
    """Return a settled figure as PNG."""
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=DPI, metadata={"Software": None})
    return stream.getvalue()
