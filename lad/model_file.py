"""A saved model: an npz of plain arrays and a JSON header, the same bytes for the same model.

The file is an ordinary ``.npz``: ``json.loads(str(numpy.load(path)["header"]))`` reads the header,
and nothing in it needs pickle.
"""

import io
import json
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
        Anything JSON can say.
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
        When the bytes are truncated, foreign, of another kind or of a later format.
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
        When the bytes are truncated or foreign.
    """
    return str(_opened(data, source)[0]["kind"])


def _opened(data: bytes, source: str) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        header = json.loads(str(arrays.pop("header")))
        _ = header["format"], header["format_version"], header["kind"]
    except Exception as error:  # whatever zip, numpy and JSON may raise on foreign bytes
        raise ModelFileError(f"{source}: truncated, or not a saved model at all") from error
    return header, arrays


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
        return Path(path).read_bytes()
    except OSError as error:
        raise ModelFileError(f"{path}: cannot be read ({error.strerror})") from error


def write_whole(path: str | Path, data: bytes) -> None:
    """Write beside the place and rename, so that a reader never meets half a file."""
    path = Path(path)
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        beside.write_bytes(data)
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)
