"""Compilation of the numerical loops, cached on disk where that is possible."""

from collections.abc import Callable
from typing import Any, TypeVar

import numba

F = TypeVar("F", bound=Callable[..., Any])

REORDERED = frozenset({"reassoc", "contract", "nsz"})
"""Sums may be reordered and fused into multiply-adds; NaN and infinity keep their meaning."""


def compiled(function: F) -> F:
    """Compile on first call, and keep the machine code beside the source for the next process.

    A read-only installation without a writable home has nowhere to keep it: numba raises when
    it is asked to, and the function is then compiled anew in each process.
    """
    options: dict[str, Any] = {"nogil": True, "fastmath": set(REORDERED), "error_model": "numpy"}
    try:
        return numba.njit(cache=True, **options)(function)  # type: ignore[no-any-return]
    except RuntimeError:
        return numba.njit(cache=False, **options)(function)  # type: ignore[no-any-return]
