"""Machine code is kept where it can be, and made anew where it cannot."""

from types import SimpleNamespace

import numba
import numpy as np
import pytest

from lad import compiled as module


def add(a, b):
    """Add two numbers."""
    return a + b


def test_without_a_writable_place_it_compiles_uncached(monkeypatch):
    """In a read-only installation numba refuses to cache: the function still works."""
    wishes = []
    real = numba.njit

    def refusing(*, cache, **options):
        wishes.append(cache)
        if cache:
            raise RuntimeError("cannot cache function 'add': no locator available for file")
        return real(cache=False, **options)

    monkeypatch.setattr(module, "numba", SimpleNamespace(njit=refusing))
    assert module.compiled(add)(2.0, 3.0) == 5.0
    assert wishes == [True, False]


@pytest.mark.parametrize("decorate", [module.compiled, module.compiled_sums])
def test_nan_and_infinity_keep_their_meaning(decorate):
    """Reordering sums does not make the compiler assume that every number is finite."""

    def is_nan(x):
        return x != x  # noqa: PLR0124  # the point

    checked = decorate(is_nan)
    assert checked(np.nan)
    assert not checked(np.inf)
    assert not checked(1.0)
