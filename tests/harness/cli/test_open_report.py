"""The report in the browser."""

import webbrowser

import pytest

from protocols.load import resolve_study
from protocols.record.store import open_folder


@pytest.fixture
def study(tmp_path):
    """Return a study directory without a report."""
    open_folder(tmp_path / "s", resolve_study("four-lap"), 0)
    return tmp_path / "s"


@pytest.mark.parametrize("browser", [True, False])
def test_the_page_is_opened_or_its_path_said(lad_study, study, monkeypatch, browser):
    """Exit code 1 where no browser can be started."""
    page = study / "report" / "index.html"
    page.parent.mkdir()
    page.write_text("")
    asked = []
    monkeypatch.setattr(webbrowser, "open", lambda address: asked.append(address) or browser)
    said = lad_study("open", "s")
    assert said.code == (0 if browser else 1)
    assert asked == [page.as_uri()]
    assert str(page) in said.out


def test_a_study_without_a_report_says_what_writes_one(lad_study, study, monkeypatch):
    """Exit code 2; no browser starts."""
    monkeypatch.setattr(webbrowser, "open", lambda _: pytest.fail("nothing to open"))
    said = lad_study("open", "s")
    assert (said.code, said.err) == (2, "s: has no report yet; `lad-study report s` writes it\n")
