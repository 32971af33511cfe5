"""Where a name in a protocol becomes somebody: driver, impairment, demonstrator, respondent.

A name is a shipped one, or a dotted path ``package.module:factory`` to a function that takes the
setup (see ``participants.setup``) and returns the driver, demonstrator or respondent; that of an
impairment returns a driver around the one it is given. Nothing has to be edited here to add one.
"""

from collections.abc import Mapping
from importlib import import_module
from typing import Any, cast

from participants.demonstrator import Demonstrator
from participants.driver import Driver
from participants.setup import DemonstratorSetup, DriverSetup, ImpairmentSetup, RespondentSetup
from participants.survey import Respondent
from protocols.errors import InputError

DRIVERS: Mapping[str, str] = {
    "human": "participants.human.driver:human_driver",
    "autonomous": "participants.autonomous:autonomous_driver",
    "scripted": "participants.scripted:scripted_driver",
}
IMPAIRMENTS: Mapping[str, str] = {
    "tremor": "participants.impairments.tremor:tremor",
    "weakness": "participants.impairments.weakness:weakness",
}
DEMONSTRATORS: Mapping[str, str] = {"attentive": "participants.attentive:attentive_demonstrator"}
RESPONDENTS: Mapping[str, str] = {"ordinal": "participants.respondent:ordinal_respondent"}


def make_driver(name: str, setup: DriverSetup) -> Driver:
    """Return the driver a protocol names.

    Raises
    ------
    InputError
        When there is no such driver, or it cannot be made with these options.
    """
    return cast("Driver", _make("driver", DRIVERS, ("start_lap", "act"), name, setup))


def make_impaired(name: str, setup: ImpairmentSetup) -> Driver:
    """Return a driver with the impairment a protocol names.

    Raises
    ------
    InputError
        When there is no such impairment, or it cannot be made with these options.
    """
    return cast("Driver", _make("impairment", IMPAIRMENTS, ("start_lap", "act"), name, setup))


def make_demonstrator(name: str, setup: DemonstratorSetup) -> Demonstrator:
    """Return the demonstrator a protocol names; the same one serves as a shadow.

    Raises
    ------
    InputError
        When there is no such demonstrator, or it cannot be made with these options.
    """
    methods = ("start_lap", "look", "assist")
    return cast("Demonstrator", _make("demonstrator", DEMONSTRATORS, methods, name, setup))


def make_respondent(name: str, setup: RespondentSetup) -> Respondent:
    """Return the respondent a protocol names.

    Raises
    ------
    InputError
        When there is no such respondent, or it cannot answer one of the questions.
    """
    return cast("Respondent", _make("respondent", RESPONDENTS, ("answer",), name, setup))


def _make(
    role: str, shipped: Mapping[str, str], methods: tuple[str, ...], name: str, setup: object
) -> Any:
    factory = _factory(role, shipped, name)
    somebody = factory(setup)
    missing = [method for method in methods if not callable(getattr(somebody, method, None))]
    if missing:
        raise InputError(
            f"{role} {name!r}: what it makes is no {role}, it lacks {', '.join(missing)}"
        )
    return somebody


def _factory(role: str, shipped: Mapping[str, str], name: str) -> Any:
    allowed = f"allowed: {', '.join(sorted(shipped))}, or a dotted path package.module:factory"
    module_name, colon, attribute = shipped.get(name, name).partition(":")
    if not colon:
        raise InputError(f"{role} {name!r}: there is none of this name; {allowed}")
    try:
        module = import_module(module_name)
    except Exception as error:  # somebody's module may fail in any way
        reason = f"{type(error).__name__}: {error}".splitlines()[0]
        raise InputError(
            f"{role} {name!r}: cannot import {module_name!r} ({reason}); {allowed}"
        ) from error
    factory = getattr(module, attribute, None)
    if not callable(factory):
        raise InputError(
            f"{role} {name!r}: {module_name!r} has no function {attribute!r}; {allowed}"
        )
    return factory
