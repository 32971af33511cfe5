"""An assistant of two processes as a header and plain arrays, and back."""

from typing import Any, Protocol

from lad.errors import ModelFileError
from lad.health import Health
from lad.hyperparameters import GPHyperparameters, LADParameters
from lad.snapshot import Arrays, restore_state, restore_window, state_arrays, window_arrays
from lad.stork_gp import StorkGP
from lad.tuning.taught import PREFIX, TaughtSteps
from lad.tuning.tune import Tuned

FIELDS = frozenset(
    ("format", "format_version", "library_version", "kind", "parameters", "window", "health",
     "taught_since", "tuned")
)  # fmt: skip
"""Every field that a header may have."""


class Pair(Protocol):
    """What is saved of an assistant; ``LADAssistant`` says what each attribute is."""

    parameters: LADParameters
    when: StorkGP
    how: StorkGP
    tuned: Tuned | None
    taught: TaughtSteps | None
    since: int

    @property
    def one_window(self) -> bool:
        """Whether the two processes look at the same window."""

    def make_processes(self, when: GPHyperparameters, how: GPHyperparameters) -> None:
        """Begin anew with two untaught processes."""


def take_apart(pair: Pair) -> tuple[dict[str, Any], Arrays]:
    """Return the header and the arrays of a saved assistant.

    Parameters
    ----------
    pair
        The assistant; it is not changed.

    Examples
    --------
    >>> from lad.lad_assistant import LADAssistant
    >>> header, arrays = take_apart(LADAssistant())
    >>> sorted(header)
    ['health', 'parameters', 'window']
    """
    window, arrays = window_arrays(pair.when.window)
    for name, process in (("when", pair.when), ("how", pair.how)):
        for key, array in state_arrays(process.state).items():
            arrays[f"{name}/{key}"] = array
    header: dict[str, Any] = {
        "parameters": pair.parameters.to_header(),
        "window": window,
        "health": [pair.when.health.to_header(), pair.how.health.to_header()],
    }
    if pair.taught is not None:
        header["taught_since"] = pair.since
        arrays |= pair.taught.to_arrays() if len(pair.taught) else {}
    if pair.tuned is not None:
        header["tuned"] = {
            "when": pair.tuned.when.to_header(),
            "how": pair.tuned.how.to_header(),
            "steps": pair.tuned.steps,
        }
    if not pair.one_window:
        arrays["how/window"] = pair.how.window.scaled
    return header, arrays


def restore(pair: Pair, header: dict[str, Any], arrays: Arrays) -> None:
    """Fill an untaught assistant of the same parameters with what ``take_apart`` returned.

    Parameters
    ----------
    pair
        An untaught assistant of the same parameters; it is changed.
    header
        As it was saved.
    arrays
        As they were saved, by name.

    Raises
    ------
    ModelFileError
        When the header has a field of another version: what it says cannot be left out.

    Examples
    --------
    >>> import numpy as np
    >>> from lad.command import Command
    >>> from lad.lad_assistant import LADAssistant
    >>> taught, fresh = LADAssistant(), LADAssistant()
    >>> taught.start_lap()
    >>> _ = taught.assist(np.zeros(19))
    >>> taught.learn(helping=True, command=Command(v=0.2, w=-0.5))
    >>> restore(fresh, *take_apart(taught))
    >>> fresh.assist(np.ones(19)) == taught.assist(np.ones(19))
    True
    """
    unknown = sorted(set(header) - FIELDS)
    if unknown:
        raise ModelFileError(f"header: {unknown[0]!r} is of another version of lad-study")
    if "tuned" in header:
        when, how = (GPHyperparameters.from_header(header["tuned"][n]) for n in ("when", "how"))
        pair.tuned = Tuned(when, how, header["tuned"]["steps"])
        pair.make_processes(when, how)
    restore_window(pair.when.window, header["window"], arrays)
    for name, process in (("when", pair.when), ("how", pair.how)):
        own = _belonging_to(name, arrays)
        restore_state(process.state, own)
        if process.window is not pair.when.window:
            restore_window(process.window, header["window"], own)
    if pair.taught is not None and f"{PREFIX}times" in arrays:
        pair.taught = TaughtSteps.from_arrays(arrays)
    pair.since = header.get("taught_since", 0)
    pair.when.health, pair.how.health = (Health(**one) for one in header["health"])


def _belonging_to(name: str, arrays: Arrays) -> Arrays:
    prefix = f"{name}/"
    return {
        key.removeprefix(prefix): array for key, array in arrays.items() if key.startswith(prefix)
    }
