"""Names and dotted paths become people; mistakes are told with what is allowed."""

import sys

import numpy as np
import pytest

from lad.command import Command
from participants.registry import (
    DEMONSTRATORS,
    DRIVERS,
    RESPONDENTS,
    make_demonstrator,
    make_driver,
    make_respondent,
)
from participants.setup import DemonstratorSetup, DriverSetup, RespondentSetup
from participants.sight import Onlooker
from participants.survey import Question
from protocols.files.errors import InputError

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
def elsewhere(tmp_path, monkeypatch):
    """Install somebody else's module with drivers, and one that cannot be imported."""
    (tmp_path / "their_drivers.py").write_text(MODULE)
    (tmp_path / "their_broken.py").write_text("raise RuntimeError('no joystick')\n")
    monkeypatch.syspath_prepend(tmp_path)
    yield
    sys.modules.pop("their_drivers", None)


@pytest.fixture
def setup(lab_office):
    """Return what a driver is made from."""
    options = {"commands": [[0.0, 0.5, 0.0]]}
    return DriverSetup(lab_office, np.random.default_rng(0), options=options)


def test_every_shipped_name_can_be_made(lab_office):
    """All drivers, demonstrators and respondents of the registry exist."""
    rng = np.random.default_rng(0)
    options = {"scripted": {"commands": [[0.0, 0.5, 0.0]]}}
    for name in DRIVERS:
        make_driver(name, DriverSetup(lab_office, rng, options=options.get(name, {})))
    for name in DEMONSTRATORS:
        who = make_demonstrator(name, DemonstratorSetup(lab_office, rng))
        assert isinstance(who, Onlooker)
    for name in RESPONDENTS:
        make_respondent(name, RespondentSetup((Question("driving-assistance", "Q1"),), rng))


@pytest.mark.usefixtures("elsewhere")
def test_a_dotted_path_makes_somebody_elses_driver(lab_office):
    """Nothing of ours is edited to add a driver, and it gets its options."""
    setup = DriverSetup(lab_office, np.random.default_rng(0), options={"speed": 0.1})
    driver = make_driver("their_drivers:straight", setup)
    assert driver.act(None) == Command(0.1, 0.0)


@pytest.mark.usefixtures("elsewhere")
@pytest.mark.parametrize(
    ("name", "message"),
    [
        (
            "humna",
            "no driver is called so; allowed: package.module:factory, human, autonomous, scripted",
        ),
        ("no_such_package:x", "cannot import 'no_such_package' .ModuleNotFoundError"),
        ("their_broken:x", "cannot import 'their_broken' .RuntimeError: no joystick"),
        ("their_drivers:absent", "'their_drivers' has no function 'absent'"),
        ("their_drivers:number", "'their_drivers' has no function 'number'"),
        ("their_drivers:nobody", "is no driver, it lacks start_lap, act"),
    ],
)
def test_a_name_that_makes_nobody_is_explained(setup, name, message):
    """Unknown names, failing imports and wrong factories: one line with what is allowed."""
    with pytest.raises(InputError, match=message) as error:
        make_driver(name, setup)
    assert "\n" not in str(error.value)
