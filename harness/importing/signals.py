"""Streams as numbers at the control steps' times."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.importing.mapping import (
    BagMapping,
    CommandSource,
    PoseSource,
    ScanSource,
    SignalSource,
    Stick,
)
from harness.importing.recording import Stream
from lad.inputs import N_SEGMENTS
from protocols.files.errors import InputError
from protocols.wheelchair import LASER_RANGE

SLACK_NS = 500
"""Half a microsecond: a message at a step's time counts for the step."""

UNIT_WITHIN = 0.1
"""How far an orientation's length may be from 1; one that was never filled in has length 0."""


def poses(stream: Stream, source: PoseSource, path: object) -> NDArray[np.float64]:
    """Return a stream's poses in the course: shape (n, 3), x and y of the axle, heading unwrapped.

    A pose with a number that is none, or with an orientation that was never filled in, is NaN.

    Raises
    ------
    InputError
        When messages are of another type, or in another frame than the mapping says, or none of
        them has a pose.
    """
    rows = []
    for message in stream.messages:
        frame = message.header.frame_id if hasattr(message, "header") else ""
        if source.frame is not None and frame != source.frame:
            raise InputError(
                f"{path}: {stream.topic}: poses are in frame {frame!r}, not {source.frame!r}; "
                "allowed: that frame in the mapping, with the transform from it to the course"
            )
        pose = getattr(message, "pose", None)
        pose = getattr(pose, "pose", pose)
        if pose is None or not hasattr(pose, "orientation"):
            raise _wrong_type(path, stream, "Odometry, PoseStamped, PoseWithCovarianceStamped")
        q = pose.orientation
        heading = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        unit = abs(math.hypot(q.x, q.y, q.z, q.w) - 1) < UNIT_WITHIN
        rows.append((pose.position.x, pose.position.y, heading if unit else math.nan))
    found = np.array(rows, dtype=np.float64)
    good = np.isfinite(found).all(axis=1)
    if not good.any():
        raise InputError(f"{path}: {stream.topic}: no message has a position and an orientation")
    found[~good] = np.nan
    at = source.transform
    cos, sin = math.cos(at.yaw), math.sin(at.yaw)
    x = at.x + cos * found[:, 0] - sin * found[:, 1]
    y = at.y + sin * found[:, 0] + cos * found[:, 1]
    turned = found[:, 2] + at.yaw
    turned[good] = np.unwrap(turned[good])
    ahead = source.ahead_of_axle_m
    return np.stack([x - ahead * np.cos(turned), y - ahead * np.sin(turned), turned], axis=1)


def commands(stream: Stream, stick: Stick, path: object) -> NDArray[np.float64]:
    """Return a stream's commands or velocities: shape (n, 2), m/s and rad/s."""
    rows = []
    for message in stream.messages:
        if hasattr(message, "axes"):
            axes = message.axes
            if max(stick.axis_v, stick.axis_w) >= len(axes):
                raise InputError(
                    f"{path}: {stream.topic}: a joystick of {len(axes)} axes; allowed: axis_v and "
                    f"axis_w of 0 to {len(axes) - 1}"
                )
            rows.append((stick.scale_v * axes[stick.axis_v], stick.scale_w * axes[stick.axis_w]))
            continue
        twist = getattr(message, "twist", message)
        twist = getattr(twist, "twist", twist)
        if not hasattr(twist, "linear"):
            raise _wrong_type(path, stream, "Twist, TwistStamped, Odometry, Joy")
        rows.append((twist.linear.x, twist.angular.z))
    return np.array(rows, dtype=np.float64)


def signals(stream: Stream, source: SignalSource, path: object) -> NDArray[np.bool_]:
    """Return whether a signal is on in each message: shape (n,)."""
    rows = []
    for message in stream.messages:
        if hasattr(message, "buttons"):
            if source.button >= len(message.buttons):
                count = len(message.buttons)
                raise InputError(
                    f"{path}: {stream.topic}: a joystick of {count} buttons; allowed: button of 0 "
                    f"to {count - 1}"
                )
            rows.append(float(message.buttons[source.button]) > source.above)
            continue
        data = getattr(message, "data", None)
        if isinstance(data, str):
            rows.append(data in source.texts)
        elif isinstance(data, bool | int | float | np.number | np.bool_):
            rows.append(float(data) > source.above)
        else:
            raise _wrong_type(path, stream, "Bool, a number, String, Joy")
    return np.array(rows, dtype=bool)


def segments(stream: Stream, source: ScanSource, path: object) -> NDArray[np.float64]:
    """Return scans as the model sees them: shape (n, 15), m, from right to left.

    The nearest valid reading of each 12 degree segment of the front half circle, at most
    4 m. Infinity says that nothing was seen; NaN and what is nearer than the sensor measures is
    no reading. NaN where a segment has no valid reading.
    """
    rows = []
    edges = np.linspace(-math.pi / 2, math.pi / 2, N_SEGMENTS + 1)
    middles = (edges[:-1] + edges[1:]) / 2
    for message in stream.messages:
        if not hasattr(message, "ranges"):
            raise _wrong_type(path, stream, "LaserScan")
        ranges = np.asarray(message.ranges, dtype=np.float64)
        angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
        bearings = (angles - source.forward_rad) * (-1 if source.upside_down else 1)
        bearings = np.arctan2(np.sin(bearings), np.cos(bearings))
        valid = ~np.isnan(ranges) & (ranges >= message.range_min) & (ranges > 0)
        readings = np.where(valid, np.minimum(ranges, LASER_RANGE), np.inf)
        # Half-open from right to left, as the simulated laser shares its rays.
        share = np.searchsorted(edges - 1e-6, bearings, side="right") - 1
        row = np.full(N_SEGMENTS, np.inf)
        inside = (share >= 0) & (share < N_SEGMENTS)
        np.minimum.at(row, share[inside], readings[inside])
        for i in set(range(N_SEGMENTS)) - set(share[inside].tolist()):
            row[i] = readings[np.argmin(np.abs(bearings - middles[i]))]
        rows.append(row)
    found = np.array(rows)
    return np.where(np.isfinite(found), found, np.nan)


def latest(ns: NDArray[np.int64], at: NDArray[np.int64]) -> NDArray[np.int64]:
    """Return the index of the latest message at each time; -1 before the first."""
    index: NDArray[np.int64] = np.searchsorted(ns, at + SLACK_NS, side="right") - 1
    return index


def between(
    ns: NDArray[np.int64], values: NDArray[np.float64], at: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return values at some times, on straight lines between messages: shape (len(at), k)."""
    zero = int(ns[0])
    times, wanted = (ns - zero).astype(np.float64), (at - zero).astype(np.float64)
    return np.stack([np.interp(wanted, times, column) for column in values.T], axis=1)


def velocity_of(mapping: BagMapping) -> CommandSource:
    """Return where the velocity is: its own topic, or the pose's."""
    return mapping.velocity or CommandSource(topic=mapping.pose.topic)


def command_sources(mapping: BagMapping) -> tuple[CommandSource, ...]:
    """Return every stream of commands or velocities that a mapping names."""
    sources = (
        velocity_of(mapping), mapping.executed, mapping.intent, mapping.limited,
        mapping.arbitrated, mapping.demonstrator,
    )  # fmt: skip
    return tuple(source for source in sources if source is not None)


def topics(mapping: BagMapping) -> tuple[str, ...]:
    """Return every topic that a mapping names."""
    sources = (
        mapping.pose, mapping.velocity, mapping.scan, mapping.executed, mapping.intent,
        mapping.limited, mapping.arbitrated, mapping.takeover, mapping.demonstrator,
        mapping.assisted, mapping.contact, mapping.starts,
    )  # fmt: skip
    return tuple(dict.fromkeys(source.topic for source in sources if source is not None))


def _wrong_type(path: object, stream: Stream, types: str) -> InputError:
    return InputError(f"{path}: {stream.topic} is {stream.kind}; allowed: {types}")


def largest_gap(ns: NDArray[np.int64], begin: int, end: int) -> tuple[float, float]:
    """Return the longest time without a message between two times, s, and when it began, s."""
    inside = ns[(ns > begin) & (ns < end)]
    edges = np.concatenate([[begin], inside, [end]])
    gaps = np.diff(edges)
    at = int(np.argmax(gaps))
    return float(gaps[at]) / 1e9, float(edges[at] - begin) / 1e9


def texts(stream: Stream) -> list[Any]:
    """Return the messages' texts; None where a message has none."""
    return [getattr(message, "data", None) for message in stream.messages]
