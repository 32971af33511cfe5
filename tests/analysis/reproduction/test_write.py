"""The page of a reproduction: what is in it, and that it is there whole or not at all."""

import json
import re

import pytest

from analysis.reproduction import lessons
from analysis.reproduction.write import PAGE, replace_all, write_reproduction
from protocols.files.errors import InputError

ASKED = [
    *(f"rd lap {c}" for c in
      ("baseline", "limited", "demonstrator", "model after 1", "model after 3")),
    *(f"speedup {c}" for c in ("demonstrator", "model after 1", "model after 3")),
    *(f"auc {c}" for c in ("after 1", "training median", "test median")),
    "tost model after 3",
    *(f"lap {c}" for c in ("baseline", "limited", "human-assisted", "model-assisted")),
    "speedup model-assisted",
    "seconds gained model-assisted",
]  # fmt: skip
"""Quantities that a reader of the JSON may count on."""


@pytest.fixture(scope="module")
def folder(write_made_up, tmp_path_factory):
    """Return a reproduction of made-up studies, its page written twice over."""
    folder = tmp_path_factory.mktemp("reproduction")
    for protocol, participants in (("rd-laps", 2), ("rd-accuracy", 1), ("four-lap", 2)):
        write_made_up(folder / "studies" / protocol, protocol, participants)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(lessons, "PERMUTATIONS", 2)
        page, _ = write_reproduction(folder)
        before = read(folder)
        write_reproduction(folder)
    assert page == folder / "reproduction.html"
    assert read(folder) == before
    return folder


def read(folder):
    """Return every file of the page."""
    return {
        p.relative_to(folder).as_posix(): p.read_bytes()
        for p in folder.rglob("*")
        if p.is_file() and "studies" not in p.parts
    }


def rows(folder):
    """Return the rows of the JSON."""
    return json.loads((folder / f"{PAGE}.json").read_text())


def recomputed(row):
    """Return the verdict that a reader of the documentation would reach."""
    tolerance, ours, paper = row["tolerance"], row["ours"], row["paper"]
    if tolerance is None:
        return "none"
    holds = {
        "near paper": lambda: abs(ours - paper) < tolerance,
        "at least": lambda: ours > paper - tolerance,
        "near zero": lambda: abs(ours) < tolerance,
        "interval near zero": lambda: -tolerance < row["low"] and row["high"] < tolerance,
    }[row["rule"]]()
    return "holds" if holds else "differs"


def test_the_json_has_every_quantity_once_with_every_field(folder):
    """What was asked for is there; kinds and verdicts are among those allowed."""
    found = rows(folder)
    names = [row["quantity"] for row in found]
    assert set(ASKED) <= set(names)
    assert len(set(names)) == len(names)
    for row in found:
        assert {"section", "quantity", "unit", "paper", "ours", "n", "low", "high", "tolerance",
                "kind", "verdict"} <= row.keys()  # fmt: skip
        assert row["kind"] in ("calibrated", "predicted", "descriptive")


def test_verdicts_recompute_from_the_json(folder):
    """Every verdict follows from its row; eight quantities have one."""
    found = rows(folder)
    assert [recomputed(row) for row in found] == [row["verdict"] for row in found]
    assert sum(row["verdict"] != "none" for row in found) == 8


def test_numbers_lie_in_their_intervals(folder):
    """Low, ours, high in this order, wherever there is an interval."""
    for row in rows(folder):
        if row["low"] is not None and row["ours"] is not None:
            assert row["low"] <= row["ours"] <= row["high"]


def test_html_and_markdown_show_every_row(folder):
    """One line per quantity in both; every figure inside the HTML and beside the Markdown."""
    html, markdown = ((folder / f"{PAGE}.{kind}").read_text() for kind in ("html", "md"))
    for row in rows(folder):
        assert f'<th scope="row" class="words">{row["quantity"]}</th>' in html
        assert re.search(rf"^\| {re.escape(row['quantity'])} \|.*\| {row['kind']} \|", markdown,
                         re.MULTILINE)  # fmt: skip
    assert html.count("data:image/svg+xml;base64,") == 7
    for name in re.findall(r"\]\((figures/[^)]+)\)", markdown):
        assert (folder / name).is_file()
    assert not re.search(r"<script|<link|url\(|@import", html)
    for link in re.findall(r'href="((?:figures|tables)/[^"]+)"', html):
        assert (folder / link).is_file()


def test_nothing_is_left_beside_the_page(folder):
    """No partial file remains."""
    assert sorted(p.name for p in folder.iterdir()) == [
        "figures", f"{PAGE}.html", f"{PAGE}.json", f"{PAGE}.md", "studies", "tables",
    ]  # fmt: skip


def test_a_page_that_cannot_be_staged_changes_nothing(tmp_path):
    """When a file cannot be written, the old ones are untouched and nothing is left."""
    replace_all(tmp_path, {"a.html": b"old", "figures/a.svg": b"old"})
    with pytest.raises(OSError, match=r"a\.html"):
        replace_all(tmp_path, {"a.html": b"new", "a.html/b": b"impossible"})
    assert read(tmp_path) == {"a.html": b"old", "figures/a.svg": b"old"}


def test_an_older_page_is_replaced_as_a_whole(tmp_path):
    """Figures that the new page has not are gone."""
    replace_all(tmp_path, {"a.html": b"old", "figures/old.svg": b"old"})
    replace_all(tmp_path, {"a.html": b"new", "figures/new.svg": b"new"})
    assert read(tmp_path) == {"a.html": b"new", "figures/new.svg": b"new"}


def test_a_missing_study_is_named(tmp_path):
    """One line that says which folder is not there."""
    with pytest.raises(InputError, match="rd-laps"):
        write_reproduction(tmp_path)
