"""A page as one self-contained HTML file."""

import base64
from collections.abc import Mapping
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined

from analysis.page_policy import content_policy
from analysis.report.blocks import Page


def render(page: Page, svgs: Mapping[str, bytes]) -> str:
    """Return the page as HTML with style and figures inside: it needs no network.

    Parameters
    ----------
    page
        What to show.
    svgs
        The figures as SVG, by name.
    """
    environment = Environment(
        loader=PackageLoader("analysis.report", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    style = files("analysis.report").joinpath("templates", "report.css").read_text("utf-8")
    sources = {name: _data_uri(content) for name, content in svgs.items()}
    template = environment.get_template("report.html.j2")
    return template.render(page=page, style=style, sources=sources, policy=content_policy(style))


def _data_uri(svg: bytes) -> str:
    return f"data:image/svg+xml;base64,{base64.b64encode(svg).decode()}"
