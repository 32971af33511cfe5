"""An assistant of two processes or more as a header and plain arrays, and back."""

from collections.abc import Mapping
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


class Savable(Protocol):
    """What is saved of an assistant; ``LADAssistant`` says what each attribute is."""

    parameters: LADParameters
    when: StorkGP
    how: StorkGP
    tuned: Tuned | None
    taught: TaughtSteps | None
    since: int

    @property
    def processes(self) -> Mapping[str, StorkGP]:
        """Every process by name, ``when`` first."""

    def make_processes(self, when: GPHyperparameters, how: GPHyperparameters) -> None:
        """Begin anew with two untaught processes."""


def take_apart(assistant: Savable) -> tuple[dict[str, Any], Arrays]:
    """Return the header and the arrays of a saved assistant.

    Parameters
    ----------
    assistant
        The assistant; it is not changed.

    Examples
    --------
    >>> from lad.lad_assistant import LADAssistant
    >>> header, arrays = take_apart(LADAssistant())
    >>> sorted(header)
    ['health', 'parameters', 'window']
    """
    window, arrays = window_arrays(assistant.when.window)
    for name, process in assistant.processes.items():
        for key, array in state_arrays(process.state).items():
            arrays[f"{name}/{key}"] = array
        if process.window is not assistant.when.window:
            arrays[f"{name}/window"] = process.window.scaled
    header: dict[str, Any] = {
        "parameters": assistant.parameters.to_header(),
        "window": window,
        "health": [process.health.to_header() for process in assistant.processes.values()],
    }
    if assistant.taught is not None:
        header["taught_since"] = assistant.since
        arrays |= assistant.taught.to_arrays() if len(assistant.taught) else {}
    if assistant.tuned is not None:
        header["tuned"] = {
            "when": assistant.tuned.when.to_header(),
            "how": assistant.tuned.how.to_header(),
            "steps": assistant.tuned.steps,
        }
    return header, arrays


def restore(assistant: Savable, header: dict[str, Any], arrays: Arrays) -> None:
    """Fill an untaught assistant of the same parameters with what ``take_apart`` returned.

    Parameters
    ----------
    assistant
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
        assistant.tuned = Tuned(when, how, header["tuned"]["steps"])
        assistant.make_processes(when, how)
    restore_window(assistant.when.window, header["window"], arrays)
    for name, process in assistant.processes.items():
        own = _belonging_to(name, arrays)
        restore_state(process.state, own)
        if process.window is not assistant.when.window:
            restore_window(process.window, header["window"], own)
    if assistant.taught is not None and f"{PREFIX}times" in arrays:
        assistant.taught = TaughtSteps.from_arrays(arrays)
    assistant.since = header.get("taught_since", 0)
    for process, health in zip(assistant.processes.values(), header["health"], strict=True):
        process.health = Health(**health)


def _belonging_to(name: str, arrays: Arrays) -> Arrays:
    prefix = f"{name}/"
    return {
        key.removeprefix(prefix): array for key, array in arrays.items() if key.startswith(prefix)
    }
