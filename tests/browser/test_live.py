"""A live session in real browsers: one drives, one demonstrates, one runs the experiment."""

import json
import subprocess
import sys
import time
import urllib.parse

import pyarrow.parquet as pq
import pytest

from protocols.record.check import check_study
from protocols.record.reader import open_study

LIMITED = {"limitation": {"right_turn_rad_s": 0.15}}
PROTOCOL = {
    "schema": 1,
    "name": "three browsers",
    "title": "A short session with three living people",
    "cohort": {
        "participants": 1,
        "driver": {"use": "live"},
        "demonstrator": {"use": "live"},
        "respondent": {"use": "live"},
    },
    "consent": {"text": "# Taking part\n\nYou drive.\n\n- You can stop.", "version": "7"},
    "demographics": ["age_years", "gender"],
    "conditions": {
        "practice": {},
        "shown": {**LIMITED, "assistant": "demonstrator", "training": True},
        "helped": {**LIMITED, "assistant": "model"},
    },
    "laps": [
        {"condition": "practice", "practice": True, "until_comfortable": True},
        {
            "condition": "shown",
            "time_limit_s": 15,
            "survey": [{"instrument": "driving-assistance", "items": ["Q1", "Q2", "Q5"]}],
        },
        {"condition": "helped", "time_limit_s": 6},
    ],
    "debrief": {"text": "# Thank you\n\nThis was about help."},
    "live": {"completion": {"code": "C-77"}},
}
DESKTOP, TABLET, PHONE = (1280, 800), (820, 1180), (390, 844)


@pytest.fixture
def live(tmp_path):
    """Serve the study by the command line; return its links and its folder."""
    (tmp_path / "live.yaml").write_text(json.dumps(PROTOCOL))
    links, folder = tmp_path / "links.json", tmp_path / "study"
    command = (
        "live", str(tmp_path / "live.yaml"), "--out", str(folder), "--port", "0",
        "--links", str(links), "--no-report",
    )  # fmt: skip
    with (tmp_path / "said").open("w") as said:
        server = subprocess.Popen(  # noqa: S603  # our own interpreter and code
            [sys.executable, "-c", "from harness.cli import main; main()", *command],
            stdout=said, stderr=said,
        )  # fmt: skip
        until(lambda: links.exists() or server.poll() is not None, 120)
        assert server.poll() is None, (tmp_path / "said").read_text()
        yield json.loads(links.read_text()), folder, server
        server.kill()
        server.wait()


def sized(tab, size):
    """Give a tab the size of a device."""
    tab.set_viewport_size({"width": size[0], "height": size[1]})
    return tab


def pose(tab):
    """Return where a tab shows the chair."""
    return json.loads(tab.evaluate("document.body.dataset.pose || '[-1, 0, 0]'"))


def until(condition, seconds=60):
    """Wait for something to be true: the page's policy allows no code of ours to wait inside."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.1)


def fits(tab):
    """Tell whether nothing has to be scrolled sideways."""
    return tab.evaluate("document.documentElement.scrollWidth <= innerWidth + 1")


def test_three_browsers_make_a_study(live, visit):  # noqa: PLR0915  # one session, told in order
    """Consent to debriefing; takeover by clutch; the model learns from that demonstrator."""
    links, folder, server = live
    participant = sized(visit(f"{links['participant']}?PROLIFIC_PID=abc"), PHONE)
    demonstrator = sized(visit(links["demonstrator"]), TABLET)
    console = sized(visit(links["experimenter"]), DESKTOP)
    press = lambda tab, name: tab.get_by_test_id(name).click(timeout=60_000)  # noqa: E731
    wait = lambda tab, name: tab.get_by_test_id(name).wait_for(timeout=60_000)  # noqa: E731

    press(participant, "check-continue")
    wait(participant, "consent-agree")
    assert fits(participant)
    assert "Taking part You drive. You can stop." in " ".join(
        participant.inner_text("main").split()
    )
    press(participant, "consent-agree")
    participant.locator("input[name=age_years]").fill("31")
    press(participant, "demographics-submit")
    press(participant, "instructions-continue")
    wait(demonstrator, "lobby")
    wait(console, "session-P0001")

    press(participant, "lap-start")
    wait(participant, "driving")
    participant.keyboard.down("ArrowUp")
    until(lambda: pose(participant)[0] > 0.5)
    console.get_by_test_id("note-text").fill("drives well")
    press(console, "note-save")
    press(console, "lap-pause")
    time.sleep(0.5)
    stands = pose(participant)
    time.sleep(0.5)
    assert pose(participant) == stands
    press(console, "lap-resume")
    press(participant, "comfortable")
    participant.keyboard.up("ArrowUp")

    press(participant, "lap-start")
    wait(participant, "driving")
    participant.keyboard.down("ArrowUp")
    wait(demonstrator, "watching")
    for key in ("ArrowUp", "ArrowRight", "Space"):
        demonstrator.keyboard.down(key)
    participant.get_by_test_id("helped").wait_for(state="visible", timeout=60_000)
    assert "demonstrator" not in participant.content().lower()
    wait(participant, "questions-submit")
    assert fits(participant)
    participant.get_by_test_id("answer-Q1-4").check()
    participant.get_by_test_id("answer-Q5-5").check()
    press(participant, "questions-submit")

    press(participant, "lap-start")
    press(participant, "debrief-done")
    wait(participant, "completion-code")
    server.wait(60)

    assert check_study(folder) == ()
    study = open_study(folder)
    assert study.laps["end_reason"].to_pylist() == ["comfortable", "time_limit", "time_limit"]
    assert study.participants["age_years"].to_pylist() == [31]
    assert study.participants["kind"].to_pylist() == ["live"]
    assert dict(
        zip(study.surveys["item"].to_pylist(), study.surveys["response"].to_pylist(), strict=True)
    ) == {"Q1": 4, "Q2": None, "Q5": 5}
    steps = study.steps("P0001", 1).to_pandas()
    helped = steps[steps["control"] == "demonstrator"]
    assert len(helped) > 10
    assert (helped["h"] == 1).all()
    assert (helped["a_w"] < 0).any()
    assert steps["driver_device"].dropna().eq("keyboard").all()
    assert steps["demonstrator_v"].notna().any()
    assert study.laps["basis_vectors_how"].to_pylist()[1] > 5
    events = pq.read_table(folder / "sessions" / "P0001" / "event_rows.parquet").to_pandas()
    assert {"pause", "resume", "note", "browser", "machine check"} <= set(events["event"])
    assert "drives well" in set(events["note"])
    everything = b"".join(path.read_bytes() for path in folder.rglob("*") if path.is_file())
    assert b"abc" not in (folder / "participants.parquet").read_bytes()
    for link in links.values():
        assert urllib.parse.urlsplit(link).path.encode() not in everything
    for tab in (participant, demonstrator, console):
        assert tab.errors == []


def test_who_refuses_leaves_nothing(live, visit):
    """Refusing ends politely; the number and the date stay, and no data."""
    links, folder, server = live
    participant = visit(links["participant"])
    participant.get_by_test_id("check-continue").click(timeout=60_000)
    participant.get_by_test_id("consent-refuse").click(timeout=60_000)
    participant.get_by_text("Thank you").wait_for(timeout=60_000)
    server.wait(60)
    assert not list((folder / "sessions").iterdir())
    assert not list((folder / "journals").iterdir())
    assert [path.name for path in (folder / "withdrawn").iterdir()] == ["P0001.json"]
