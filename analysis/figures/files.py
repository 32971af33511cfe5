"""A figure as bytes: the same figure gives the same bytes."""

import io

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from analysis.figures.missing_letters import figure_scripts
from analysis.figures.text import literal_text, make_literal

DPI = 150


def settle(figure: Figure) -> None:
    """Lay a figure out for good, its text as written; drawing it does not move anything then."""
    make_literal(figure)
    with literal_text():
        figure.draw_without_rendering()
    figure.set_layout_engine("none")


def svg(figure: Figure) -> bytes:
    """Return a settled figure as SVG, without a date and with reproducible ids.

    Letters are shapes, alike everywhere; where the figures' font lacks some, they stay text, which
    the reader's browser draws with its own fonts.

    The canvas is asked itself: ``savefig`` would draw everything once more to lay it out.
    """
    stream = io.BytesIO()
    figure.set_dpi(DPI)
    letters = "none" if figure_scripts(figure) else "path"
    reproducible = mpl.rc_context({"svg.hashsalt": "lad-study", "svg.fonttype": letters})
    with reproducible, literal_text():
        canvas = FigureCanvasSVG(figure)
        canvas.print_svg(  # type: ignore[no-untyped-call]
            stream, metadata={"Date": None, "Creator": None}
        )
    return stream.getvalue()


def png(figure: Figure) -> bytes:
    """Return a settled figure as PNG."""
    stream = io.BytesIO()
    figure.set_dpi(DPI)
    with literal_text():
        canvas = FigureCanvasAgg(figure)
        canvas.print_png(stream, metadata={"Software": None})  # type: ignore[no-untyped-call]
    return stream.getvalue()
