"""Compilation of the numerical loops, cached on disk where that is possible."""

from collections.abc import Callable, Iterable
from typing import Any, TypeVar

import numba

F = TypeVar("F", bound=Callable[..., Any])


def compile_cached(function: F, fastmath: Iterable[str]) -> F:
    """Compile on first call, and keep the machine code beside the source for the next process.

    A read-only installation without a writable home has nowhere to keep it: numba raises when
    it is asked to, and the function is then compiled in each process.
    """
    options: dict[str, Any] = {"nogil": True, "fastmath": set(fastmath), "error_model": "numpy"}
    try:
        return numba.njit(cache=True, **options)(function)  # type: ignore[no-any-return]
    except RuntimeError:
        return numba.njit(cache=False, **options)(function)  # type: ignore[no-any-return]


def compiled(function: F) -> F:
    """Compile with the arithmetic exactly as written; nothing is fused or reordered.

    A function that others call exists several times: its own machine code, and copies inside its
    callers', each optimised by itself. Which one runs depends on whether it was compiled in this
    process or came from the cache. Exact arithmetic makes all of them give the same bits.
    """
    return compile_cached(function, ())


def compiled_sums(function: F) -> F:
    """Compile with sums that may be reordered, which vectorises a running total.

    Do not use it everywhere: without a fixed order, LLVM also moves a division by a constant
    from outside a loop to inside it. The order is chosen when code is made, from the types alone:
    every caller passes contiguous arrays, so there is one signature, lazily compiled or not, and
    code from disk is the code that was made. Nothing guarantees that the copies inside callers
    use the same order; a test compares them.
    """
    return compile_cached(function, ("contract", "reassoc", "nsz"))
