"""The page: data, drawing scripts and style in one file that needs no network."""

import json
import re
from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any

from jinja2 import Environment, PackageLoader, StrictUndefined

from analysis.page_policy import content_policy
from protocols.course.drawing import SCRIPTS, course_picture, script
from protocols.course.schema import Course


def render_laps(
    title: str,
    courses: Sequence[Course],
    laps: Sequence[Mapping[str, Any]],
    shown: Sequence[str],
    *,
    points: Sequence[Mapping[str, Any]] = (),
    remark: str = "",
) -> str:
    """Return a page that shows laps: plan, first-person view, sticks and curves against time.

    Parameters
    ----------
    title
        Heading.
    courses
        Where the laps were driven, each once.
    laps
        As ``analysis.lap_pages.lap_data.lap_data`` returns them; one or more.
    shown
        Keys of the laps that are shown first: one, or two side by side.
    points
        Every lap of a study, as ``lap_label`` returns them, for a figure of lap times; a point
        whose lap is among ``laps`` shows it.
    remark
        A sentence about what the page holds.
    """
    environment = Environment(
        loader=PackageLoader("analysis.lap_pages", "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    folder = files("analysis.lap_pages").joinpath("templates")
    style = folder.joinpath("laps.css").read_text("utf-8")
    code = _module({name: script(name) for name in SCRIPTS}, folder.joinpath("laps.js").read_text())
    data = {
        "courses": {course.name: course_picture(course) for course in courses},
        "laps": list(laps),
        "shown": list(shown),
        "points": list(points),
    }
    return environment.get_template("laps.html.j2").render(
        title=title,
        remark=remark,
        style=style,
        script=code,
        data=_as_data(data),
        policy=content_policy(style, code),
        figure=bool(points),
    )


def _as_data(data: Mapping[str, Any]) -> str:
    """Return JSON that cannot end the element it stands in, whatever a study calls its laps."""
    text = json.dumps(data, separators=(",", ":"), sort_keys=True, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _module(modules: Mapping[str, str], page: str) -> str:
    """Return modules and the page's own code as one script: a file alone has nothing to import.

    Each module is a function of its own, so that equal names in two of them do not meet.
    """
    parts = ['"use strict";']
    for text in modules.values():
        names = re.findall(r"^export (?:function|const) (\w+)", text, re.MULTILINE)
        body = re.sub(r"^export ", "", text, flags=re.MULTILINE)
        given = ", ".join(names)
        parts.append(f"const {{ {given} }} = (() => {{\n{body}\nreturn {{ {given} }};\n}})();")
    parts.append(f"(() => {{\n{page}\n}})();")
    return "\n".join(parts)
