"""The reference vectors, through both forms of the model, and the script that checks them."""

import importlib.util
import json
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from lad.plain import PlainStorkGP
from lad.stork_gp import StorkGP
from lad.stream import learn_stream

SCRIPT = Path(__file__).resolve().parents[2] / "bench" / "conformance.py"
RUNS = [
    ("A_sine_cap50", ""),
    ("B_wheelchair", "cap400_"),
    ("B_wheelchair", "cap100_"),
    ("B2_full400", "cap400_"),
    ("B3_illcond_stress", "cap400_"),
    ("C_probit_cap100", "correct_"),
]


@pytest.fixture(name="script", scope="module")
def _script():
    spec = importlib.util.spec_from_file_location("bench_conformance", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    yield module
    del sys.modules[spec.name]


@pytest.mark.parametrize(("name", "prefix"), RUNS)
def test_fused_form_holds_every_vector(script, vectors, name, prefix):
    """Means and variances within the table's tolerances; events and deleted ids exact."""
    header, arrays = script.read(vectors / f"{name}.npz")
    found = script.compare(arrays, prefix, script.hyperparameters(header, prefix))
    assert found.missed(script.tolerance_of(name)) == []


@pytest.mark.parametrize(
    ("name", "prefix"),
    [pytest.param(*run, marks=pytest.mark.slow) if run[0] == "B2_full400" else run for run in RUNS],
)
def test_plain_form_holds_every_vector(script, vectors, name, prefix):
    """The definition is what the authors' library computes."""
    header, arrays = script.read(vectors / f"{name}.npz")
    hyper = script.hyperparameters(header, prefix)
    found = script.compare(arrays, prefix, hyper, PlainStorkGP)
    assert found.missed(script.tolerance_of(name)) == []


@pytest.mark.parametrize(("name", "prefix"), RUNS)
def test_final_parameters(script, vectors, name, prefix):
    """Basis vectors, alpha and the diagonals of C and Q at the end are the reference's."""
    header, arrays = script.read(vectors / f"{name}.npz")
    hyper = script.hyperparameters(header, prefix)
    process = StorkGP(hyper, "probit" if prefix == "correct_" else "gaussian", arrays["Y"].shape[1])
    learn_stream(process, arrays["X"], arrays["Y"])
    wanted = {key: arrays[f"{prefix}final_{key}"] for key in ("ids", "alpha", "diagC", "diagQ")}
    ours, theirs = np.argsort(process.times), np.argsort(wanted["ids"])
    assert process.times[ours].tolist() == wanted["ids"][theirs].tolist()
    loose = 0.1 if name.startswith("B3") else 1e-5
    final = process.posterior()
    for found, key in (
        (final.alpha, "alpha"),
        (np.diag(final.C), "diagC"),
        (np.diag(final.Q), "diagQ"),
    ):
        difference = np.abs(found[ours] - wanted[key][theirs]).max()
        assert difference <= loose * np.abs(wanted[key]).max(), key


def test_script_passes_the_given_vectors(script, vectors, capsys):
    """The command prints a line per prefix, skips the MATLAB comparison, and ends with 0."""
    assert script.main([str(path) for path in sorted(vectors.glob("*.npz"))]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(RUNS)
    assert all(line.endswith("met") for line in lines)
    assert not any("otlmatlab" in line for line in lines)


def changed_copy(vectors, folder, name, key, change):
    """Copy a set of vectors with one array changed."""
    shutil.copy(vectors / f"{name}.json", folder)
    with np.load(vectors / f"{name}.npz") as archive:
        arrays = {array: archive[array] for array in archive.files}
    arrays[key] = change(arrays[key].copy())
    path = folder / f"{name}.npz"
    np.savez(path, **arrays)
    return path


def bump(index, by):
    """Build a change of one element."""

    def change(array):
        array[index] += by
        return array

    return change


@pytest.mark.parametrize(
    ("key", "change", "missed"),
    [
        ("mean", bump(7, 1e-7), "mean"),
        ("var", bump(7, 1e-8), "variance"),
        ("pmean", bump(3, 1e-7), "mean"),
        ("event", bump(9, 1), "events"),
        ("did", bump(500, 1), "events"),
        ("final_ids", bump(0, 1), "events"),
        ("mean", bump(7, np.nan), "mean"),
    ],
)
def test_script_ends_with_one_when_a_tolerance_is_missed(
    *, script, vectors, tmp_path, capsys, key, change, missed
):
    """A single wrong number of any kind is found and named."""
    path = changed_copy(vectors, tmp_path, "A_sine_cap50", key, change)
    assert script.main([str(path)]) == 1
    assert f"MISSED: {missed}" in capsys.readouterr().out


def test_script_reads_other_files_of_the_format(script, vectors, tmp_path, capsys):
    """One set of hyperparameters may serve several prefixes; ill-conditioned sets may flip."""
    with np.load(vectors / "A_sine_cap50.npz") as archive:
        arrays = {
            key if key in {"X", "Y", "Xp"} else f"again_{key}": archive[key]
            for key in archive.files
        }
    arrays["again_event"][5] += 1
    np.savez(tmp_path / "B3_other.npz", **arrays)
    header = json.loads((vectors / "A_sine_cap50.json").read_text())
    (tmp_path / "B3_other.json").write_text(json.dumps(header))
    assert script.main([str(tmp_path / "B3_other.npz")]) == 0
    assert "mismatched events 1" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["missing.npz", "A_missing.npz", "A_foreign.npz", "A_empty.npz"])
def test_script_says_what_it_cannot_read(script, tmp_path, capsys, name):
    """A file that is not there, foreign or empty: one line, exit code 2."""
    (tmp_path / "A_foreign.npz").write_bytes(b"not a zip")
    (tmp_path / "A_foreign.json").write_text("{}")
    np.savez(tmp_path / "A_empty.npz", X=np.zeros((1, 1)))
    (tmp_path / "A_empty.json").write_text("{}")
    assert script.main([str(tmp_path / name)]) == 2
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert name in lines[0]
