"""Saved models: portable, the same bytes for the same model, and errors that name the file."""

import io
import json
import pickle
import tracemalloc
import zipfile

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lad.errors import ModelFileError
from lad.hyperparameters import GPHyperparameters
from lad.model_file import pack, unpack
from lad.stork_gp import StorkGP
from lad.stream import learn_stream


def trained(seed=0, steps=40, likelihood="gaussian", capacity=12):
    """Train a small process somewhere in its second lap."""
    rng = np.random.default_rng(seed)
    process = StorkGP(
        GPHyperparameters(lengthscales=[1.0, 0.3], noise_variance=0.05, capacity=capacity),
        likelihood,
    )
    x, y = rng.normal(size=(steps, 2)), rng.choice([-1.0, 1.0], size=(steps, 1))
    if steps:
        learn_stream(process, x[: steps // 2 + 1], y[: steps // 2 + 1])
        process.reset_window()
        learn_stream(process, x[steps // 2 :], y[steps // 2 :])
    return process


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(0, 60), st.sampled_from(["gaussian", "probit"]))
def test_rebuilt_process_is_bit_identical_now_and_later(seed, steps, likelihood):
    """Predictions right after loading, and everything learnt from then on, are the same bits."""
    process = trained(seed, steps, likelihood)
    data = process.to_bytes()
    again = StorkGP.from_bytes(data)
    assert again.to_bytes() == data
    one, other = process.predict(), again.predict()
    assert one.mean.tolist() == other.mean.tolist()
    assert one.latent_variance == other.latent_variance
    rng = np.random.default_rng(seed + 1)
    x, y = rng.normal(size=(30, 2)), rng.choice([-1.0, 1.0], size=(30, 1))
    learn_stream(process, x, y)
    learn_stream(again, x, y)
    assert process.to_bytes() == again.to_bytes()


def test_save_and_load(tmp_path):
    """A file holds the bytes of the model, and no other file is left beside it."""
    process = trained()
    process.save(tmp_path / "model.npz")
    process.save(tmp_path / "model.npz")
    assert [path.name for path in tmp_path.iterdir()] == ["model.npz"]
    assert (tmp_path / "model.npz").read_bytes() == process.to_bytes()
    assert StorkGP.load(tmp_path / "model.npz").to_bytes() == process.to_bytes()


def test_the_same_model_is_the_same_bytes():
    """Two models trained alike have the same bytes: no clock, no addresses."""
    assert trained(3).to_bytes() == trained(3).to_bytes()
    assert trained(3).to_bytes() != trained(4).to_bytes()


def test_anyone_can_read_it_without_pickle():
    """The file is a plain npz with a JSON header that says what it is and how it was made."""
    process = trained()
    with np.load(io.BytesIO(process.to_bytes()), allow_pickle=False) as archive:
        header = json.loads(str(archive["header"]))
        assert archive["alpha"].shape == (process.n_basis, 1)
        assert archive["basis"].shape == (process.n_basis, 4, 2)
    assert header["format"] == "lad-model"
    assert header["format_version"] == 1
    assert header["kind"] == "stork-gp"
    assert header["library_version"]
    assert GPHyperparameters(**header["hyperparameters"]) == process.hyperparameters


@settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(cut=st.floats(0.0, 0.999))
def test_a_truncated_file_is_a_clear_error(tmp_path, cut):
    """Cut anywhere, the file is refused by name, and says truncated."""
    data = trained().to_bytes()
    path = tmp_path / "cut.npz"
    path.write_bytes(data[: int(cut * len(data))])
    with pytest.raises(ModelFileError, match=r"cut\.npz: truncated"):
        StorkGP.load(path)


def npz(**arrays):
    """Write an npz that is not ours."""
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


def empty_zip():
    """Write a zip without members."""
    buffer = io.BytesIO()
    zipfile.ZipFile(buffer, "w").close()
    return buffer.getvalue()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"something else entirely",
        npz(alpha=np.zeros(3)),
        npz(header=np.array("not JSON")),
        npz(header=np.array("[]")),
        npz(header=np.array([1, 2], dtype=object)),
        empty_zip(),
    ],
)
def test_a_foreign_file_is_a_clear_error(data):
    """Whatever the bytes are, the error is ours."""
    with pytest.raises(ModelFileError, match="not a saved model"):
        StorkGP.from_bytes(data)


def test_a_flipped_bit_is_noticed():
    """Damage inside a member does not become a model."""
    data = bytearray(trained().to_bytes())
    data[len(data) // 3] ^= 4
    with pytest.raises(ModelFileError):
        StorkGP.from_bytes(bytes(data))


def test_a_later_format_and_another_kind_are_named():
    """A newer file says which version it has; another kind of model says what it is."""
    with pytest.raises(ModelFileError, match="given format version 2; this library reads 1"):
        unpack(pack("stork-gp", {"format_version": 2}, {}), "stork-gp")
    with pytest.raises(ModelFileError, match="holds a 'soup'; wanted is a 'stork-gp'"):
        unpack(pack("soup", {}, {}), "stork-gp")
    with pytest.raises(ModelFileError, match="given format 'x'; allowed is 'lad-model'"):
        unpack(pack("stork-gp", {"format": "x"}, {}), "stork-gp")


def test_a_missing_file_is_named(tmp_path):
    """A path that does not exist is a ModelFileError with the path in it."""
    with pytest.raises(ModelFileError, match=r"nowhere\.npz: cannot be read \(No such file"):
        StorkGP.load(tmp_path / "nowhere.npz")


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("alpha", np.zeros((3, 3)), "'alpha' has shape"),
        ("C", np.array([np.nan]), "'C' holds something other than finite"),
        ("times", np.zeros(500), "500 basis vectors; its capacity is 12"),
        ("times", None, "'times' is missing"),
        ("basis", np.array(["a"]), "'basis' holds something other"),
    ],
)
def test_contents_that_do_not_fit_are_named(name, value, message):
    """A well-formed file whose arrays contradict each other does not become a model."""
    header, arrays = unpack(trained().to_bytes(), "stork-gp")
    if value is None:
        del arrays[name]
    else:
        arrays[name] = value
    with pytest.raises(ModelFileError, match=message):
        StorkGP.from_bytes(pack("stork-gp", header, arrays))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"hyperparameters": {"capacity": -1}}, "capacity"),
        ({"likelihood": "logit"}, "allowed are gaussian and probit"),
        ({"health": {"mood": 3}}, "mood"),
        ({"window": {}}, "'time' is missing"),
    ],
)
def test_headers_that_do_not_fit_are_named(change, message):
    """A wrong value in the header says which."""
    header, arrays = unpack(trained().to_bytes(), "stork-gp")
    with pytest.raises(ModelFileError, match=message):
        StorkGP.from_bytes(pack("stork-gp", header | change, arrays))


def test_a_failed_write_leaves_the_old_file(tmp_path, monkeypatch):
    """When the disk gives up, the file that was there is still whole and nothing lies beside it."""
    path = tmp_path / "model.npz"
    trained(1).save(path)
    before = path.read_bytes()

    def broken(self, data):
        self.touch()
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(type(path), "write_bytes", broken)
    with pytest.raises(OSError, match="No space left"):
        trained(2).save(path)
    assert path.read_bytes() == before
    assert [one.name for one in tmp_path.iterdir()] == ["model.npz"]


def _npz(**members):
    """Return an npz with these members as they are given."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(f"{name}.npy", content)
    return buffer.getvalue()


def _claims(shape, dtype="<f8", content=b""):
    """Return an npy that claims a shape."""
    buffer = io.BytesIO()
    header = {"shape": shape, "fortran_order": False, "descr": dtype}
    np.lib.format.write_array_header_1_0(buffer, header)
    return buffer.getvalue() + content


class _Shell:
    """Creates a file when it is unpickled."""

    def __init__(self, proof):
        self.proof = proof

    def __reduce__(self):
        return (open, (str(self.proof), "w"))


@pytest.mark.parametrize(
    "content",
    [
        _npz(header=_claims((10**12,))),
        _npz(header=_claims((10**6, 10**6, 10**6))),
        _npz(header=_claims((-1,))),
        _npz(header=_claims((4,), content=b"x" * 8)),
        _npz(**{f"a{i}": _claims(()) for i in range(300)}),
        _npz(header=b"\x93NUMPY\x07\x00"),
        _npz(),
    ],
    ids=["huge", "absurd", "negative", "short", "many", "version", "empty"],
)
def test_what_a_file_claims_is_not_believed(content):
    """No memory is asked for that the file does not fill."""
    tracemalloc.start()
    with pytest.raises(ModelFileError, match="not a saved model"):
        unpack(content, "model", "m.npz")
    assert tracemalloc.get_traced_memory()[1] < 20e6
    tracemalloc.stop()


def test_a_file_that_unfolds_without_end_is_refused(monkeypatch):
    """Before it is unfolded."""
    monkeypatch.setattr("lad.model_file.MAX_BYTES", 1_000_000)
    bomb = _npz(header=bytes(50_000_000))
    assert len(bomb) < 100_000
    with pytest.raises(ModelFileError, match="not a saved model"):
        unpack(bomb, "model", "m.npz")
    with pytest.raises(ModelFileError, match="2000000 bytes; a model may have 1000000"):
        unpack(bytes(2_000_000), "model", "m.npz")


def test_no_code_in_a_file_is_run(tmp_path):
    """An array of objects is a pickle, and is not opened."""
    proof = tmp_path / "proof"
    pickled = pickle.dumps(np.array([_Shell(proof)], dtype=object))
    with pytest.raises(ModelFileError):
        unpack(_npz(header=_claims((1,), "|O", pickled)), "model", "m.npz")
    buffer = io.BytesIO()
    np.savez(buffer, header=np.array([_Shell(proof)], dtype=object))
    with pytest.raises(ModelFileError):
        unpack(buffer.getvalue(), "model", "m.npz")
    assert not proof.exists()
