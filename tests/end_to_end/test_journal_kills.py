"""Kill a session in any tick: replaying its journal and going on ends with the same bytes."""

import json
import subprocess
import sys

import numpy as np
import pytest

PROTOCOL = {
    "schema": 1,
    "name": "kills",
    "title": "A lap of each kind, cut short",
    "cohort": {"driver": {"use": "human"}},
    "conditions": {
        "alone": {"limitation": {"right_turn_rad_s": 0.15}},
        "shown": {
            "limitation": {"right_turn_rad_s": 0.15},
            "assistant": "demonstrator",
            "training": True,
        },
        "helped": {"limitation": {"right_turn_rad_s": 0.15}, "assistant": "model"},
    },
    "consent": {"text": "Do you agree?", "version": "1"},
    "laps": [
        {"condition": "alone", "time_limit_s": 3},
        {
            "condition": "shown",
            "time_limit_s": 14,
            "survey": [{"instrument": "driving-assistance"}],
        },
        {"condition": "helped", "time_limit_s": 5},
    ],
}
TICKS = 220

SCRIPT = """
import os, pickle, signal, sys
from pathlib import Path
from harness.running.sessions import world_of
from harness.session.journal import FileJournal
from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from protocols.load import resolve_study
from protocols.record.journal import journal_header
from protocols.record.session import encode

run = StudyRun(resolve_study(sys.argv[1]), 11)
folder, kills = Path(sys.argv[2]), [int(tick) for tick in sys.argv[3].split(",")]

class Dies(FileJournal):
    at = None
    def tick(self, *given):
        super().tick(*given)
        if self.at is not None and not self.left:
            self.at -= 1
            if self.at < 0:
                os.kill(os.getpid(), signal.SIGKILL)

def session(path, at=None):
    journal = Dies(path, journal_header(run.study, run.seed, "P0001"))
    journal.at = at
    record = Session(run, 1, world_of(run), make_parts(run, 1), journal=journal).run()
    journal.close()
    return encode(record)

undisturbed = session(folder / "undisturbed.jsonl")
assert sum(b'{"tick"' in line for line in (folder / "undisturbed.jsonl").open("rb")) == %d
world_of.__globals__["_reused_world"].cache_clear()
for tick in kills:
    path = folder / f"{tick}.jsonl"
    child = os.fork()
    if child == 0:
        session(path, at=tick)
        os._exit(1)
    _, status = os.waitpid(child, 0)
    assert os.WTERMSIG(status) == signal.SIGKILL, status
    with path.open("ab") as torn:
        torn.write(b'{"tick":{"u":[0.1')
    assert session(path) == undisturbed, tick
    assert path.read_bytes() == (folder / "undisturbed.jsonl").read_bytes(), tick
print(len(kills), "killed and the same")
"""


def kill_at(folder, ticks):
    """Kill a session in each of these ticks, and compare what it ends with."""
    protocol = folder / "kills.yaml"
    protocol.write_text(json.dumps(PROTOCOL))
    done = subprocess.run(  # noqa: S603  # our own interpreter and code
        [sys.executable, "-c", SCRIPT % TICKS, protocol, folder, ",".join(map(str, ticks))],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    return done.stdout.strip()


def test_killed_in_three_ticks(tmp_path):
    """The first, the last and one in the training lap."""
    assert kill_at(tmp_path, (0, 100, TICKS - 1)) == "3 killed and the same"


@pytest.mark.slow
def test_killed_in_twenty_five_random_ticks(tmp_path):
    """Wherever a session is killed with -9, nothing that was applied is lost."""
    ticks = np.random.default_rng(25).choice(TICKS, size=25, replace=False)
    assert kill_at(tmp_path, sorted(map(int, ticks))) == "25 killed and the same"
