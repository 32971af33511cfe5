"""A study of one short lap, and other people's drivers for it."""

from dataclasses import replace

import pytest

from harness.running.open_workers import warm_up_workers
from harness.session.seeds import generator
from harness.session.study_run import StudyRun
from protocols.load import resolve_study

BRIEF = """\
schema: 1
name: brief
title: One short lap
cohort: {{participants: {participants}, driver: {driver}}}
conditions:
  baseline: {{}}
laps:
  - {{condition: baseline, time_limit_s: 0.5}}
"""

DRIVERS = '''
import os, signal, warnings
from pathlib import Path
from lad.command import Command

class Straight:
    def __init__(self, setup):
        self.setup = setup
        self.unlucky = setup.rng.random() < 0.6
    def start_lap(self, lap, rng): pass
    def act(self, sight): return Command(0.2, 0.0)

def straight(setup): return Straight(setup)

class Moody(Straight):
    """Raises for about every other participant, as long as a file exists."""
    def act(self, sight):
        if self.unlucky and Path(self.setup.options["file"]).exists():
            raise RuntimeError("I am in no mood")
        return Command(0.2, 0.0)

def moody(setup): return Moody(setup)

class Warner(Straight):
    def act(self, sight):
        warnings.warn("it is getting late")
        return Command(0.2, 0.0)

def warner(setup): return Warner(setup)

class Deadly(Straight):
    """Kills the process for about every other participant."""
    def act(self, sight):
        if self.unlucky:
            os.kill(os.getpid(), signal.SIGKILL)
        return Command(0.2, 0.0)

def deadly(setup): return Deadly(setup)

def impossible(setup): raise ValueError("no such thing")
'''


@pytest.fixture
def ready():
    """Have worker processes forked from one that has imported what they need."""
    warm_up_workers()


@pytest.fixture
def unlucky():
    """Return the function that says for which participants the drivers below misbehave."""

    def numbers(run):
        planned = range(1, run.study.protocol.cohort.participants + 1)
        return [n for n in planned if generator(run.seed, n, "driver").random() < 0.6]

    return numbers


@pytest.fixture
def make_run(tmp_path):
    """Return a function that plans the study of one short lap."""
    (tmp_path / "some_drivers.py").write_text(DRIVERS)

    def make(participants=4, seed=0, driver="{use: 'some_drivers:straight'}"):
        path = tmp_path / "brief.yaml"
        path.write_text(BRIEF.format(participants=participants, driver=driver))
        return StudyRun(replace(resolve_study(str(path)), trusted=True), seed)

    return make
