"""How punctual live sessions are on this machine, and how long a key takes to the picture.

    python bench/live.py --sessions 1 5 20 --seconds 20 --presses 40

Serves sessions on loopback, each with a program as its participant that sends its stick 50 times a
second, as the page does, and prints the lateness of steps (p50, p99, largest) and the time from a
press, from standstill, to the first picture on which the chair has turned by ``SEEN_RAD``. The
participants run in a process of their own, as browsers do.

Then a real Chromium (Playwright) drives one session by its keys, with plan and first-person view:
from the key's event to the frame that is drawn with the turn, ramp of the key, waiting for the
step, the chair's acceleration and drawing included. ``--presses 0`` leaves that out.

The load average before each row says how busy the machine was with other work: only a quiet one
(below 0.3) says something about the program.
"""

import argparse
import asyncio
import contextlib
import json
import math
import multiprocessing
import os
import shutil
import socket
import tempfile
import threading
import time
from collections.abc import Iterator
from multiprocessing import Queue
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
from websockets.sync.client import connect
from websockets.typing import Origin

from harness.live.serve import web_server
from harness.live.study import LiveStudy
from harness.session.study_run import StudyRun
from protocols.load import resolve_study

EVERY_S = 0.02
REST_S, PRESSED_S = 1.537, 0.5
"""How long the chair stands before a press, and how long that is: together no multiple of the
control step, so that presses fall everywhere in it."""
SEEN_RAD = 0.001
"""What turn counts as seen, as in key_to_frame.js."""
STEP_MS = 100.0
HERE = Path(__file__).parent
FORKSERVER = multiprocessing.get_context("forkserver")


def protocol(sessions: int, seconds: float, view: str = "first-person") -> dict[str, object]:
    """Return a study of one lap of so many seconds, with the model predicting in every step."""
    return {
        "schema": 1,
        "name": "punctual",
        "title": "How punctual",
        "cohort": {"participants": sessions, "driver": {"use": "live"}, "respondent": None},
        "conditions": {"free": {}},
        "laps": [{"condition": "free", "time_limit_s": seconds}],
        "live": {"view": view},
    }


@contextlib.contextmanager
def serving(data: dict[str, object], sessions: int) -> Iterator[tuple[LiveStudy, int, str]]:
    """Serve a study on loopback; gives it, the port and the participants' token."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "punctual.yaml")
        path.write_text(json.dumps(data))
        run = StudyRun(resolve_study(str(path)), 0)
        study = LiveStudy(run, Path(folder, "study"), seats=sessions)
        listener = socket.create_server(("127.0.0.1", 0))
        port = listener.getsockname()[1]
        host = f"127.0.0.1:{port}"
        server = web_server(study, frozenset({host}), frozenset({f"http://{host}"}))
        thread = threading.Thread(target=lambda: asyncio.run(server.serve(sockets=[listener])))
        thread.start()
        try:
            yield study, port, study.tokens.issue("participant")
        finally:
            for visit in study.visits.values():
                visit.end()
                visit.join(60)
            server.should_exit = True
            thread.join()


def drive_all(port: int, token: str, sessions: int, told: "Queue[list[float]]") -> None:
    """Drive so many sessions to their ends, and tell how long the chair took to answer, s."""
    answers: list[float] = []
    people = [threading.Thread(target=drive, args=(port, token, answers)) for _ in range(sessions)]
    for person in people:
        person.start()
    for person in people:
        person.join()
    told.put(answers)


def drive(port: int, token: str, answers: list[float]) -> None:
    """Drive one session to its end: rest, press to one side, and note when the chair answers."""
    origin = Origin(f"http://127.0.0.1:{port}")
    with connect(f"ws://127.0.0.1:{port}/ws", origin=origin, max_size=2**20) as browser:
        browser.send(json.dumps({"type": "hello", "token": token}))
        n, due, began, presses = 0, time.monotonic(), math.inf, 0
        pressed_at, stood, heading = 0.0, math.nan, math.nan
        while True:
            try:
                message = json.loads(browser.recv(timeout=max(due - time.monotonic(), 0.001)))
            except TimeoutError:
                message = {"type": "none"}
            if message["type"] == "page":
                reply = {"type": "answer", "request": message["request"], "entered": {}}
                browser.send(json.dumps(reply))
                began = time.monotonic() if message["kind"] == "ready" else math.inf
            elif message["type"] == "ping":
                browser.send(json.dumps({"type": "pong", "id": message["id"]}))
            elif message["type"] == "bye":
                return
            elif message["type"] == "picture":
                heading = message["pose"][2]
                if abs(heading - stood) >= SEEN_RAD:
                    answers.append(time.monotonic() - pressed_at)
                    stood = math.nan
            now = time.monotonic()
            if now < max(due, began):
                continue
            due, n = due + EVERY_S, n + 1
            cycle, phase = divmod(now - began, REST_S + PRESSED_S)
            pressed = phase > REST_S
            if pressed and cycle >= presses:
                presses, pressed_at, stood = int(cycle) + 1, now, heading
            left = (0.6 if presses % 2 else -0.6) if pressed else 0.0
            stick = {"type": "input", "n": n, "sent": 1000 * now, "f": 0.0, "l": left}
            browser.send(json.dumps(stick))


def by_programs(sessions: int, seconds: float) -> tuple[np.ndarray, list[float]]:
    """Return every step's lateness in s, and the answers' times in s."""
    with serving(protocol(sessions, seconds), sessions) as (study, port, token):
        told: Queue[list[float]] = FORKSERVER.Queue()
        people = FORKSERVER.Process(target=drive_all, args=(port, token, sessions, told))
        people.start()
        answers = told.get()
        people.join()
        for visit in study.visits.values():
            visit.join(60)
        late = [
            pq.read_table(steps)["late_s"].to_numpy()[1:]
            for steps in study.folder.glob("sessions/*/steps-0.parquet")
        ]
        return np.concatenate(late), answers


def by_browser(view: str, presses: int) -> tuple[list[float], float]:
    """Return how long each of so many presses took until its turn was drawn, s, and frames/s."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415  # optional

    lap = protocol(1, 10 + presses * (REST_S + PRESSED_S), view)
    path = shutil.which("chromium") or shutil.which("google-chrome")
    with serving(lap, 1) as (_, port, token), sync_playwright() as play:
        chromium = play.chromium.launch(executable_path=path, args=["--no-sandbox"])
        tab = chromium.new_page(viewport={"width": 1280, "height": 800})
        apart = "true" if view == "first-person" else "false"
        tab.add_init_script(f"const apart = {apart};" + (HERE / "key_to_frame.js").read_text())
        tab.goto(f"http://127.0.0.1:{port}/p/{token}")
        for button in ("check-continue", "instructions-continue", "lap-start"):
            tab.get_by_test_id(button).click(timeout=60_000)
        tab.wait_for_selector("[data-pose]", timeout=60_000)
        tab.wait_for_selector("[data-drawn]", timeout=60_000)
        begun, drawn = time.monotonic(), int(tab.evaluate("document.body.dataset.drawn"))
        for press in range(presses):
            time.sleep(REST_S)
            key = "ArrowLeft" if press % 2 else "ArrowRight"
            tab.keyboard.down(key)
            time.sleep(PRESSED_S)
            tab.keyboard.up(key)
        took: list[float] = json.loads(tab.evaluate("document.body.dataset.took"))
        drawn = int(tab.evaluate("document.body.dataset.drawn")) - drawn
        rate = drawn / (time.monotonic() - begun)
        chromium.close()
        return took, rate


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sessions", type=int, nargs="*", default=[1, 5, 20])
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--presses", type=int, default=40)
    options = parser.parse_args()
    print("| sessions | load before | late p50 ms | p99 | max | press to picture p50, p90 ms | "
          "of a step |\n|---:|---:|---:|---:|---:|---:|---:|")  # fmt: skip
    for sessions in options.sessions:
        load = os.getloadavg()[0]
        late, answers = by_programs(sessions, options.seconds)
        p50, p99, most = (1000 * np.quantile(late, q) for q in (0.5, 0.99, 1.0))
        late_ms = f"{p50:.2f} | {p99:.2f} | {most:.1f}"
        print(f"| {sessions} | {load:.1f} | {late_ms} | {_quantiles(answers)} |", flush=True)
    if options.presses:
        print("\n| view | load before | frames a second | presses | key to frame p50, p90 ms | "
              "of a step |\n|---|---:|---:|---:|---:|---:|")  # fmt: skip
    for view in ("plan", "first-person") if options.presses else ():
        load = os.getloadavg()[0]
        took, rate = by_browser(view, options.presses)
        print(
            f"| {view} | {load:.1f} | {rate:.0f} | {len(took)} | {_quantiles(took)} |", flush=True
        )


def _quantiles(seconds: list[float]) -> str:
    p50, p90 = 1000 * np.quantile(seconds, [0.5, 0.9])
    return f"{p50:.0f}, {p90:.0f} | {p50 / STEP_MS:.2f}"


if __name__ == "__main__":
    main()
