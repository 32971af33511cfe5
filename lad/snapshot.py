"""A process and a window as plain arrays and JSON, and back."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.errors import ModelFileError
from lad.state import State
from lad.triangle import entries
from lad.window import Window

Arrays = dict[str, NDArray[Any]]


def window_arrays(window: Window) -> tuple[dict[str, int], Arrays]:
    """Take a window apart."""
    header = {"time": window.time, "lap": window.lap, "seen": window.seen}
    return header, {"window": window.scaled}


def restore_window(window: Window, header: dict[str, int], arrays: Arrays) -> None:
    """Fill a new window with what ``window_arrays`` took from another."""
    window.scaled[:] = _expected(arrays, "window", window.scaled.shape)
    window.time, window.lap, window.seen = header["time"], header["lap"], header["seen"]


def state_arrays(state: State) -> Arrays:
    """Take what was learnt apart: triangles packed row by row, basis vectors as (n, tau, d)."""
    n = state.n
    lower = entries(n)
    return {
        "C": state.C[lower],
        "Q": state.Q[lower],
        "alpha": state.alpha[:, :n].T,
        "basis": state.basis[:, :, :n].transpose(2, 0, 1),
        "times": state.times[:n],
        "laps": state.laps[:n],
    }


def restore_state(state: State, arrays: Arrays) -> None:
    """Fill a new state with what ``state_arrays`` took from another."""
    n = len(_expected(arrays, "times", None))
    if n > state.capacity:
        raise ModelFileError(f"{n} basis vectors; its capacity is {state.capacity}")
    while state.room < n:
        state.n = state.room
        state.make_room()
    state.n = n
    lower = entries(n)
    state.C[lower] = _expected(arrays, "C", (n * (n + 1) // 2,))
    state.Q[lower] = _expected(arrays, "Q", (n * (n + 1) // 2,))
    state.alpha[:, :n] = _expected(arrays, "alpha", (n, state.n_outputs)).T
    basis = _expected(arrays, "basis", (n, state.depth, state.n_inputs))
    state.basis[:, :, :n] = basis.transpose(1, 2, 0)
    state.times[:n] = arrays["times"]
    state.laps[:n] = _expected(arrays, "laps", (n,))


def _expected(arrays: Arrays, name: str, shape: tuple[int, ...] | None) -> NDArray[Any]:
    """Look up an array that must be there, finite and of one shape."""
    if name not in arrays:
        raise ModelFileError(f"array {name!r} is missing")
    array = arrays[name]
    if array.dtype.kind not in "fi" or not np.isfinite(array).all():
        raise ModelFileError(f"array {name!r} holds something other than finite numbers")
    if shape is not None and array.shape != shape:
        raise ModelFileError(f"array {name!r} has shape {array.shape}; wanted is {shape}")
    return array
