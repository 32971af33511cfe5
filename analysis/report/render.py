"""A page as one self-contained HTML file."""

import base64
from collections.abc import Callable, Mapping
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined

from analysis.figures.files import Drawing, drawn
from analysis.page_policy import content_policy
from analysis.processes import HERE, Processes
from analysis.report.blocks import Page


def draw(page: Page, others: Processes = HERE) -> dict[str, Callable[[], Drawing]]:
    """Have every figure of a page drawn; return, by name, what waits for each."""
    return {
        picture.name: others.later(drawn, picture.figure, [(s.x, s.y) for s in picture.spots])
        for picture in page.pictures
    }


def figure_files(drawings: Mapping[str, Drawing], folder: str = "") -> dict[str, bytes]:
    """Return the figures' files by their path in a folder."""
    return {
        f"{folder}{name}.{kind}": getattr(drawing, kind)
        for kind in ("svg", "png")
        for name, drawing in drawings.items()
    }


def render(page: Page, drawings: Mapping[str, Drawing]) -> str:
    """Return the page as HTML with style and figures inside: it needs no network.

    Parameters
    ----------
    page
        What to show.
    drawings
        The figures, by name.
    """
    environment = Environment(
        loader=PackageLoader("analysis.report", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    style = files("analysis.report").joinpath("templates", "report.css").read_text("utf-8")
    sources = {name: _data_uri(drawing.svg) for name, drawing in drawings.items()}
    placed = {
        picture.name: list(zip(drawings[picture.name].places, picture.spots, strict=True))
        for picture in page.pictures
    }
    template = environment.get_template("report.html.j2")
    return template.render(
        page=page, style=style, sources=sources, placed=placed, policy=content_policy(style)
    )


def _data_uri(svg: bytes) -> str:
    return f"data:image/svg+xml;base64,{base64.b64encode(svg).decode()}"
