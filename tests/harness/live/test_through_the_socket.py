"""What goes through the web socket leaves the record that it leaves without it."""

import json
import math

import pyarrow.parquet as pq
import pytest

from harness.running.sessions import world_of
from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from participants.live.driver import command_of
from participants.live.seat import Input
from protocols.load import resolve_study
from protocols.record.check import check_study

LIMITED = {"limitation": {"right_turn_rad_s": 0.15}}
PROTOCOL = {
    "schema": 1,
    "name": "through the socket",
    "title": "Two laps of a program that drives through the network",
    "cohort": {"participants": 1, "driver": {"use": "live"}},
    "conditions": {
        "shown": {**LIMITED, "assistant": "demonstrator", "training": True},
        "helped": {**LIMITED, "assistant": "model"},
    },
    "laps": [
        {"condition": "shown", "time_limit_s": 14},
        {"condition": "helped", "time_limit_s": 6},
    ],
}


def stick(t, pose):
    """Return where a program that turns to and fro holds the stick: a function of what it sees."""
    return 0.6 + 0.3 * math.sin(t), max(-1.0, min(1.0, -0.4 - 0.8 * math.sin(pose[2] + t)))


class Without:
    """The same program, in the chair itself."""

    kind = "live"

    def start_lap(self, lap, rng):
        pass

    def act(self, sight):
        forward, left = stick(sight.t, sight.pose)
        return command_of(Input(forward, left))


def drive(served):
    """Drive the whole session as a browser would, in simulated time."""
    browser = served.open("participant")
    while True:
        message = json.loads(browser.recv(timeout=60))
        if message["type"] == "page":
            assert message["kind"] in {"check", "instructions", "ready"}
            answer = {"type": "answer", "request": message["request"], "entered": {}}
            browser.send(json.dumps(answer))
        elif message["type"] == "ping":
            browser.send(json.dumps({"type": "pong", "id": message["id"]}))
        elif message["type"] == "picture":
            forward, left = stick(message["t"], message["pose"])
            browser.send(
                json.dumps({"type": "input", "n": message["n"], "sent": 0, "f": forward, "l": left})
            )
        elif message["type"] == "bye":
            browser.close()
            return


def test_the_step_table_is_the_same_byte_for_byte(serve):
    """A program sent through the web socket with a virtual clock changes nothing."""
    served = serve(PROTOCOL, lockstep=True)
    drive(served)
    served.wait(lambda: all(visit.over for visit in served.study.visits.values()))
    folder = served.study.folder
    assert check_study(folder) == ()
    run = served.study.run
    simulated = run.study.protocol.cohort.model_copy(
        update={"driver": run.study.protocol.cohort.driver.model_copy(update={"use": "human"})}
    )
    plain = StudyRun(
        type(run.study)(
            run.study.protocol.model_copy(update={"cohort": simulated}), run.study.course,
            run.study.instruments,
        ),
        run.seed,
    )  # fmt: skip
    parts = make_parts(plain, 1)
    lap = type(parts.lap)(Without(), parts.lap.demonstrator, parts.lap.model)
    record = Session(
        plain, 1, world_of(plain), type(parts)(parts.person, lap, parts.respondent, parts.reader)
    ).run()
    for without in record.laps:
        through = pq.read_table(folder / "sessions" / "P0001" / f"steps-{without.row.lap}.parquet")
        link = [
            name for name in through.column_names if name.startswith(("driver_", "demonstrator_"))
        ]
        assert through.drop_columns(link).equals(without.steps.drop_columns(link))
        assert through["driver_device"].null_count == 0
    assert (folder / "sessions" / "P0001" / "model.npz").read_bytes() == record.model


@pytest.fixture(autouse=True)
def _no_warnings_from_servers(recwarn):
    return


def test_the_protocol_is_known():
    """Living parts are names of any protocol; without browsers they are refused in one line."""
    assert resolve_study("four-lap").protocol.live.clutch == "hold"
