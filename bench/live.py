"""How punctual live sessions are on this machine, and how long a key takes to the picture.

    python bench/live.py --sessions 1 5 20 --seconds 20

Serves sessions on loopback, each with a program as its participant that sends its stick 25 times a
second, and prints the lateness of steps (p50, p99, largest) and the time from a key, the change of
the stick, to the first picture that shows the chair's answer, as milliseconds and as a share of the
control step. The participants run in a process of their own, as browsers do. The browser draws a
picture with its next frame: add 8 ms in the middle, 17 ms at most, at 60 frames a second.

The load average before each row says how busy the machine was with other work: only a quiet one
(below 0.3) says something about the program.
"""

import argparse
import asyncio
import json
import multiprocessing
import os
import socket
import statistics
import tempfile
import threading
import time
from multiprocessing import Queue
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
from websockets.sync.client import connect

from harness.live.serve import web_server
from harness.live.study import LiveStudy
from harness.session.study_run import StudyRun
from protocols.load import resolve_study

EVERY_S = 0.04
FORKSERVER = multiprocessing.get_context("forkserver")


def protocol(sessions: int, seconds: float) -> dict[str, object]:
    """Return a study of one lap of so many seconds, with the model predicting in every step."""
    return {
        "schema": 1,
        "name": "punctual",
        "title": "How punctual",
        "cohort": {"participants": sessions, "driver": {"use": "live"}, "respondent": None},
        "conditions": {"free": {}},
        "laps": [{"condition": "free", "time_limit_s": seconds}],
    }


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
    """Drive one session to its end: stick to and fro, and note when the chair answers."""
    sent_at, pushed = 0.0, 0.0
    origin = f"http://127.0.0.1:{port}"
    with connect(f"ws://127.0.0.1:{port}/ws", origin=origin, max_size=2**20) as browser:
        browser.send(json.dumps({"type": "hello", "token": token}))
        n, due = 0, time.monotonic()
        driving = False
        while True:
            try:
                message = json.loads(browser.recv(timeout=max(due - time.monotonic(), 0.001)))
            except TimeoutError:
                message = {"type": "none"}
            if message["type"] == "page":
                reply = {"type": "answer", "request": message["request"], "entered": {}}
                browser.send(json.dumps(reply))
                driving = message["kind"] == "ready"
            elif message["type"] == "ping":
                browser.send(json.dumps({"type": "pong", "id": message["id"]}))
            elif message["type"] == "bye":
                return
            elif (
                message["type"] == "picture" and sent_at and message["velocity"][1] * pushed > 0.01
            ):
                answers.append(time.monotonic() - sent_at)
                sent_at = 0.0
            if driving and time.monotonic() >= due:
                due += EVERY_S
                n += 1
                if n % 50 == 1:  # every two seconds the stick goes to the other side
                    pushed = 1.0 if pushed <= 0 else -1.0
                    sent_at = time.monotonic()
                stick = {"type": "input", "n": n, "sent": 1000 * time.monotonic(), "f": 0.0}
                browser.send(json.dumps({**stick, "l": 0.6 * pushed}))


def measure(sessions: int, seconds: float) -> tuple[np.ndarray, list[float]]:
    """Return every step's lateness in s, and the answers' times in s."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "punctual.yaml")
        path.write_text(json.dumps(protocol(sessions, seconds)))
        run = StudyRun(resolve_study(str(path)), 0)
        study = LiveStudy(run, Path(folder, "study"), seats=sessions)
        listener = socket.create_server(("127.0.0.1", 0))
        port = listener.getsockname()[1]
        host = f"127.0.0.1:{port}"
        server = web_server(study, frozenset({host}), frozenset({f"http://{host}"}))
        serving = threading.Thread(target=lambda: asyncio.run(server.serve(sockets=[listener])))
        serving.start()
        told: Queue[list[float]] = FORKSERVER.Queue()
        token = study.tokens.issue("participant")
        people = FORKSERVER.Process(target=drive_all, args=(port, token, sessions, told))
        people.start()
        answers = told.get()
        people.join()
        for visit in study.visits.values():
            visit.join(60)
        server.should_exit = True
        serving.join()
        late = [
            pq.read_table(steps)["late_s"].to_numpy()[1:]
            for steps in Path(folder, "study", "sessions").glob("*/steps-0.parquet")
        ]
        return np.concatenate(late), answers


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sessions", type=int, nargs="+", default=[1, 5, 20])
    parser.add_argument("--seconds", type=float, default=20.0)
    options = parser.parse_args()
    print(
        "| sessions | load before | late p50 ms | p99 | max | key to picture p50 ms | of a step |"
    )
    print("|---:|---:|---:|---:|---:|---:|---:|")
    for sessions in options.sessions:
        load = os.getloadavg()[0]
        late, answers = measure(sessions, options.seconds)
        p50, p99, most = (1000 * np.quantile(late, q) for q in (0.5, 0.99, 1.0))
        middle = 1000 * statistics.median(answers) if answers else float("nan")
        late_ms = f"{p50:.2f} | {p99:.2f} | {most:.1f}"
        print(f"| {sessions} | {load:.1f} | {late_ms} | {middle:.0f} | {middle / 100:.2f} |")


if __name__ == "__main__":
    main()
