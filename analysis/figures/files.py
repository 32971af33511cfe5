"""A figure as bytes: the same figure gives the same bytes."""

import io
from collections.abc import Sequence
from dataclasses import dataclass

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from analysis.figures.missing_letters import figure_scripts
from analysis.figures.text import literal_text, make_literal

DPI = 150


Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Drawing:
    """A figure as files.

    Attributes
    ----------
    svg, png
        Their bytes.
    places
        Where the points that were asked for came to lie, in points from the upper left.
    """

    svg: bytes
    png: bytes
    places: tuple[Point, ...] = ()


def drawn(figure: Figure, points: Sequence[Point] = ()) -> Drawing:
    """Lay a figure out and draw it.

    Parameters
    ----------
    figure
        Not laid out yet.
    points
        Points in the units of its first axes, whose places are wanted.
    """
    settle(figure)
    places = _places(figure, points) if points else ()
    return Drawing(svg(figure), png(figure), places)


def _places(figure: Figure, points: Sequence[Point]) -> tuple[Point, ...]:
    width, height = 72 * figure.get_size_inches()
    ends = figure.axes[0].transData.transform(points)
    shares = figure.transFigure.inverted().transform(ends)
    return tuple((round(float(width * x), 1), round(float(height * (1 - y)), 1)) for x, y in shares)


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
