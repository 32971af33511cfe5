"""A recorded lap in a browser: looked at, moved through, chosen by its point."""

import time

import numpy as np
import pandas as pd
import pyarrow as pa
import pytest

from analysis.lap_pages.lap_data import LapOf, lap_data, lap_label
from analysis.lap_pages.page import render_laps
from analysis.measures.streams import Steps
from protocols.load import load_course


def until(page, expression):
    """Wait for something to be true: the page's policy allows no code of ours to wait inside."""
    end = time.monotonic() + 60
    while not page.evaluate(expression):
        assert time.monotonic() < end
        time.sleep(0.05)


PHONE = {"width": 390, "height": 844}


def _lap(course, number, condition):
    """Return a lap of ten seconds straight ahead, and which lap it is."""
    t = np.arange(0, 10, 0.1)
    steps = pd.DataFrame({"t_s": t, "x_m": course.start.x + 0.05 * t, "y_m": course.start.y})
    steps["heading_rad"], steps["p_help"], steps["intent_v"] = 0.1, t / 10, 0.05
    steps["intent_w"], steps["control"] = 0.0, np.where(t < 5, "driver", "model")
    for i in range(15):
        steps[f"segment_{i:02d}"] = 2.0
    of = LapOf("P0001", number, condition, completed=True, time_s=10.0 + number)
    return lap_data(of, Steps(pa.Table.from_pandas(steps)), course), lap_label(of)


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """Return the address of a page with two laps and three points."""
    course = load_course("lab-office")
    (one, first), (two, second) = _lap(course, 1, "alone"), _lap(course, 2, "<b>helped</b>")
    third = lap_label(LapOf("P0002", 1, "alone", completed=False, time_s=30.0))
    html = render_laps("A study", [course], [one, two], [one["key"]], points=[first, second, third])
    path = tmp_path_factory.mktemp("page") / "study.html"
    path.write_text(html)
    return path.as_uri()


def test_a_reviewer_asks_for_the_lap_behind_a_point(visit, address):
    """A click shows it; time moves everything; nothing is refused and nothing asked for."""
    page = visit(address)
    assert page.evaluate("document.body.dataset.shown") == "P0001-1"
    # Points stand by condition: alone twice, then helped.
    page.locator("#figure .point").nth(2).click()
    until(page, "document.body.dataset.shown === 'P0001-2'")
    assert page.locator("article h2").text_content().startswith("P0001, lap 2: <b>helped</b>")
    page.locator("#time").fill("7.5")
    until(page, "document.body.dataset.time === '7.50'")
    values = dict(
        zip(
            page.locator("dt").all_text_contents(),
            page.locator("dd").all_text_contents(),
            strict=True,
        )
    )
    assert values["in control"] == "model"
    assert float(values["p(h)"]) == pytest.approx(0.75, abs=0.011)
    page.locator("#figure .point").nth(1).click()
    assert "lad-study replay DIR --participant P0002 --lap 1" in page.locator("#said").inner_text()
    assert page.evaluate("document.body.dataset.shown") == "P0001-2"
    assert page.errors == []
    assert [said for said in page.said if "Content Security Policy" in said] == []
    assert [asked for asked in page.asked if not asked.startswith("file:")] == []


LONGER_NAMES = """
for (const option of document.querySelectorAll(".row option"))
  option.textContent += ", a condition whose name is longer than a phone is wide"
"""


def test_two_laps_side_by_side_play_on_a_phone(visit, address):
    """A link names them; time goes on by itself; nothing has to be scrolled sideways."""
    page = visit(f"{address}#P0001-1,P0001-2")
    page.set_viewport_size(PHONE)
    assert page.locator("article").count() == 2
    page.locator("#play").click()
    until(page, "Number(document.body.dataset.time) > 0.3")
    page.locator("#play").click()
    page.evaluate(LONGER_NAMES)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth + 1")
    drawn = "canvas => new Set(canvas.getContext('2d').getImageData(0, 0, 300, 200).data).size"
    assert page.locator("canvas.plan").first.evaluate(drawn) > 5
    assert page.errors == []
