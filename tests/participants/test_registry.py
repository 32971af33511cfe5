"""Names become people; mistakes are told with what is allowed, and nothing else is run."""

import sys

import numpy as np
import pytest

from lad.command import Command
from participants.registry import (
    make_demonstrator,
    make_driver,
    make_respondent,
)
from participants.setup import DemonstratorSetup, DriverSetup, RespondentSetup
from participants.sight import Onlooker
from participants.survey import Question
from protocols.code_beside import PartBeside, code_digest
from protocols.files.errors import InputError
from protocols.load import load_course
from protocols.shipped_parts import (
    DEMONSTRATORS,
    DRIVERS,
    LIVE,
    MODELS,
    RESPONDENTS,
    shipped_factory,
)

MODULE = """
from lad.command import Command

class Straight:
    def __init__(self, setup):
        self.speed = setup.options.get("speed", 0.3)
    def start_lap(self, lap, rng):
        pass
    def act(self, sight):
        return Command(self.speed, 0.0)

def nobody(setup):
    return object()

straight = Straight
number = 3
"""


@pytest.fixture
def beside(tmp_path):
    """Return a function that gives the part of a module beside a protocol, trusted as it is."""
    (tmp_path / "their_drivers.py").write_text(MODULE)
    (tmp_path / "their_broken.py").write_text("raise RuntimeError('no joystick')\n")
    (tmp_path / "their_exit.py").write_text("raise SystemExit(0)\n")

    def part(use):
        module = tmp_path / f"{use.partition(':')[0]}.py"
        return [PartBeside("mine.yaml:3: driver.use", use, module, code_digest(module))]

    return part


@pytest.fixture
def setup(lab_office):
    """Return what a driver is made from."""
    options = {"commands": [[0.0, 0.5, 0.0]]}
    return DriverSetup(lab_office, np.random.default_rng(0), options=options)


def test_every_shipped_name_can_be_made(lab_office):
    """All drivers, demonstrators and respondents of the registry exist."""
    rng = np.random.default_rng(0)
    options = {"scripted": {"commands": [[0.0, 0.5, 0.0]]}}
    for name in set(DRIVERS) - {LIVE}:
        make_driver(name, DriverSetup(lab_office, rng, options=options.get(name, {})))
    for name in set(DEMONSTRATORS) - {LIVE}:
        who = make_demonstrator(name, DemonstratorSetup(lab_office, rng))
        assert isinstance(who, Onlooker)
    for name in set(RESPONDENTS) - {LIVE}:
        make_respondent(name, RespondentSetup((Question("driving-assistance", "Q1"),), rng))


def test_a_module_beside_the_protocol_makes_somebody_elses_driver(lab_office, beside):
    """Nothing of ours is edited to add a driver, and it gets its options."""
    setup = DriverSetup(lab_office, np.random.default_rng(0), options={"speed": 0.1})
    use = "their_drivers:straight"
    driver = make_driver(use, setup, beside(use))
    assert driver.act(None) == Command(0.1, 0.0)


@pytest.mark.parametrize(
    ("use", "message"),
    [
        ("their_broken:x", "cannot import .*their_broken.py .RuntimeError: no joystick"),
        ("their_exit:x", "cannot import .*their_exit.py .SystemExit: 0"),
        ("their_drivers:absent", "has no function 'absent'"),
        ("their_drivers:number", "has no function 'number'"),
        ("their_drivers:nobody", "is no driver, it lacks start_lap, act"),
    ],
)
def test_a_module_that_makes_nobody_is_explained(setup, beside, use, message):
    """Failing imports and wrong factories: one line."""
    with pytest.raises(InputError, match=message) as error:
        make_driver(use, setup, beside(use))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "use",
    ["humna", "subprocess:run", "os:path", "their_drivers:straight", "participants.driver:Driver"],
)
def test_nothing_else_can_be_named(setup, tmp_path, monkeypatch, use):
    """Neither the standard library, nor what is on the path, nor our own other functions."""
    (tmp_path / "their_drivers.py").write_text(MODULE)
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match=f"no driver is called '{use}'; allowed: ") as error:
        make_driver(use, setup)
    assert "\n" not in str(error.value)


def test_code_that_has_changed_is_not_run(setup, beside, tmp_path):
    """What a person trusted is a file's content, not its name."""
    use = "their_drivers:straight"
    trusted = beside(use)
    proof = tmp_path / "proof"
    changed = f"open({str(proof)!r}, 'w')\n{MODULE}"
    (tmp_path / "their_drivers.py").write_text(changed)
    with pytest.raises(InputError, match="is not what it was when it was trusted"):
        make_driver(use, setup, trusted)
    assert not proof.exists()


def test_what_a_module_imports_beside_it_belongs_to_it(setup, tmp_path):
    """It is found, its change is a change, and it cannot stand in for an installed package."""
    (tmp_path / "mine.py").write_text("import json, speeds\nfrom their import straight\n")
    (tmp_path / "their.py").write_text(MODULE)
    (tmp_path / "speeds.py").write_text("fast = 1\n")
    (tmp_path / "json.py").write_text("raise RuntimeError('not the real one')\n")
    (tmp_path / "unused.py").write_text("")
    use, module = "mine:straight", tmp_path / "mine.py"
    digest = code_digest(module)
    assert make_driver(use, setup, [PartBeside("", use, module, digest)])
    (tmp_path / "unused.py").write_text("other = 2\n")
    assert code_digest(module) == digest
    (tmp_path / "speeds.py").write_text("fast = 2\n")
    assert code_digest(module) != digest


def test_a_module_may_be_called_like_an_installed_one(setup, tmp_path):
    """The file beside the protocol is run, and the other module stays what it is."""
    import numpy  # noqa: ICN001  # by the name that the file has

    (tmp_path / "numpy.py").write_text(MODULE)
    use, module = "numpy:straight", tmp_path / "numpy.py"
    assert make_driver(use, setup, [PartBeside("", use, module, code_digest(module))])
    assert sys.modules["numpy"] is numpy


def test_models_keep_the_names_of_earlier_versions():
    """Recorded studies name our simpler models by the place of their factory."""
    for name, factory in MODELS.items():
        assert shipped_factory("model", name) == factory
    assert shipped_factory("model", "lad.baselines.network:make_refitted")
    assert shipped_factory("model", "lad.trained:load")
    assert shipped_factory("driver", "lad.trained:load") is None
    assert shipped_factory("model", "lad.model_file:read") is None


@pytest.mark.parametrize(
    ("make", "setup"),
    [
        (make_driver, DriverSetup(load_course("lab-office"), np.random.default_rng(0))),
        (make_demonstrator, DemonstratorSetup(load_course("lab-office"), np.random.default_rng(0))),
        (make_respondent, RespondentSetup((), np.random.default_rng(0))),
    ],
)
def test_a_living_person_needs_a_browser(make, setup):
    """A simulated study that names one is refused in a line that says what to run."""
    with pytest.raises(InputError, match="allowed: `lad-study live`"):
        make(LIVE, setup)
