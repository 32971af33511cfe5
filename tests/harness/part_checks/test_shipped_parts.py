"""Every part that ships does what a study will ask of it."""

from importlib import import_module
from pkgutil import iter_modules

import pytest

import lad.baselines
from harness.part_checks import CHECKS
from harness.world.bullet_world import BulletWorld
from participants.respondent import ordinal_respondent
from protocols.shipped_parts import (
    DEMONSTRATORS,
    DRIVERS,
    IMPAIRMENTS,
    LIVE,
    MODELS,
    RESPONDENTS,
)

LOG = {"commands": [[0.0, 0.5, 0.0], [6.0, 0.3, 0.2]]}
TAUGHT = "taught"
"""Loads a file that another study has written: there is nothing to check without one."""

PARTS = [
    *(("driver", name, LOG if name == "scripted" else {}) for name in DRIVERS if name != LIVE),
    *(("impairment", name, {}) for name in IMPAIRMENTS),
    *(("demonstrator", name, {}) for name in DEMONSTRATORS if name != LIVE),
    *(("respondent", name, {}) for name in RESPONDENTS if name != LIVE),
    *(("assistant", name, {}) for name in MODELS if name != TAUGHT),
]

OVERSHOOTS = "network-refitted"
"""Fitted on the few steps of a brief lap, its commands exceed the chair's tenfold. After a lap of
full length they do not, and it passes."""


def test_every_baseline_is_among_them():
    """A module of baselines with a factory is a shipped model."""
    found = iter_modules(lad.baselines.__path__)
    modules = [import_module(f"lad.baselines.{module.name}") for module in found]
    factories = {
        f"{module.__name__}:{name}"
        for module in modules
        for name in vars(module)
        if name.startswith("make") and vars(module)[name].__module__ == module.__name__
    }
    assert factories
    assert factories <= set(MODELS.values())


@pytest.mark.parametrize(
    ("role", "name", "options"), [part for part in PARTS if part[1] != OVERSHOOTS]
)
def test_a_shipped_part_passes(role, name, options, brief):
    """Nothing fails, and nothing is left unchecked."""
    report = CHECKS[role](name, options, brief)
    assert {result.state for result in report.results} == {"passed"}, str(report)


@pytest.mark.slow
@pytest.mark.parametrize(("role", "name", "options"), PARTS)
def test_a_shipped_part_passes_at_full_length(role, name, options):
    """With laps as long as people's own parts get them."""
    report = CHECKS[role](name, options)
    assert {result.state for result in report.results} == {"passed"}, str(report)


def test_the_bullet_world_passes():
    """So does the world, given as the class itself."""
    report = CHECKS["world"](BulletWorld)
    assert {result.state for result in report.results} == {"passed"}, str(report)


def test_a_function_without_a_name_is_not_checked_elsewhere():
    """A local factory is checked here; the other process is reported as not checked."""

    def local(setup):
        return ordinal_respondent(setup)

    report = CHECKS["respondent"](local)
    states = {result.check: result.state for result in report.results}
    assert states.pop("another process") == "not checked"
    assert set(states.values()) == {"passed"}
    assert report.passed
