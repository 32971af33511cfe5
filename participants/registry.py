"""Where a name in a protocol becomes a driver, an impairment, a demonstrator or a respondent.

A name is a shipped one (``protocols.shipped_parts``), one that an installed package declares, or
``module:factory`` of a module beside the protocol file (``protocols.parts``). The factory takes the
setup (see ``participants.setup``) and returns the part; that of an impairment returns a driver
around the one it is given. Nothing has to be edited here to add one.

``code``, everywhere: the parts beside the protocol file that may be run, ``ResolvedStudy.code``.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, cast

from participants.demonstrator import Demonstrator
from participants.driver import Driver, kind_of
from participants.impaired import HeardDriver, ImpairedDriver
from participants.part_loader import load_factory, refuse_missing_methods, shipped_function
from participants.setup import DemonstratorSetup, DriverSetup, ImpairmentSetup, RespondentSetup
from participants.survey import Respondent
from protocols.code_beside import PartBeside
from protocols.files.errors import InputError
from protocols.shipped_parts import PORTABLE_OPTIONS, Role

Code = Sequence[PartBeside]


def make_driver(name: str, setup: DriverSetup, code: Code = ()) -> Driver:
    """Return the driver a protocol names.

    Parameters
    ----------
    name
        As a protocol has it in ``use``: a shipped driver, an installed one, or
        ``module:factory``.
    setup
        Course, traits, random numbers and options.
    code
        Parts of modules beside the protocol file that a person has trusted; empty for none.

    Raises
    ------
    InputError
        When there is no such driver, or it cannot be made with these options.

    Examples
    --------
    >>> import numpy as np
    >>> from protocols.load import load_course
    >>> setup = DriverSetup(load_course("lab-office"), np.random.default_rng(0))
    >>> driver = make_driver("autonomous", setup)
    >>> kind_of(driver)
    'synthetic'
    >>> make_driver("autonomus", setup)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    protocols.files.errors.InputError: ...
    """
    return _driver("driver", name, setup, code)


def make_impaired(name: str, setup: ImpairmentSetup, code: Code = ()) -> Driver:
    """Return a driver with the impairment a protocol names.

    Parameters
    ----------
    name
        As a protocol has it in ``use``: a shipped impairment, an installed one, or
        ``module:factory``.
    setup
        The driver to be impaired, severity, random numbers and options.
    code
        Parts of modules beside the protocol file that a person has trusted; empty for none.

    Raises
    ------
    InputError
        When there is no such impairment, or it cannot be made with these options.

    Examples
    --------
    >>> import numpy as np
    >>> from participants.scripted import ScriptedDriver
    >>> ahead = ScriptedDriver([(0.0, 0.5, 0.0)])
    >>> setup = ImpairmentSetup(ahead, severity=0.5, rng=np.random.default_rng(0))
    >>> driver = make_impaired("tremor", setup)
    >>> kind_of(driver) == kind_of(ahead)
    True
    """
    driver = HeardDriver(setup.driver)
    impairment = _driver("impairment", name, replace(setup, driver=driver), code)
    return ImpairedDriver(driver, impairment)


def make_demonstrator(name: str, setup: DemonstratorSetup, code: Code = ()) -> Demonstrator:
    """Return the demonstrator a protocol names; the same one serves as a shadow.

    Parameters
    ----------
    name
        As a protocol has it in ``use``: a shipped demonstrator, an installed one, or
        ``module:factory``.
    setup
        Course, random numbers and options.
    code
        Parts of modules beside the protocol file that a person has trusted; empty for none.

    Raises
    ------
    InputError
        When there is no such demonstrator, or it cannot be made with these options.

    Examples
    --------
    >>> import numpy as np
    >>> from protocols.load import load_course
    >>> setup = DemonstratorSetup(load_course("lab-office"), np.random.default_rng(0))
    >>> type(make_demonstrator("attentive", setup)).__name__
    'AttentiveDemonstrator'
    """
    methods = ("start_lap", "look", "assist")
    return cast("Demonstrator", _make("demonstrator", methods, name, setup, code))


def make_respondent(name: str, setup: RespondentSetup, code: Code = ()) -> Respondent:
    """Return the respondent a protocol names.

    Parameters
    ----------
    name
        As a protocol has it in ``use``: a shipped respondent, an installed one, or
        ``module:factory``.
    setup
        Traits, instruments, random numbers and options.
    code
        Parts of modules beside the protocol file that a person has trusted; empty for none.

    Raises
    ------
    InputError
        When there is no such respondent, or it cannot answer one of the questions.

    Examples
    --------
    >>> import numpy as np
    >>> setup = RespondentSetup((), np.random.default_rng(0))
    >>> type(make_respondent("ordinal", setup)).__name__
    'OrdinalRespondent'
    """
    return cast("Respondent", _make("respondent", ("answer",), name, setup, code))


def portable_driver_options(name: str, options: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """Return a driver's options in a form that needs no file: what they name is read now.

    Parameters
    ----------
    name
        The driver's, as a protocol has it.
    options
        As the protocol gives them.
    folder
        The protocol file's; paths in the options are relative to it.

    Raises
    ------
    InputError
        When a file that they name cannot be used.

    Examples
    --------
    >>> portable_driver_options("autonomous", {"control_noise": 0.02}, Path())
    {'control_noise': 0.02}
    """
    if name not in PORTABLE_OPTIONS:
        return dict(options)
    made: dict[str, Any] = shipped_function(PORTABLE_OPTIONS[name])(options, folder)
    return made


def _driver(role: Role, name: str, setup: object, code: Code) -> Driver:
    driver = cast("Driver", _make(role, ("start_lap", "act"), name, setup, code))
    try:
        kind_of(driver)
    except ValueError as error:
        raise InputError(f"{role} {name!r}: {error}") from None
    return driver


def _make(role: Role, methods: tuple[str, ...], name: str, setup: object, code: Code) -> Any:
    part = load_factory(role, name, code)(setup)
    refuse_missing_methods(role, name, part, methods)
    return part
