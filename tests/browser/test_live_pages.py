"""The pages of a live study in a real browser: by keyboard alone, at every width, as declared."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from protocols.course.centreline import Centreline
from protocols.load import load_course

WIDTHS = {"desktop": (1280, 800), "tablet": (820, 1180), "phone": (390, 844)}
PICTURES = os.environ.get("LIVE_PICTURES")
"""Where the pictures are put that a person looks at; nowhere by default."""

COURSE = load_course("lab-office")

QUESTION = {"points": 5, "anchors": ["strongly disagree", "disagree", "neutral", "agree",
            "strongly agree"], "answer": "point", "lowest": None, "highest": None, "step": None,
            "ends": None}  # fmt: skip
QUESTIONS = [
    {**QUESTION, "instrument": "driving", "item": "Q1", "text": "It was easy."},
    {**QUESTION, "instrument": "driving", "item": "Q2", "text": "It was frustrating."},
    {**QUESTION, "instrument": "load", "item": "mental", "text": "How demanding was it?",
     "answer": "number", "lowest": 0, "highest": 100, "step": 5, "ends": ["low", "high"]},
    {**QUESTION, "instrument": "load", "item": "minutes", "text": "How many minutes did it take?",
     "answer": "number", "lowest": 0, "highest": 600},
    {**QUESTION, "instrument": "load", "item": "words", "text": "Anything else?",
     "answer": "text"},
]  # fmt: skip


def looked_at(stage, name, again=lambda: None):
    """See that nothing has to be scrolled sideways at any width; keep pictures where asked."""
    for device, (width, height) in WIDTHS.items():
        stage.tab.set_viewport_size({"width": width, "height": height})
        again()
        stage.tab.wait_for_timeout(400 if PICTURES else 60)
        wide = stage.tab.evaluate("document.documentElement.scrollWidth - innerWidth")
        assert wide <= 1, f"{name} on a {device} is {wide} pixels too wide"
        if PICTURES:
            stage.tab.screenshot(path=str(Path(PICTURES) / f"{name}-{device}.png"))


def press(tab, *keys):
    """Press keys, one after the other."""
    for key in keys:
        tab.keyboard.press(key)


def focused(tab):
    """Return the data-testid of what has the focus."""
    return tab.evaluate("document.activeElement.dataset.testid || document.activeElement.tagName")


def test_a_questionnaire_by_keyboard_alone(opened):
    """Tab, arrows and Enter answer it in reading order; what is left out stays missing."""
    stage = opened("participant")
    stage.page("questions", questions=QUESTIONS)
    stage.wait("questions-submit")
    assert focused(stage.tab) == "H1"
    looked_at(stage, "questionnaire")
    press(stage.tab, "Tab", "ArrowDown")
    assert focused(stage.tab) == "answer-Q1-2"
    press(stage.tab, "Tab", "Tab")
    assert focused(stage.tab) == "questions-submit"
    press(stage.tab, "Enter")
    stage.wait("answer-mental-0")
    assert focused(stage.tab) == "H1"
    looked_at(stage, "questionnaire-load")
    press(stage.tab, "Tab", "Tab")
    stage.tab.keyboard.type("700")
    press(stage.tab, "Enter")
    assert focused(stage.tab) == "answer-minutes"
    assert stage.tab.get_by_role("alert").inner_text() == "One question needs your attention."
    stage.tab.keyboard.press("Control+A")
    stage.tab.keyboard.type("12")
    press(stage.tab, "Tab")
    stage.tab.keyboard.type("no")
    press(stage.tab, "Tab", "Enter")
    stage.until(stage.answers)
    entered = stage.answers()[0]
    times = {name: entered.pop(name) for name in list(entered) if name.endswith("#s")}
    assert entered == {"driving.Q1": 2, "driving.Q2": None, "load.mental": None,
                       "load.minutes": 12, "load.words": "no"}  # fmt: skip
    assert set(times) == {"driving.Q1#s", "load.minutes#s", "load.words#s"}
    assert all(0 < seconds < 600 for seconds in times.values())


def test_questions_have_names_for_a_screen_reader(opened):
    """Each scale is a named group of named choices, each field has its label."""
    stage = opened("participant")
    stage.page("questions", questions=QUESTIONS)
    stage.wait("questions-submit")
    group = stage.tab.get_by_role("group", name="It was easy.")
    assert group.get_by_role("radio", name="strongly agree").count() == 1
    stage.tab.get_by_test_id("questions-submit").click()
    stage.wait("answer-words")
    assert stage.tab.get_by_role("textbox", name="Anything else?").count() == 1
    assert stage.tab.get_by_role("group", name="How demanding was it? From low to high.").count()


def test_one_item_a_page_with_every_answer_required(opened):
    """As declared: each page has one item, and is left only with an answer."""
    stage = opened("participant", questions={"page": "item", "required": True})
    stage.page("questions", questions=QUESTIONS[:2])
    submit = stage.wait("questions-submit")
    assert stage.tab.get_by_role("group").count() == 1
    submit.click()
    assert stage.tab.get_by_test_id("questions-problem").is_visible()
    assert stage.tab.locator("[aria-invalid=true]").count() == 5
    stage.tab.get_by_test_id("answer-Q1-4").check()
    submit.click()
    stage.wait("answer-Q2-1").check()
    stage.tab.get_by_test_id("questions-submit").click()
    stage.until(stage.answers)
    entered = stage.answers()[0]
    assert (entered["driving.Q1"], entered["driving.Q2"]) == (4, 1)


def test_answers_outlive_a_reload(opened):
    """What was entered on the page is there again; other questions, and other pages, are not."""
    stage = opened("participant", questions={"page": "item"})

    def show(request):
        stage.send("page", request=request, kind="questions", questions=QUESTIONS[:2])

    show(7)
    stage.wait("answer-Q1-4").check()
    stage.tab.get_by_test_id("questions-submit").click()
    stage.wait("answer-Q2-1").check()
    stage.tab.reload()
    stage.until(lambda: len(stage.said("hello")) == 2)
    show(7)
    assert stage.wait("answer-Q2-1").is_checked()
    stage.tab.get_by_test_id("questions-submit").click()
    stage.until(stage.answers)
    entered = stage.answers()[0]
    assert (entered["driving.Q1"], entered["driving.Q2"]) == (4, 1)
    assert entered["driving.Q2#s"] > 0
    show(7)  # the answer did not arrive
    stage.until(lambda: len(stage.answers()) == 2)
    assert stage.answers()[1] == entered
    for request in (8, 9):
        show(request)
        assert not stage.wait("answer-Q1-4").is_checked()
        stage.tab.get_by_test_id("answer-Q1-4").check()


def test_pages_before_the_first_lap(opened):
    """Machine check, consent, form, instructions with a try of the keys: by keyboard alone."""
    stage = opened("participant", machine_check={"min_frame_rate": 240, "rule": "flag"})
    stage.page("check")
    stage.until(lambda: stage.wait("check-continue").is_enabled())
    text = stage.tab.inner_text("main")
    assert "Round trip to the server: 12 ms" in text
    assert "at least 240 are needed" in text
    assert "You can take part; it is noted." in text
    looked_at(stage, "check")
    press(stage.tab, "Tab", "Enter")
    stage.until(stage.answers)
    assert {"frame_rate", "webgl", "gamepad", "view"} == set(stage.answers()[0])
    stage.page("consent", text="# Taking part\n\nYou *drive*.\n\n- You can\n  stop.")
    stage.wait("consent-agree")
    assert stage.tab.get_by_role("listitem").inner_text() == "You can stop."
    looked_at(stage, "consent")
    press(stage.tab, "Tab", "Enter")
    stage.page("demographics", fields=["age_years", "gender"])
    stage.wait("demographics-submit")
    looked_at(stage, "form")
    press(stage.tab, "Tab", "3", "1", "Tab", "Tab", "Enter")
    stage.until(lambda: len(stage.answers()) == 3)
    assert stage.answers()[1:] == [{"agreed": 1}, {"age_years": 31, "gender": None}]
    stage.page("instructions")
    stage.wait("instructions-continue")
    for key in ("ArrowUp", "KeyS", "ArrowLeft", "KeyD"):
        stage.tab.keyboard.down(key)
        stage.tab.wait_for_timeout(700)
        stage.tab.keyboard.up(key)
    stage.until(lambda: "keyboard works" in stage.wait("input-tested").inner_text())
    looked_at(stage, "instructions")
    assert stage.said("input") == []
    press(stage.tab, "Tab", "Enter")
    stage.until(lambda: len(stage.answers()) == 4)


def sharp_turns():
    """Return the chair's pose half way through each sharp turn."""
    line = Centreline(COURSE)
    arcs = np.arange(0.0, line.length, 0.05)
    sharp = [line.section(arc).kind == "sharp_right" for arc in arcs]
    begun = [i for i in range(1, len(arcs)) if sharp[i] and not sharp[i - 1]]
    return [line.point(float(arcs[i]) + 0.4) for i in begun]


def picture(pose, **more):
    """Return a participant's picture."""
    return {"n": 1, "t": 12.3, "pose": list(pose), "velocity": [0.4, -0.1], "gates": 1,
            "helped": False, "contact": False, "practice": False} | more  # fmt: skip


def watched(pose, **more):
    """Return a demonstrator's picture."""
    fan = [-2.09, 2.09, 0.45]
    return {"n": 1, "t": 12.3, "pose": list(pose), "velocity": [0.4, -0.1], "gates": 1,
            "contact": False, "driving": False, "shadow": False, "stick": [0.6, -0.15],
            "ranges": [2.0] * 180, "fan": fan} | more  # fmt: skip


def test_a_lap_as_its_participant_sees_it(opened):
    """First person at both sharp turns; somebody helps, without saying who; the stick is sent."""
    stage = opened("participant")
    for n, pose in enumerate(sharp_turns(), start=1):
        stage.send("picture", **picture(pose, helped=n == 2))
        stage.wait("driving")
        stage.until(lambda n=n: stage.wait("helped").is_visible() == (n == 2)) if n == 2 else None
        stage.until(lambda: int(stage.tab.evaluate("document.body.dataset.drawn || 0")) > 3)
        looked_at(stage, f"turn-{n}")
    assert n == 2
    assert "demonstrator" not in stage.tab.content().lower()
    stage.tab.keyboard.down("ArrowUp")
    stage.until(lambda: stage.said("input") and stage.said("input")[-1]["f"] == 1)
    stage.tab.get_by_test_id("withdraw").click()
    stage.until(lambda: stage.said("input")[-1]["f"] == 0)
    looked_at(stage, "stop")
    assert focused(stage.tab) == "TEXTAREA"
    stage.tab.get_by_test_id("withdraw-confirm").click()
    stage.until(lambda: stage.said("withdraw"))


@pytest.mark.parametrize(
    ("clutch", "held", "after"), [("hold", True, False), ("toggle", True, True)]
)
def test_a_clutch_is_held_or_switched_as_declared(opened, clutch, held, after):
    """Space takes over while it is held, or until it is pressed again; losing the focus lets go."""
    stage = opened("demonstrator", clutch=clutch)
    stage.send("lobby")
    stage.wait("lobby")
    looked_at(stage, "lobby") if clutch == "hold" else None
    stage.send("picture", **watched(sharp_turns()[0]))
    button = stage.wait("clutch")
    last = lambda: stage.said("input")[-1]["c"]  # noqa: E731
    stage.tab.keyboard.down("Space")
    stage.until(lambda: stage.said("input") and last() is held)
    stage.until(lambda: button.inner_text() == "You are driving")
    stage.tab.keyboard.up("Space")
    stage.until(lambda: last() is after)
    assert not stage.tab.get_by_test_id("p-help").is_visible()
    stage.tab.evaluate("dispatchEvent(new Event('blur'))")
    stage.until(lambda: last() is False)


def test_what_a_demonstrator_sees_is_as_declared(opened):
    """From above, or as the participant; p(h) where the server sends it; a shadow is told so."""
    for view in ("above", "participant"):
        stage = opened("demonstrator", demonstrator_view=view)
        stage.send("picture", **watched(sharp_turns()[0], p_help=0.83, driving=True))
        stage.wait("watching")
        stage.until(lambda stage=stage: stage.wait("p-help").inner_text() == "p(h) 0.83")
        looked_at(stage, f"demonstrator-{view}")
        stage.send("picture", **watched(sharp_turns()[1], shadow=True))
        role = stage.wait("demonstrator-role")
        stage.until(lambda role=role: "does not obey you" in role.inner_text())
        assert stage.wait("clutch").inner_text() == "I would help now"


def console_news():
    """Return what a console is sent of two sessions, one of them held."""
    line = Centreline(COURSE)
    arcs = np.arange(0.0, 17.0, 0.25)
    trail = [
        [*line.point(float(arc))[:2], ("driver", "demonstrator", "model")[i // 10 % 3], 0.4 * i,
         float(0.5 + 0.4 * np.sin(i / 6)), float(0.02 + 0.01 * np.cos(i / 9)), 0.001, 0.1]
        for i, arc in enumerate(arcs)
    ]  # fmt: skip
    event = {"lap": 1, "step": 40, "utc": "2026-01-01T10:11:12.123+00:00", "actor": "experimenter",
             "event": "pause", "note": "a question"}  # fmt: skip
    session = {
        "participant": "P0001", "state": "running", "stage": "lap", "page": None, "lap": 1,
        "condition": "human-assisted", "paused": ["experimenter"],
        "connected": {"participant": True, "demonstrator": True},
        "round_trip_s": {"participant": 0.021, "demonstrator": 0.034}, "late_s": 0.001,
        "events": [event], "t": trail[-1][3], "pose": list(line.point(17.0)),
        "velocity": [0.4, -0.1], "intent": [0.6, -0.2], "demonstrator_stick": [0.3, -0.4],
        "control": "demonstrator", "p_help": 0.83, "variance": 0.021, "input_age_s": 0.1,
        "clearance_m": 0.31,
    }  # fmt: skip
    waiting = {**session, "participant": "P0002", "stage": "consent", "page": "consent",
               "lap": None, "condition": None, "paused": []}  # fmt: skip
    del waiting["pose"]
    quota = [{"group": None, "order": "limited > human-assisted > model-assisted", "planned": 12,
              "finished": 3, "under_way": 2}]  # fmt: skip
    following = {"participant": "P0006", "group": None, "laps": ["practice", "limited"],
                 "free": False}  # fmt: skip
    return {"planned": 12, "finished": ["P0003"], "sessions": [session, waiting],
            "trails": {"P0001": trail, "P0002": []},
            "outlook": {"quota": quota, "next": following}}  # fmt: skip


def test_the_console_shows_and_orders(opened):
    """Every order goes out at once with its reason; what cannot be undone asks once more."""
    stage = opened("experimenter")
    news = json.loads(json.dumps(console_news(), default=float))
    tell = lambda: stage.send("console", **news)  # noqa: E731
    tell()
    card = stage.wait("session-P0001")
    assert "P0006" in stage.wait("next-participant").inner_text()
    assert "PAUSED by experimenter" in card.inner_text()
    looked_at(stage, "console", again=tell)
    note = card.get_by_test_id("note-text")
    for name in ("lap-begin", "lap-pause", "lap-resume", "lap-stop", "lap-repeat",
                 "emergency-stop", "stage-skip", "note-save"):  # fmt: skip
        note.fill(f"why {name}")
        card.get_by_test_id(name).click()
    for name in ("session-end", "session-withdraw"):
        card.get_by_test_id(name).click()
        card.get_by_test_id(name).click()
    stage.until(lambda: len(stage.said("order")) == 10)
    orders = [(order["do"], order["text"]) for order in stage.said("order")]
    assert orders == [
        ("start", "why lap-begin"), ("pause", "why lap-pause"), ("resume", "why lap-resume"),
        ("stop", "why lap-stop"), ("repeat", "why lap-repeat"),
        ("emergency", "why emergency-stop"), ("skip", "why stage-skip"),
        ("note", "why note-save"), ("end", ""), ("withdraw", ""),
    ]  # fmt: skip
    assert all(order["participant"] == "P0001" for order in stage.said("order"))


def test_the_end_is_told_as_it_was(opened):
    """A code and a link back for who went through; deletion confirmed to who stopped."""
    stage = opened("participant", withdrawal="purge")
    completion = {"code": "C-77", "url": "https://platform.example/done"}
    stage.send("bye", reason="finished", purged=False, completion=completion)
    assert stage.wait("completion-code").inner_text() == "C-77"
    assert stage.wait("completion-link").get_attribute("href") == completion["url"]
    stopped = opened("participant", withdrawal="purge")
    stopped.send("bye", reason="withdrew", purged=True, completion=None)
    stopped.wait("farewell-withdrew")
    assert "has been deleted" in stopped.tab.inner_text("main")
