"""The benchmark measures what it says: the same numbers in every form, the right kind of step."""

import importlib
import json
from pathlib import Path

import numpy as np
import pytest

BENCH = Path(__file__).resolve().parents[2] / "bench"


@pytest.fixture(name="bench")
def _bench(monkeypatch):
    monkeypatch.syspath_prepend(str(BENCH))
    for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
        monkeypatch.setenv(name, "1")
    return importlib.import_module("stork_gp")


@pytest.mark.parametrize(
    ("operation", "steps"), [("sparse", 30), ("full", 16), ("full+delete", 60)]
)
def test_every_form_computes_the_same(bench, operation, steps):
    """Fused, BLAS and plain forms agree to 1e-12 over the steps that are timed, kind by kind."""
    data = bench.stream(bench.TRAINING_STEPS + steps)
    hyper, size, room = bench.setting(operation, 30, 4)
    state = bench.trained(size, 4, data).state
    forms = {name: make(hyper, state, room) for name, make in bench.MAKERS.items()}
    counted = 0
    for x, y in zip(*(part[bench.TRAINING_STEPS :] for part in data), strict=True):
        found, updates = {}, {}
        for name, process in forms.items():
            process.observe(x)
            found[name] = process.predict()
            updates[name] = process.learn(y)
        wanted = found["numpy"]
        for one in found.values():
            assert np.abs(one.mean - wanted.mean).max() < 1e-12
            assert abs(one.variance - wanted.variance) < 1e-12
        assert len({update.kind for update in updates.values()}) == 1
        counted += updates["lad"].kind == bench.KINDS[operation]
    assert counted > 0.7 * steps


def test_a_run_prints_the_promises_and_writes_rows(bench, monkeypatch, tmp_path, capsys):
    """At toy sizes: every cell is there, the JSON has the promised keys, the plot is drawn."""
    monkeypatch.setattr(bench, "SIZES", (10, 12))
    monkeypatch.setattr(bench, "DEPTHS", (1, 4))
    monkeypatch.setattr(bench, "verdict", lambda rows: f"{len(rows)} rows")
    monkeypatch.setattr(bench, "TRAINING_STEPS", 200)
    monkeypatch.setattr(
        bench.importlib.util, "find_spec", lambda name: None if name == "gpytorch" else name
    )
    arguments = ["--rounds", "2", "--json", str(tmp_path / "rows.json")]
    assert bench.main([*arguments, "--plot", str(tmp_path / "plot.svg")]) == 0
    out = capsys.readouterr().out
    assert "gpytorch: not installed, left out" in out
    rows = json.loads((tmp_path / "rows.json").read_text())
    assert {tuple(row) for row in rows} == {
        ("implementation", "operation", "m", "tau", "median_us")
    }
    cells = {(row["implementation"], row["operation"]) for row in rows}
    assert cells == {
        *((n, o) for n in ("lad", "blas", "numpy", "sklearn") for o in bench.OPERATIONS),
        ("bound", "dsymv"),
        ("bound", "dsyr"),
        ("bound", "full+delete"),
    }
    assert len(rows) == 2 * 2 * 19
    assert all(row["median_us"] > 0.0 for row in rows)
    assert (tmp_path / "plot.svg").stat().st_size > 1000


def test_aims_are_compared_with_the_measurement(bench):
    """A step of ten products is reported as missed."""
    rows = [bench.Row("lad", "full+delete", m, 4, float(m)) for m in bench.SIZES]
    rows += [
        bench.Row("bound", "dsymv", 400, 4, 40.0),
        bench.Row("blas", "full+delete", 400, 4, 800.0),
    ]
    rows += [bench.Row("bound", "full+delete", m, 4, m / 1.5) for m in (200, 400)]
    rows += [bench.Row("bound", "full+delete", 800, 4, 400.0)]
    small, middle, large, first, second, third = bench.verdict(rows).splitlines()
    assert small.endswith("1.50 (at most 1.8): met")
    assert middle.endswith("1.50 (at most 1.8): met")
    assert large.endswith("2.00 (at most 1.8): MISSED")
    assert first.endswith("10.00 (at most 9): MISSED")
    assert second.endswith("0.50 (at most 0.6): met")
    assert third.endswith("1.00 (at most 2): met")
