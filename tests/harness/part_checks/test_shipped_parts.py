"""Every part that ships does what a study will ask of it."""

import pytest

from harness.part_checks import CHECKS
from harness.world.bullet_world import BulletWorld
from protocols.shipped_parts import DEMONSTRATORS, DRIVERS, IMPAIRMENTS, MODELS, RESPONDENTS

LOG = {"commands": [[0.0, 0.5, 0.0], [6.0, 0.3, 0.2]]}
BASELINES = [
    "lad.baselines.linear:make",
    "lad.baselines.memoryless:make",
    "lad.baselines.neighbours:make",
    "lad.baselines.network:make",
    "lad.baselines.network:make_refitted",
]
PARTS = [
    *(("driver", name, LOG if name == "scripted" else {}) for name in DRIVERS),
    *(("impairment", name, {}) for name in IMPAIRMENTS),
    *(("demonstrator", name, {}) for name in DEMONSTRATORS),
    *(("respondent", name, {}) for name in RESPONDENTS),
    *(("assistant", name, {}) for name in (*MODELS, *BASELINES)),
]


def test_every_baseline_is_among_them():
    """A module of baselines with a factory is named above."""
    from importlib import import_module
    from pkgutil import iter_modules

    import lad.baselines as package

    modules = [import_module(f"lad.baselines.{m.name}") for m in iter_modules(package.__path__)]
    factories = {
        f"{module.__name__}:{name}"
        for module in modules
        for name in vars(module)
        if name.startswith("make") and vars(module)[name].__module__ == module.__name__
    }
    assert factories == set(BASELINES)


@pytest.mark.parametrize(("role", "name", "options"), PARTS)
def test_a_shipped_part_passes(role, name, options):
    """Nothing fails, and nothing is left unchecked."""
    report = CHECKS[role](name, options)
    assert {result.state for result in report.results} == {"passed"}, str(report)


def test_the_bullet_world_passes():
    """So does the world, given as the class itself."""
    report = CHECKS["world"](BulletWorld)
    assert {result.state for result in report.results} == {"passed"}, str(report)


def test_a_function_without_a_name_is_not_checked_elsewhere():
    """A local factory is checked here; that it cannot be made elsewhere is said, and no failure."""
    from participants.respondent import ordinal_respondent

    report = CHECKS["respondent"](lambda setup: ordinal_respondent(setup))
    states = {result.check: result.state for result in report.results}
    assert states.pop("another process") == "not checked"
    assert set(states.values()) == {"passed"}
    assert report.passed
