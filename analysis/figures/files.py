"""A figure as bytes: the same figure gives the same bytes."""

import io

import matplotlib as mpl
from matplotlib.figure import Figure

DPI = 150


def settle(figure: Figure) -> None:
    """Fix a figure's layout; drawing it later does not change the layout."""
    figure.draw_without_rendering()
    figure.set_layout_engine("none")


def svg(figure: Figure) -> bytes:
    """Return a settled figure as SVG, without a date and with reproducible ids."""
    image = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "lad-study", "svg.fonttype": "path"}):
        figure.savefig(image, format="svg", dpi=DPI, metadata={"Date": None, "Creator": None})
    return image.getvalue()


def png(figure: Figure) -> bytes:
    """Return a settled figure as PNG."""
    image = io.BytesIO()
    figure.savefig(image, format="png", dpi=DPI, metadata={"Software": None})
    return image.getvalue()
