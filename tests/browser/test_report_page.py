"""The report's page runs no script, whatever is written in a study."""

import re

import matplotlib.pyplot as plt
import pandas as pd
import pytest

from analysis.figures.files import drawn
from analysis.report.blocks import (
    Caution,
    Fact,
    Facts,
    Page,
    Paragraph,
    Picture,
    Remarks,
    Section,
    Shown,
    table,
)
from analysis.report.render import render

HOSTILE = (
    "<script>window.hit = 1</script>",
    '"><img src=x onerror="window.hit = 1">',
    "'><svg onload='window.hit = 1'>",
    "</title><script>window.hit = 1</script>",
    "</style><script>window.hit = 1</script>",
    "javascript:window.hit=1",
    "{{ 7 * 7 }}<a href='javascript:window.hit=1'>x</a>",
    "]]><script>window.hit = 1</script>",
    "&lt;script&gt;window.hit = 1&lt;/script&gt;",
)


def _page(text):
    figure = plt.figure(figsize=(2, 1))
    figure.text(0.1, 0.5, text.replace("$", ""))
    frame = pd.DataFrame({"a": [text], text: [1]})
    shown = [Shown(text, lambda row: str(row["a"]), words=True)]
    blocks = (
        Paragraph(text),
        Caution(text),
        Remarks((text,)),
        Facts((Fact(text, text, text),)),
        Picture("figure", text, text, figure),
        table("table", text, frame, shown),
        table("folded", text, frame, shown, folded=True),
    )
    page = Page(text, text, (Section("answer", text, blocks),))
    drawing = drawn(figure)
    plt.close(figure)
    return render(page, {"figure": drawing}), drawing.svg


@pytest.mark.parametrize("text", HOSTILE)
def test_a_hostile_text_stays_text(visit, tmp_path, text):
    """In every place of the page, and in a figure opened by itself; the file's name, too."""
    html, figure = _page(text)
    name = re.sub(r"[/\x00]", "", text)[:60]
    (tmp_path / f"{name}.html").write_text(html)
    (tmp_path / "figure.svg").write_bytes(figure)
    page = visit((tmp_path / f"{name}.html").as_uri())
    page.locator("details summary").click()
    page.wait_for_timeout(100)
    assert page.evaluate("window.hit") is None
    assert page.locator("h1").text_content() == text
    assert page.locator("script, h1 *, p.subtitle *, td *").count() == 0
    assert page.errors == []
    alone = visit((tmp_path / "figure.svg").as_uri())
    assert alone.evaluate("window.hit") is None


def test_the_policy_stops_a_script_that_got_in(visit, tmp_path):
    """Were something ever written unescaped, the browser would refuse to run it."""
    html, _ = _page("title")
    script = (
        "<script>window.hit = 1</script><img src=x onerror='window.hit = 1'>"
        "<iframe srcdoc='<script>parent.hit = 1</script>'></iframe>"
        "<a id='go' href='javascript:window.hit = 1'>go</a>"
        "<script src='https://example.org/a.js'></script>"
        "<form id='f' action='https://example.org/'></form>"
    )
    assert "<main>" in html
    (tmp_path / "page.html").write_text(html.replace("<main>", f"<main>{script}"))
    page = visit((tmp_path / "page.html").as_uri())
    page.locator("#go").click()
    page.wait_for_timeout(200)
    assert page.evaluate("window.hit") is None
    assert any("Content Security Policy" in said for said in page.said)
    abroad = [address for address in page.asked if address.startswith("https:")]
    assert all(page.failed[address] == "csp" for address in abroad)


def test_the_page_keeps_its_style_and_figures(visit, tmp_path):
    """The policy lets through what is the page's own: nothing of it is refused."""
    html, _ = _page("title")
    (tmp_path / "page.html").write_text(html)
    page = visit((tmp_path / "page.html").as_uri())
    assert [said for said in page.said if "Content Security Policy" in said] == []
    assert page.locator("img").evaluate("image => image.naturalWidth") > 0
    rules = "[...document.styleSheets].reduce((n, sheet) => n + sheet.cssRules.length, 0)"
    assert page.evaluate(rules) > 10
    assert [address for address in page.asked if address.startswith("http")] == []


def test_a_table_of_twelve_conditions_fits_a_printed_page(visit, tmp_path):
    """On paper nothing can be scrolled: cells go on in the next line, and no column is cut off."""
    names = [f"model {i}" for i in range(12)]
    frame = pd.DataFrame([dict.fromkeys(["measure", *names], "-20.94 (0.24; 12)")])
    shown = [Shown(name, lambda row, name=name: row[name], words=not i)
             for i, name in enumerate(frame)]  # fmt: skip
    page = Page("title", "", (Section("a", "a", (table("wide", "", frame, shown),)),))
    (tmp_path / "page.html").write_text(render(page, {}))
    tab = visit((tmp_path / "page.html").as_uri())
    tab.set_viewport_size({"width": 670, "height": 950})  # A4 less its margins
    tab.emulate_media(media="print")
    assert tab.locator("table").evaluate("table => table.scrollWidth") <= 670
