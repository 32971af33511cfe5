"""Read topics of a recording: ROS 1 bags, ROS 2 (sqlite, MCAP), without ROS."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.typesys import Stores, get_typestore

from protocols.files.errors import InputError
from protocols.files.suggestion import allowed

CLOCKS_APART_S = 1.0
"""Header and arrival this far apart are two clocks; what lies between is transport, s."""

_ALLOWED = "allowed: a whole ROS 1 bag, ROS 2 folder or file (.db3), or MCAP file"


@dataclass(frozen=True)
class Stream:
    """The messages of a topic.

    Attributes
    ----------
    topic, kind
        Its name, and its messages' type.
    ns
        Shape (n,): their times by the mapping's clock, in order.
    messages
        The messages themselves.
    offset_s
        Median of arrival minus header; None without headers.
    """

    topic: str
    kind: str
    ns: NDArray[np.int64]
    messages: tuple[Any, ...]
    offset_s: float | None


def topics_of(path: Path) -> dict[str, tuple[str, int]]:
    """Return a recording's topics: their types and how many messages they have.

    Raises
    ------
    InputError
        When it cannot be read.
    """
    with _opened(path) as reader:
        return {
            name: (topic.msgtype or "several types", topic.msgcount)
            for name, topic in sorted(reader.topics.items())
        }


def read_streams(path: Path, topics: Iterable[str], clock: str) -> dict[str, Stream]:
    """Return some topics of a recording.

    Parameters
    ----------
    path
        A ``.bag``, an ``.mcap``, a ``.db3``, or a ROS 2 folder.
    topics
        Their names.
    clock
        ``header``, or ``recorded``.

    Raises
    ------
    InputError
        When it cannot be read to its end, a topic is not there, or two clocks are mixed.
    """
    wanted = set(topics)
    streams: dict[str, Stream] = {}
    with _opened(path) as reader:
        there = reader.topics
        for name in sorted(wanted):
            if name not in there or not there[name].msgcount:
                what = "no message of" if name in there else "no topic"
                raise InputError(f"{path}: {what} {name}; {allowed(name, sorted(there))}")
        found: dict[str, list[tuple[int, Any]]] = {name: [] for name in wanted}
        try:
            for connection, ns, raw in reader.messages(
                [c for c in reader.connections if c.topic in wanted]
            ):
                message = reader.deserialize(raw, connection.msgtype)
                found[connection.topic].append((ns, message))
        except Exception as error:  # the library raises whatever a damaged file leads to
            raise InputError(f"{path}: is cut off or damaged: {error}; {_ALLOWED}") from error
        for name, pairs in found.items():
            if not pairs:
                raise InputError(f"{path}: no message of {name} can be read; {_ALLOWED}")
            streams[name] = _stream(name, str(there[name].msgtype), pairs, clock)
    _refuse_two_clocks(path, streams, clock)
    return streams


def _opened(path: Path) -> AnyReader:
    if not path.exists():
        raise InputError(f"{path}: no such recording; {_ALLOWED}")
    try:
        reader = AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE))
        reader.open()
    except (AnyReaderError, OSError, ValueError, AssertionError, KeyError, IndexError) as error:
        reason = str(error) or type(error).__name__
        raise InputError(f"{path}: cannot be read as a recording: {reason}; {_ALLOWED}") from None
    return _Opened(reader)  # type: ignore[return-value]


class _Opened:
    """A reader that is open already, to be closed at the end of a block."""

    def __init__(self, reader: AnyReader) -> None:
        self._reader = reader

    def __enter__(self) -> AnyReader:
        return self._reader

    def __exit__(self, *_: object) -> None:
        self._reader.close()


def _stream(topic: str, kind: str, pairs: list[tuple[int, Any]], clock: str) -> Stream:
    arrived = np.array([ns for ns, _ in pairs], dtype=np.int64)
    stamps = [_stamp(message) for _, message in pairs]
    offset = None
    if None not in stamps:
        headers = np.array(stamps, dtype=np.int64)
        offset = float(np.median(arrived - headers)) / 1e9
    ns = headers if offset is not None and clock == "header" else arrived
    order = np.argsort(ns, kind="stable")
    messages = tuple(pairs[i][1] for i in order.tolist())
    return Stream(topic, kind, ns[order], messages, offset)


def _stamp(message: Any) -> int | None:
    header = getattr(message, "header", None)
    if header is None:
        return None
    stamp = int(header.stamp.sec) * 10**9 + int(header.stamp.nanosec)
    return stamp or None  # a stamp of zero was never filled in


def _refuse_two_clocks(path: Path, streams: dict[str, Stream], clock: str) -> None:
    """Refuse streams whose times cannot be compared."""
    if clock != "header":
        return
    offsets = {s.topic: s.offset_s if s.offset_s is not None else 0.0 for s in streams.values()}
    low, high = min(offsets, key=offsets.__getitem__), max(offsets, key=offsets.__getitem__)
    if offsets[high] - offsets[low] > CLOCKS_APART_S:
        raise InputError(
            f"{path}: two clocks: the headers of {high} are {offsets[high] - offsets[low]:.1f} s "
            f"behind those of {low}; allowed: 'clock: recorded' in the mapping, if the recorder's "
            "clock is one"
        )
