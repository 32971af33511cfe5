"""The report as a whole: what is written, and that it survives everything."""

import csv
import json
import math
import re
import shutil
from html.parser import HTMLParser

import pandas as pd
import pytest

from analysis.report import write_report
from analysis.report.page import build_page
from analysis.report.write import replace_folder
from analysis.results import analyse
from analysis.statistics import statistics_json
from protocols.files.errors import InputError
from protocols.record.reader import open_study


class Page(HTMLParser):
    """Collects what a test wants to know about a page."""

    def __init__(self, text):
        super().__init__()
        self.images, self.links, self.ids, self.stack = [], [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        if tag == "img":
            self.images.append(found)
        if tag == "a":
            self.links.append(found["href"])
        if "id" in found:
            self.ids.append(found["id"])
        if tag not in ("meta", "img", "link", "br"):
            self.stack.append(tag)

    def handle_endtag(self, tag):
        assert self.stack.pop() == tag


@pytest.fixture(scope="module")
def report(study, tmp_path_factory):
    """Return the folder of a report of a copied study directory."""
    copied = tmp_path_factory.mktemp("copied") / "study"
    shutil.copytree(study.folder, copied)
    page = write_report(copied)
    assert page == copied / "report" / "index.html"
    return page.parent


def test_the_page_is_well_formed_and_links_only_to_itself(report):
    """Tags close, ids are unique, links lead to a section, a file or a lap that is there."""
    page = Page((report / "index.html").read_text())
    assert page.stack == []
    assert len(set(page.ids)) == len(page.ids)
    laps = {link.partition("#")[2] for link in page.links if link.startswith("study.html#")}
    assert len(laps) > 10
    held = (report / "study.html").read_text()
    assert all(f'"key":"{lap}"' in held for lap in laps)
    for link in set(page.links) - {f"study.html#{lap}" for lap in laps}:
        assert link[1:] in page.ids if link.startswith("#") else (report / link).is_file()


def test_the_page_needs_no_network(report):
    """No address of another machine, no script; every figure is inside."""
    text = (report / "index.html").read_text()
    assert not re.search(r"<script|<link|url\(|@import", text)
    assert all(i["src"].startswith("data:image/svg+xml;base64,") for i in Page(text).images)


def test_every_figure_has_an_alternative_text_with_numbers(report):
    """A reader who cannot see the figure learns what it shows."""
    images = Page((report / "index.html").read_text()).images
    assert len(images) >= 6
    assert all(re.search(r"\d", image["alt"]) for image in images)


def test_the_answer_comes_first(report):
    """Did assistance help, how much, how sure: before anything else."""
    text = (report / "index.html").read_text()
    assert text.index("Did assistance help?</h2>") < text.index("Participants</h2>")
    assert re.search(r"\d% faster", text)
    assert "95% interval" in text


def test_what_could_mislead_is_said(report):
    """Synthetic participants and the fixed order of laps are on the first screen."""
    text = (report / "index.html").read_text()
    assert "The participants are synthetic" in text
    assert "practice and condition are confounded" in text


def test_figures_and_tables_lie_beside_the_page(report):
    """SVG and PNG of every figure; every table as CSV with a header."""
    svgs = {p.stem for p in (report / "figures").glob("*.svg")}
    assert svgs == {p.stem for p in (report / "figures").glob("*.png")}
    assert {"lap_times", "assistance_map", "section_shares", "model_quality"} <= svgs
    for path in (report / "tables").glob("*.csv"):
        with path.open() as stream:
            rows = list(csv.reader(stream))
        assert all(len(row) == len(rows[0]) for row in rows), path.name


def test_statistics_are_json_without_nan(report):
    """Strict JSON: what is missing is null."""

    def refuse(constant):
        raise AssertionError(constant)

    text = (report / "statistics.json").read_text()
    found = json.loads(text, parse_constant=refuse)
    assert found["flow"]["analysed"] == 6
    assert found["declared_comparisons"][0]["p_holm"] is not None
    assert found["versions"]["analysis"]["scipy"]


@pytest.mark.slow
def test_the_same_study_gives_the_same_report(report, study, tmp_path):
    """Written again from the same record, every file has the same bytes."""
    copied = tmp_path / "study"
    shutil.copytree(study.folder, copied)
    again = write_report(copied).parent
    for path in sorted(p for p in report.rglob("*") if p.is_file()):
        assert (again / path.relative_to(report)).read_bytes() == path.read_bytes(), path.name


@pytest.mark.parametrize(
    ("events", "said"),
    [
        ({"participants": 1}, "needs at least 2 pairs"),
        ({"participants": 2, "answer": 3}, "every difference is zero"),
        ({"unfinished": frozenset({(1, 2), (2, 2)})}, "2 pairs missing"),
        ({"withdrew": dict.fromkeys(range(1, 5), 3)}, "no pair is complete"),
        ({"participants": 2, "withdrew": {1: 0, 2: 0}}, "no pair is complete"),
        ({"participants": 3, "excluded": {1: "a", 2: "b", 3: "c"}}, "excluded: b"),
    ],
    ids=[
        "one participant",
        "equal answers",
        "unfinished laps",
        "condition missing",
        "all left",
        "nobody",
    ],
)
def test_what_cannot_be_computed_is_said_and_the_rest_computed(make_study, events, said, page_text):
    """The page is written whatever happened, and says why something is missing."""
    page = build_page(analyse(make_study(**events)))
    text = page_text(page)
    assert said in text
    assert "nan" not in text.lower().split()


def test_columns_without_a_value_are_named_and_the_rest_is_computed(make_study, erase, page_text):
    """Without positions there is no map, and the page says so; lap times are there."""
    study = make_study(participants=3)
    for column in ("x_m", "y_m", "h_would"):
        erase(study.folder, column)
    page = build_page(analyse(open_study(study.folder)))
    text = page_text(page)
    assert "Not recorded in any step: h_would, x_m, y_m." in text
    assert "No map: no position was recorded in any step." in text
    assert "assistance_map" not in {picture.name for picture in page.pictures}
    assert len(next(t for t in page.tables if t.name == "lap_times").rows) == 4


def test_steps_that_cannot_be_used_are_named(make_study, page_text):
    """Whole seconds at 10 Hz and an infinite probability: a report that says what is missing."""
    study = make_study(participants=2)
    for path in study.folder.rglob("steps-4.parquet"):
        steps = pd.read_parquet(path)
        steps["t_s"] = steps["t_s"].astype(int).astype(float)
        steps.loc[3, ["p_help", "x_m"]] = math.inf
        steps.to_parquet(path)
    page = build_page(analyse(open_study(study.folder)))
    text = page_text(page)
    assert "In the steps of 2 laps, t_s does not increase from step to step" in text
    assert "In the steps of 2 laps, p_help is infinite in some steps" in text


def test_minimal_tables_from_elsewhere_are_reported(make_study, page_text):
    """Participants by id alone, laps with five columns, no steps, no answers: a report."""
    study = make_study(participants=2)
    folder = study.folder
    shutil.rmtree(folder / "sessions")
    (folder / "surveys.parquet").unlink()
    head = folder / "study.yaml"
    head.write_text(
        re.sub(
            r"^seed: .*\norigin: .*$",
            "seed: null\norigin: elsewhere",
            head.read_text(),
            flags=re.MULTILINE,
        )
    )
    people = study.participants.select(["participant"]).to_pandas()
    people.to_parquet(folder / "participants.parquet")
    laps = ["participant", "lap", "condition", "completed", "lap_time_s", "practice"]
    study.laps.select(laps).to_pandas().to_parquet(folder / "laps.parquet")
    page = build_page(analyse(open_study(folder)))
    text = page_text(page)
    assert "8 laps came without steps" in text
    assert "% faster" in text


def test_answers_of_synthetic_people_are_called_assumptions(study, page_text):
    """In the questionnaire's section and beside the paper's percentages."""
    page = build_page(analyse(study))
    text = page_text(page)
    assert text.count("consequences of these assumptions, not findings") == 2


def test_why_an_interval_is_missing_is_said(make_study, page_text):
    """One participant: a mean, and a remark that says why it stands alone."""
    page = build_page(analyse(make_study(participants=1)))
    text = page_text(page)
    assert "mean difference: one pair: no interval and no t test" in text
    assert "practice would" not in text
    assert "the section on practice shows" not in text


def test_folded_tables_are_printed(study, page_text):
    """Paper cannot be unfolded."""
    page = build_page(analyse(study))
    text = page_text(page)
    assert "details::details-content { content-visibility: visible" in text


def test_a_withdrawal_is_shown_in_its_words(make_study, page_text):
    """What a participant said is text on the page, whatever is in it; silence is said too."""
    words = {1: "<b>dizzy</b> & tired"}
    page = build_page(analyse(make_study(withdrew={1: 3, 2: 3}, words=words)))
    text = page_text(page)
    assert "&lt;b&gt;dizzy&lt;/b&gt; &amp; tired" in text
    assert "<b>dizzy" not in text
    assert "no reason recorded" in text
    assert [t.name for t in page.tables].count("withdrawals") == 1


def test_without_withdrawals_there_is_no_table_of_them(report):
    """No participant left the uneventful study."""
    assert not (report / "tables" / "withdrawals.csv").exists()


def test_versions_come_with_the_number_of_sessions(make_study, page_text):
    """Each set of package versions that recorded sessions is stated, and how many it recorded."""
    folder = make_study(participants=3).folder
    path = folder / "sessions" / "P0003" / "manifest.json"
    manifest = json.loads(path.read_text())
    path.write_text(json.dumps(manifest | {"versions": {"numpy": "0.1"}}))
    results = analyse(open_study(folder))
    page = build_page(results)
    text = page_text(page)
    assert "Recording (1 session): numpy 0.1." in text
    assert "Recording (2 sessions): " in text
    recording = json.loads(statistics_json(results))["versions"]["recording"]
    assert sorted(used["sessions"] for used in recording) == [1, 2]


def test_an_older_report_is_replaced_whole(make_study):
    """A file of the old report that the new one has not is gone; nothing half-written is left."""
    folder = make_study(participants=2).folder
    (folder / "report").mkdir()
    (folder / "report" / "old.html").write_text("old")
    said = []
    write_report(folder, said.append)
    assert said[-1] == "Writing the report"
    assert not (folder / "report" / "old.html").exists()
    assert not list(folder.glob(".partial-*"))
    assert open_study(folder).participants.num_rows == 2


def test_a_failure_leaves_the_old_report(tmp_path):
    """When a file cannot be written, the folder that was there is there still."""
    target = tmp_path / "report"
    replace_folder(target, {"index.html": b"old"})
    with pytest.raises(OSError, match=r"\[Errno"):
        replace_folder(target, {"index.html": b"new", "index.html/x": b"impossible"})
    assert (target / "index.html").read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["report"]


def test_a_damaged_step_table_does_not_stop_the_report(make_study, page_text):
    """The file is named on the page; the participant is missing from the overlap, and counted."""
    study = make_study(participants=4)
    (study.folder / "sessions" / "P0002" / "steps-4.parquet").write_bytes(b"PAR1 is not enough")
    results = analyse(study)
    page = build_page(results)
    text = page_text(page)
    assert "Not read, and treated as missing: sessions/P0002/steps-4.parquet: " in text
    assert len(json.loads(statistics_json(results))["not_read"]) == 1
    note = "1 participant without recorded steps in both conditions left out"
    assert (results.overlap.n, results.overlap.notes[1:]) == (3, (note,))
    assert note in text


@pytest.mark.parametrize("what", ["nothing", "no study", "corrupt table"])
def test_bad_input_is_one_clear_line(make_study, tmp_path, what):
    """No folder, no study in it, a damaged file: where and what, and no report."""
    folder = tmp_path / "nothing"
    if what == "no study":
        folder.mkdir()
    elif what.startswith("corrupt"):
        folder = make_study(participants=2).folder
        (folder / "laps.parquet").write_bytes(b"PAR1 is not enough")
    with pytest.raises(InputError, match=re.escape(str(folder))):
        write_report(folder)
    assert not (folder / "report").exists()
