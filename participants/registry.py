"""Where a name in a protocol becomes a driver, an impairment, a demonstrator or a respondent.

A name is a shipped one (``protocols.shipped_parts``), or a dotted path ``package.module:factory``
to a function that takes the setup (see ``participants.setup``) and returns the part; that of an
impairment returns a driver around the one it is given. Nothing has to be edited here to add one.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast

from participants.demonstrator import Demonstrator
from participants.driver import Driver, kind_of
from participants.part_loader import load_factory, refuse_missing_methods
from participants.setup import DemonstratorSetup, DriverSetup, ImpairmentSetup, RespondentSetup
from participants.survey import Respondent
from protocols.files.errors import InputError
from protocols.shipped_parts import (
    DEMONSTRATORS,
    DRIVERS,
    IMPAIRMENTS,
    PORTABLE_OPTIONS,
    RESPONDENTS,
)


def make_driver(name: str, setup: DriverSetup) -> Driver:
    """Return the driver a protocol names.

    Raises
    ------
    InputError
        When there is no such driver, or it cannot be made with these options.
    """
    return _driver("driver", DRIVERS, name, setup)


def make_impaired(name: str, setup: ImpairmentSetup) -> Driver:
    """Return a driver with the impairment a protocol names.

    Raises
    ------
    InputError
        When there is no such impairment, or it cannot be made with these options.
    """
    return _driver("impairment", IMPAIRMENTS, name, setup)


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


def portable_driver_options(name: str, options: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Return a driver's options in a form that needs no file: what they name is read now.

    Raises
    ------
    InputError
        When a file that they name cannot be used.
    """
    if name not in PORTABLE_OPTIONS:
        return dict(options)
    made: dict[str, Any] = load_factory("driver", PORTABLE_OPTIONS, name)(options, folder)
    return made


def _driver(role: str, shipped: Mapping[str, str], name: str, setup: object) -> Driver:
    driver = cast("Driver", _make(role, shipped, ("start_lap", "act"), name, setup))
    try:
        kind_of(driver)
    except ValueError as error:
        raise InputError(f"{role} {name!r}: {error}") from None
    return driver


def _make(
    role: str, shipped: Mapping[str, str], methods: tuple[str, ...], name: str, setup: object
) -> Any:
    part = load_factory(role, shipped, name)(setup)
    refuse_missing_methods(role, name, part, methods)
    return part
