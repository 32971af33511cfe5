"""Machine code is kept where it can be, and compiled again where it cannot."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numba
import numpy as np
import pytest

from lad import compiled as module
from lad import fused, inverse
from lad.triangle import packed, row_starts
from lad.warm_up import warm_up

SOURCE = Path(module.__file__).parent


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


def test_it_imports_where_nothing_can_be_written(tmp_path):
    """A copy without a place for a cache, and without a home, imports and computes."""
    shutil.copytree(SOURCE, tmp_path / "lad", ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / "lad" / "__pycache__").touch()
    program = (
        "from lad import fused; print(fused.exp_of_nonpositive(0.0), "
        "type(fused.exp_of_nonpositive._cache).__name__, fused.__file__)"
    )
    environment = {"HOME": os.devnull, "PATH": "", "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(  # noqa: S603  # our own interpreter
        [sys.executable, "-c", program],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    value, cache, file = done.stdout.split()
    assert value == "1.0"
    assert cache == "NullCache"
    assert Path(file).is_relative_to(tmp_path)


def _problem(n):
    """Return arguments for ``fused.predict``, of a model of n basis vectors."""
    rng = np.random.default_rng(n)
    half = rng.normal(size=(n, n))
    matrix = packed(half @ half.T + n * np.eye(n))
    work = np.zeros((5, n + 1))
    basis, window = rng.normal(size=(2, 19, n + 1)), rng.normal(size=(2, 19))
    alpha = rng.normal(size=(2, n + 1))
    return n, matrix, row_starts(n + 1), alpha, basis, work, window, 0.5, 0.7, 0.3, np.zeros(2)


@pytest.mark.parametrize("n", [1, 3, 8, 30, 77, 201])
def test_copies_inside_callers_sum_in_the_same_order(n):
    """A sum by the function's own machine code has the bits of the copies that callers hold."""
    arguments = _problem(n)
    _, matrix, starts, alpha, _, work, _, _, signal, constant, mean = arguments
    prior = signal + constant
    latent = fused.predict(*arguments)
    k, product = work[fused.K_ROW].copy(), np.zeros(n + 1)
    fused.symmetric_product(matrix, starts, k, n, product)
    assert product[:n].tobytes() == work[fused.S_ROW, :n].tobytes()
    assert latent == prior + fused.inner(k, product, n)
    assert mean.tolist() == [fused.inner(row, k, n) for row in alpha]
    fused.learn(n, n + 1, matrix, matrix.copy(), starts, alpha, work, prior, 1e9, mean, 0.0)
    assert product[:n].tobytes() == work[fused.E_ROW, :n].tobytes()


@pytest.mark.parametrize("n", [1, 8, 77, 201])
def test_the_copy_inside_an_inversion_sums_in_the_same_order(n):
    """An inversion put together from its parts has the bits of the one that holds copies."""
    matrix, starts = _problem(n)[1:3]
    whole, parts = matrix.copy(), matrix.copy()
    inverse.invert(whole, starts, n, 1e-9)
    partners = inverse.factorise(parts, starts, n, 1e-9)
    inverse.invert_factor(parts, starts, n)
    inverse.square_of_factor(parts, starts, n)
    for i in range(n - 1, -1, -1):
        if partners[i] > i:
            inverse.swap(parts, starts, n, i, partners[i])
    assert parts.tobytes() == whole.tobytes()


@pytest.mark.parametrize(
    "function", [fused.predict, fused.learn, fused.symmetric_product, inverse.invert]
)
def test_there_is_one_signature(function):
    """A model that learns, forgets and is repaired has every function compiled for one layout."""
    warm_up()
    assert len(function.signatures) == 1
    assert all(a.layout == "C" for a in function.signatures[0] if hasattr(a, "layout"))
