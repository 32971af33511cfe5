"""A live session in real browsers: one drives, one demonstrates, one runs the experiment."""

import json
import signal
import time
import urllib.parse

import pyarrow.parquet as pq
import pytest
import yaml

from protocols.load import load_course
from protocols.record.check import check_study
from protocols.record.reader import open_study
from protocols.shipped import shipped_text

SECONDS = {"baseline": 5, "limited": 5, "human-assisted": 8, "model-assisted": 6}


def short(name):
    """Return a shipped protocol for one participant, its laps cut short."""
    data = yaml.safe_load(shipped_text(name))
    data["cohort"]["participants"] = 1
    data["live"]["completion"] = {"code": "C-77"}
    del data["exclusion"]  # a busy machine is late, and whoever is excluded is replaced
    for lap in data["laps"]:
        lap["time_limit_s"] = SECONDS.get(lap["condition"], 60)
    return data


DESKTOP, TABLET, PHONE = (1280, 800), (820, 1180), (390, 844)


@pytest.fixture
def live(serve_live):
    """Serve the study by the command line; return its links, its folder and the server."""
    return serve_live(short("four-lap-live"))


def sized(tab, size):
    """Give a tab the size of a device."""
    tab.set_viewport_size({"width": size[0], "height": size[1]})
    return tab


def pose(tab):
    """Return where a tab shows the chair."""
    return json.loads(tab.evaluate("document.body.dataset.pose || '[-1, 0, 0]'"))


def fits(tab):
    """Tell whether nothing has to be scrolled sideways."""
    return tab.evaluate("document.documentElement.scrollWidth <= innerWidth + 1")


def press(tab, name):
    """Press a button, as soon as it is there."""
    tab.get_by_test_id(name).click(timeout=120_000)


def wait(tab, name):
    """Wait for a part of a page."""
    tab.get_by_test_id(name).wait_for(timeout=120_000)


def drive(steering, until, *tabs):
    """Steer by what the pages show until the participant is asked how the lap was."""
    course = load_course("lab-office")
    people = [steering(tab, course) for tab in tabs]
    asked = tabs[0].get_by_test_id("questions-submit")
    until(lambda: [person.step() for person in people] and asked.count(), 120)
    for person in people:
        person.release()


def answer(tab, items, point):
    """Answer the items that are asked with one point of the scale."""
    for item in items:
        tab.get_by_test_id(f"answer-{item}-{point}").check()
    press(tab, "questions-submit")


def test_a_whole_session_by_scripted_browsers(live, visit, steering, until):  # noqa: PLR0915  # one, told in order
    """Four laps by keyboard, help by clutch; check and report accept what comes out."""
    links, folder, server = live
    participant = sized(visit(f"{links['participant']}?PROLIFIC_PID=abc"), PHONE)
    demonstrator = sized(visit(links["demonstrator"]), TABLET)
    console = sized(visit(links["experimenter"]), DESKTOP)

    press(participant, "check-continue")
    wait(participant, "consent-agree")
    assert fits(participant)
    assert "You can stop at any time" in participant.inner_text("main")
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
    time.sleep(0.3)
    assert pose(participant) == stands
    press(console, "lap-resume")
    press(participant, "comfortable")
    participant.keyboard.up("ArrowUp")

    few, all_items = [f"Q{n}" for n in range(1, 5)], [f"Q{n}" for n in range(1, 12)]
    for point in (5, 2):  # baseline and limited
        press(participant, "lap-start")
        wait(participant, "driving")
        drive(steering, until, participant)
        assert fits(participant)
        answer(participant, few, point)

    press(participant, "lap-start")
    wait(demonstrator, "watching")
    demonstrator.keyboard.down("Space")
    participant.get_by_test_id("helped").wait_for(state="visible", timeout=120_000)
    assert "demonstrator" not in participant.content().lower()
    drive(steering, until, participant, demonstrator)
    demonstrator.keyboard.up("Space")
    answer(participant, all_items, 4)

    press(participant, "lap-start")
    wait(participant, "driving")
    drive(steering, until, participant)
    answer(participant, all_items, 3)
    press(participant, "debrief-done")
    wait(participant, "completion-code")
    assert server.wait(180) == 0

    assert check_study(folder) == ()
    assert (folder / "report" / "index.html").stat().st_size > 10_000
    study = open_study(folder)
    assert study.laps["end_reason"].to_pylist() == ["comfortable", *["time_limit"] * 4]
    assert study.participants["age_years"].to_pylist() == [31]
    assert study.participants["kind"].to_pylist() == ["live"]
    answers = study.surveys.to_pandas().groupby("condition")["response"].unique()
    assert {name: list(points) for name, points in answers.items()} == {
        "baseline": [5], "limited": [2], "human-assisted": [4], "model-assisted": [3],
    }  # fmt: skip
    driven = [study.steps("P0001", lap)["intent_v"].to_numpy().max() for lap in range(5)]
    assert max(driven) > 0.3  # by the keys; on a busy machine not in every lap
    steps = study.steps("P0001", 3).to_pandas()
    helped = steps[steps["control"] == "demonstrator"]
    assert len(helped) > 10
    assert (helped["h"] == 1).all()
    assert (helped["a_v"] > 0).any()
    assert helped["h_would"].notna().all()
    assert steps["driver_device"].dropna().eq("keyboard").all()
    assert steps["demonstrator_v"].notna().any()
    assert study.laps["training"].to_pylist() == [False, False, False, True, False]
    learnt = study.laps["basis_vectors_how"].to_pylist()
    assert learnt[3] > 5
    assert learnt[4] == learnt[3]
    events = pq.read_table(folder / "sessions" / "P0001" / "event_rows.parquet").to_pandas()
    assert {"pause", "resume", "note", "browser", "machine check"} <= set(events["event"])
    assert "drives well" in set(events["note"])
    everything = b"".join(path.read_bytes() for path in folder.rglob("*") if path.is_file())
    assert b"abc" not in (folder / "participants.parquet").read_bytes()
    for link in links.values():
        assert urllib.parse.urlsplit(link).path.encode() not in everything
    for tab in (participant, demonstrator, console):
        assert tab.errors == []


def test_who_refuses_leaves_nothing(live, visit, until):
    """Refusing ends politely; the number and the date stay, no data, and the place is free."""
    links, folder, server = live
    participant = visit(links["participant"])
    participant.get_by_test_id("check-continue").click(timeout=120_000)
    participant.get_by_test_id("consent-refuse").click(timeout=120_000)
    participant.get_by_text("Thank you").wait_for(timeout=120_000)
    until((folder / "withdrawn").exists)
    assert not list((folder / "sessions").iterdir())
    assert not list((folder / "journals").iterdir())
    assert [path.name for path in (folder / "withdrawn").iterdir()] == ["P0001.json"]
    visit(links["participant"]).get_by_test_id("check-continue").click(timeout=120_000)
    assert [path.name for path in (folder / "journals").iterdir()] == ["P0002.jsonl"]
    server.send_signal(signal.SIGINT)
    assert server.wait(60) == 0, (folder.parent / "said").read_text()
