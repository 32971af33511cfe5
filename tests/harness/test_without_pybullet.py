"""PyBullet loads only where a world in PyBullet is made."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]

EVERYTHING = """
import importlib, pkgutil, sys
sys.modules["pybullet"] = None  # importing it raises
here = {"harness.world.bullet", "harness.world.bullet_caster", "harness.world.bullet_world"}
optional = {"sklearn", "distributed"}
for name in ("lad", "protocols", "participants", "harness", "analysis"):
    package = importlib.import_module(name)
    for module in pkgutil.walk_packages(package.__path__, f"{name}."):
        if module.name in here or module.name.endswith("__main__"):
            continue
        importlib.import_module(module.name)
print("imported")
"""

A_SESSION = """
import sys
sys.modules["pybullet"] = None
sys.path.insert(0, {folder!r})
from conftest import ToyWorld, EVERY_STAGE
import json, pathlib, tempfile
from harness.session.parts import make_parts
from harness.session.session import Session
from harness.session.study_run import StudyRun
from protocols.load import load_course, resolve_study
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder, "p.yaml")
    path.write_text(json.dumps(EVERY_STAGE))
    run = StudyRun(resolve_study(str(path)), 5)
world = ToyWorld(load_course("lab-office"))
record = Session(run, 1, world, make_parts(run, 1)).run()
print(len(record.laps), sum(len(lap.steps) for lap in record.laps))
"""


def printed(code):
    """Return what a fresh interpreter prints, run from the folder of the packages."""
    done = subprocess.run(  # noqa: S603  # our own interpreter and code
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout.strip()


def test_everything_else_imports_where_pybullet_cannot():
    """Only the three files of the world in PyBullet need it."""
    assert printed(EVERYTHING) == "imported"


def test_a_session_runs_in_a_toy_world_without_pybullet():
    """Driver, demonstrator, model, stages and record need a world, not a physics engine."""
    folder = str(Path(__file__).parent / "session")
    assert printed(A_SESSION.format(folder=folder)) == "3 150"
