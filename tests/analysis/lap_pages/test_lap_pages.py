"""What an interactive page holds of a lap, and which laps a study's page holds."""

import base64
import json
import re
from itertools import pairwise

import numpy as np
import pyarrow as pa
import pytest

from analysis.lap_pages import study_page as pages
from analysis.lap_pages.lap_data import LapOf, lap_data, packed
from analysis.lap_pages.page import render_laps
from analysis.measures.streams import Steps
from analysis.results import analyse
from protocols.course.gates import GateCounter


def held(html):
    """Return the data of a page."""
    return json.loads(re.search(r'id="data">(.*?)</script>', html, re.DOTALL).group(1))


def unpacked(kept):
    """Return the numbers of a stream, as the page's script does."""
    resolution, text = kept
    whole = np.frombuffer(base64.b64decode(text), dtype="<i2")
    return np.where(whole == -32768, np.nan, whole * resolution)


@pytest.fixture(scope="module")
def results(study):
    """Return everything computed about the made-up study."""
    return analyse(study)


def test_a_page_has_every_step_of_the_record(study, steps):
    """To its resolution; who is in control, and the gates, as the world counts them."""
    data = lap_data(
        LapOf("P0001", 4, "m", completed=True, time_s=40.0), Steps(pa.table(steps)), study.course
    )
    assert data["steps"] == len(steps["t_s"])
    for name, kept in data["streams"].items():
        recorded = steps[name].astype(np.float64)
        if name == "heading_rad":
            recorded = np.arctan2(np.sin(recorded), np.cos(recorded))
        assert unpacked(kept) == pytest.approx(recorded, abs=0.51 * kept[0], nan_ok=True)
        assert kept[0] < 0.02 or name in {"h", "h_would"}
    control = [word for _, word in data["control"]]
    assert all(one != other for one, other in pairwise(control))
    counter = GateCounter(study.course)
    places = np.column_stack([steps["x_m"], steps["y_m"]]).tolist()
    for before, after in pairwise(places):
        counter.advance(tuple(before), tuple(after))
    assert len(data["gates"]) == counter.passed


def test_large_numbers_are_coarser_and_missing_ones_stay_missing():
    """A lap of an hour fits; infinity is not a number of the record."""
    values = np.array([0.0, 3600.0, np.nan, np.inf])
    kept = packed(values, 0.005)
    assert unpacked(kept)[:2] == pytest.approx(values[:2], abs=0.06)
    assert np.isnan(unpacked(kept)[2:]).all()


def test_a_small_study_is_held_whole_and_the_page_is_the_same_each_time(results):
    """Every analysed lap has its point and its steps; the first one is shown."""
    html = pages.study_page(results)
    assert html == pages.study_page(results)
    data = held(html)
    keys = [lap["key"] for lap in data["laps"]]
    assert keys == [point["key"] for point in data["points"]]
    assert len(keys) == len(results.frames.laps)
    assert data["shown"] == keys[:1]


def test_a_large_study_is_held_in_part_whole_people_at_a_time(results, monkeypatch):
    """As many as there is room for; every lap still has its point."""
    every = len(results.records.steps)
    monkeypatch.setattr(pages, "MOST_STEPS", every // 2)
    laps = pages.held_laps(results)
    people = {lap.participant for lap in laps}
    assert 0 < len(people) < len(results.frames.participants)
    of_them = results.frames.laps["participant"].isin(people)
    assert len(laps) == int(of_them.sum())
    assert len(held(pages.study_page(results))["points"]) == len(results.frames.laps)


def test_what_a_study_calls_things_cannot_end_the_data(study, steps):
    """No tag, whatever a condition is called; and the page needs nothing from elsewhere."""
    hostile = "</script><script>window.hit = 1</script>"
    of = LapOf("P0001", 4, hostile, completed=True, time_s=1.0)
    lap = lap_data(of, Steps(pa.table(steps)), study.course)
    html = render_laps(hostile, [study.course], [lap], [lap["key"]], points=[lap])
    assert html.count("<script") == 2
    assert held(html)["laps"][0]["condition"] == hostile
    assert "http://" not in html.replace("http://www.w3.org/2000/svg", "")
    assert "https://" not in html
