"""A saved model: an npz of plain arrays and a JSON header, the same bytes for the same model.

The file is an ordinary ``.npz``: ``json.loads(str(numpy.load(path)["header"]))`` reads the header,
and nothing in it needs pickle.
"""

import io
import json
import math
import os
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lad.errors import ModelFileError

FORMAT = "lad-model"
FORMAT_VERSION = 1
FIXED_DATE = (1980, 1, 1, 0, 0, 0)
UNIX = 3
MAX_BYTES = 1_000_000_000
"""Of a file, and of what it unfolds to: a model of capacity 5000 has half as many."""

MAX_ARRAYS = 200


@cache
def library_version() -> str:
    """Version of the installed distribution; ``unknown`` in a bare checkout."""
    try:
        return version("lad-study")
    except PackageNotFoundError:
        return "unknown"


def _member(name: str, array: NDArray[Any]) -> tuple[zipfile.ZipInfo, bytes]:
    buffer = io.BytesIO()
    np.lib.format.write_array(buffer, np.asarray(array, order="C"), allow_pickle=False)
    info = zipfile.ZipInfo(f"{name}.npy", date_time=FIXED_DATE)
    info.create_system = UNIX
    return info, buffer.getvalue()


def pack(kind: str, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Write a header and arrays as the bytes of an npz.

    Parameters
    ----------
    kind
        What the file holds; ``unpack`` asks for it by name.
    header
        Anything JSON can hold.
    arrays
        Named arrays of numbers.
    """
    full = {
        "format": FORMAT,
        "format_version": FORMAT_VERSION,
        "library_version": library_version(),
        "kind": kind,
        **header,
    }
    text = np.array(json.dumps(full, sort_keys=True, allow_nan=False))
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as archive:
        for name, array in {"header": text, **dict(sorted(arrays.items()))}.items():
            archive.writestr(*_member(name, array))
    return buffer.getvalue()


def unpack(
    data: bytes, kind: str, source: str = "model"
) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Read what ``pack`` wrote.

    Parameters
    ----------
    data
        Bytes of the npz.
    kind
        What it should hold.
    source
        What to call it in an error, such as its path.

    Raises
    ------
    ModelFileError
        When the bytes are truncated, foreign, too large, of another kind or of a later format.
    """
    header, arrays = _opened(data, source)
    found = (header["format"], header["format_version"], header["kind"])
    if found[0] != FORMAT:
        raise ModelFileError(f"{source}: given format {found[0]!r}; allowed is {FORMAT!r}")
    if found[1] != FORMAT_VERSION:
        raise ModelFileError(
            f"{source}: given format version {found[1]!r}; this library reads {FORMAT_VERSION}"
        )
    if found[2] != kind:
        raise ModelFileError(f"{source}: holds a {found[2]!r}; wanted is a {kind!r}")
    return header, arrays


def kind_of(data: bytes, source: str = "model") -> str:
    """Return what a saved model says that it holds, whatever its format version.

    Raises
    ------
    ModelFileError
        When the bytes are truncated, foreign or too large.
    """
    return str(_opened(data, source)[0]["kind"])


def _opened(data: bytes, source: str) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    if len(data) > MAX_BYTES:
        raise ModelFileError(f"{source}: {len(data)} bytes; a model may have {MAX_BYTES}")
    try:
        arrays = _arrays(data)
        header = json.loads(str(arrays.pop("header")))
        _ = header["format"], header["format_version"], header["kind"]
    except Exception as error:  # whatever zip, numpy and JSON may raise on foreign bytes
        raise ModelFileError(f"{source}: truncated, or not a saved model at all") from error
    return header, arrays


def _arrays(data: bytes) -> dict[str, NDArray[Any]]:
    """Return a file's arrays; nothing in it is run, and nothing it claims is believed.

    An array's header may claim any shape, and a compressed member may unfold without end: both are
    compared with what is there before memory is asked for.
    """
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        members = archive.infolist()
        if len(members) > MAX_ARRAYS or sum(m.file_size for m in members) > MAX_BYTES:
            raise ValueError("more arrays or larger ones than any model has")
        return {m.filename.removesuffix(".npy"): _array(archive.read(m)) for m in members}


def _array(content: bytes) -> NDArray[Any]:
    stream = io.BytesIO(content)
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError("an array of another format than ours")
    shape, _, dtype = np.lib.format.read_array_header_1_0(stream)
    if math.prod(shape) * dtype.itemsize != len(content) - stream.tell():
        raise ValueError(f"an array that claims the shape {shape} and has another size")
    stream.seek(0)
    array: NDArray[Any] = np.lib.format.read_array(stream, allow_pickle=False)
    return array


@contextmanager
def rebuilding(source: str) -> Iterator[None]:
    """Turn whatever is wrong inside a well-formed file into a ModelFileError that names it."""
    try:
        yield
    except (KeyError, TypeError, ValueError) as error:
        reason = f"{error} is missing" if isinstance(error, KeyError) else str(error)
        raise ModelFileError(f"{source}: {reason}") from error


def read(path: str | Path) -> bytes:
    """Read a file; the error is a ModelFileError that names the path."""
    try:
        with Path(path).open("rb") as stream:
            return stream.read(MAX_BYTES + 1)
    except OSError as error:
        raise ModelFileError(f"{path}: cannot be read ({error.strerror})") from error


def write_whole(path: str | Path, data: bytes) -> None:
    """Write under another name and rename, so that a reader never finds half a file."""
    path = Path(path)
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        beside.write_bytes(data)
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)
