"""Machine code is kept where it can be, and made anew where it cannot."""

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
