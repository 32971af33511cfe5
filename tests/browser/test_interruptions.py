"""What a browser does when its person is not there: the chair stands, and the record says why."""

import json

import pyarrow.parquet as pq
import pytest

PROTOCOL = {
    "schema": 1,
    "name": "interrupted",
    "title": "One lap in a browser",
    "cohort": {
        "participants": 1,
        "driver": {"use": "live"},
        "demonstrator": None,
        "respondent": None,
    },
    "conditions": {"free": {}},
    "laps": [
        {"condition": "free", "practice": True, "until_comfortable": True},
        {"condition": "free", "time_limit_s": 2},
    ],
}

# What a test may change in a page: whether it is hidden or has the focus, and a gamepad.
PRETEND = """
window.pretend = { hidden: false, focus: true, pad: null };
Object.defineProperty(document, "hidden", { get: () => window.pretend.hidden });
document.hasFocus = () => window.pretend.focus;
navigator.getGamepads = () => [window.pretend.pad];
"""
HIDE = "pretend.hidden = true; document.dispatchEvent(new Event('visibilitychange'))"
SHOW = "pretend.hidden = false; document.dispatchEvent(new Event('visibilitychange'))"
BLUR = "pretend.focus = false; dispatchEvent(new Event('blur'))"
FOCUS = "pretend.focus = true; dispatchEvent(new Event('focus'))"
PLUG = (
    "pretend.pad = { connected: true, id: 'stick', axes: [0, -1], buttons: [{ pressed: false }] }"
)
UNPLUG = "pretend.pad = null"


def moves(tab):
    """Return whether the chair is shown to move, and wait a moment to see it."""
    before = json.loads(tab.evaluate("document.body.dataset.pose || '[0, 0, 0]'"))
    tab.wait_for_timeout(250)
    after = json.loads(tab.evaluate("document.body.dataset.pose || '[0, 0, 0]'"))
    return abs(after[0] - before[0]) + abs(after[1] - before[1]) > 0.02


@pytest.mark.slow
def test_a_person_who_is_not_there_stands(serve_live, visit, until):
    """Blurred, hidden, unplugged, stalled, closed: zero in 0.3 s, standstill in 1.5 s, an event."""
    links, folder, server = serve_live(PROTOCOL, "--no-report")
    tab = visit(links["participant"], before=PRETEND)
    for name in ("check-continue", "instructions-continue", "lap-start"):
        tab.get_by_test_id(name).click(timeout=60_000)
    tab.get_by_test_id("driving").wait_for(timeout=60_000)

    def drives():
        tab.keyboard.up("ArrowUp")
        tab.keyboard.down("ArrowUp")
        until(lambda: moves(tab))

    def stands():
        tab.wait_for_timeout(2000)
        assert not moves(tab)
        tab.keyboard.up("ArrowUp")

    for leave, come_back in ((BLUR, FOCUS), (HIDE, SHOW)):
        drives()
        tab.evaluate(leave)
        stands()
        tab.evaluate(come_back)
    tab.evaluate(PLUG)
    until(lambda: moves(tab))
    tab.evaluate(UNPLUG)
    stands()
    drives()
    tab.context.set_offline(True)
    tab.wait_for_timeout(1200)
    tab.context.set_offline(False)
    tab.keyboard.up("ArrowUp")
    person = tab.evaluate("JSON.stringify(sessionStorage)")
    drives()
    tab.close()

    again = visit(links["participant"], before=f"Object.assign(sessionStorage, {person});")
    again.get_by_test_id("driving").wait_for(timeout=60_000)
    until(lambda: not moves(again))
    again.get_by_test_id("comfortable").click(timeout=60_000)
    again.get_by_test_id("lap-start").click(timeout=60_000)
    assert server.wait(60) == 0

    session = folder / "sessions" / "P0001"
    events = pq.read_table(session / "event_rows.parquet").to_pandas()
    steps = pq.read_table(session / "steps-0.parquet").to_pandas()
    left = events[events["event"] == "page left"]
    pad = events[(events["event"] == "device") & (events["note"] == "gamepad to keyboard")]
    gone = events[(events["event"] == "disconnected") & events["step"].notna()]
    assert len(left) == 2
    assert len(pad) == 1
    assert len(gone) >= 1
    for step in [*left["step"], *pad["step"], *gone["step"]]:
        after = steps.iloc[int(step) :]
        assert (after["intent_v"].iloc[3:12] == 0).all()
        assert (after["result_v"].iloc[15:17].abs() < 0.01).all()
