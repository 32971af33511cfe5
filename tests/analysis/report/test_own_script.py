"""A questionnaire in another script: its letters are shown, or the report says which are not."""

import re

import pytest

from analysis.figures.missing_letters import missing_scripts
from analysis.report.write import write_report

ITEMS = {
    "CJK": "\u6211\u89c9\u5f97\u8f6e\u6905\u5f88\u5bb9\u6613\u9a7e\u9a76",
    "Arabic": "\u0643\u0627\u0646\u062a \u0627\u0644\u0642\u064a\u0627\u062f\u0629",
    "emoji": "\U0001f9bd\U0001f44d",
    "Cyrillic": "\u041b\u0435\u0433\u043a\u043e",
}
INSTRUMENT = """\
schema: 1
name: own-script
title: "{CJK}"
anchors: ["1", "2", "3", "4", "{CJK}"]
agreement_from: 4
items:
  - {{id: A, subscale: task, text: "{CJK}"}}
  - {{id: B, subscale: task, text: "{Arabic}"}}
  - {{id: C, subscale: task, text: "{emoji}"}}
  - {{id: D, subscale: task, text: "{Cyrillic}"}}
"""
PROTOCOL = """\
schema: 1
name: own-script
title: "{CJK} {Arabic}"
conditions:
  free: {{}}
  limited: {{limitation: {{right_turn_rad_s: 0.15}}}}
laps:
  - {{condition: free, survey: [{{instrument: own.yaml, items: all}}]}}
  - {{condition: limited, survey: [{{instrument: own.yaml, items: all}}]}}
"""


@pytest.fixture(scope="module")
def report(write_made_up, tmp_path_factory):
    """Return the report's folder of a study that asks in four scripts."""
    folder = tmp_path_factory.mktemp("own-script")
    (folder / "own.yaml").write_text(INSTRUMENT.format(**ITEMS), "utf-8")
    (folder / "study.yaml").write_text(PROTOCOL.format(**ITEMS), "utf-8")
    return write_report(write_made_up(folder / "study", folder / "study.yaml", 3).folder).parent


def test_every_item_is_shown_or_named(report):
    """Letters that no shipped font has are text in the SVG; the caption says which scripts."""
    page = (report / "index.html").read_text("utf-8")
    captions = re.findall(r"<figcaption>(.*?)</figcaption>", page)
    drawn = {path.stem: path.read_text("utf-8") for path in report.glob("figures/*.svg")}
    (survey,) = (name for name in drawn if ITEMS["CJK"] in drawn[name])
    (caption,) = (text for text in captions if f"figures/{survey}.svg" in text)
    missing = missing_scripts(ITEMS.values())
    assert {"CJK", "emoji"} <= set(missing)
    assert f"draw the letters in {', '.join(missing)};" in caption
    for words in ITEMS.values():
        assert words in drawn[survey], "not there as text that a browser can draw"
        assert words in page


def test_what_the_shipped_font_has_is_drawn_and_not_named(report):
    """Cyrillic is in it: no reader is told that it was missing."""
    page = (report / "index.html").read_text("utf-8")
    assert missing_scripts([ITEMS["Cyrillic"]]) == ()
    assert "Cyrillic" not in page
