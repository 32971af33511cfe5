"""ROS 2 recordings in MCAP: a file per participant that ``ros2 bag`` and Foxglove open.

Messages are CDR, as in ROS 2; chunks carry checksums, which the writer of ``rosbags`` leaves out.
The record has no rays, only the smallest range of each of 15 segments: the scan has 15 readings.
"""

import json
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from typing import IO, Any, NamedTuple

import numpy as np
from mcap.writer import Writer
from rosbags.typesys import Stores, get_typestore
from rosbags.typesys.store import Typestore

from analysis.export.content import Content, LapSteps
from analysis.export.file_labels import renamed_text
from analysis.export.readme import write_about
from analysis.export.registry import Tell
from lad.inputs import INPUT_NAMES, N_SEGMENTS
from protocols.wheelchair import LASER_AHEAD, LASER_HEIGHT, LASER_RANGE

EPOCH_S = 1_000_000_000
"""When a session begins, s since 1970: invented, the record has no calendar time."""

BETWEEN_LAPS_S = 10.0
"""Between the end of a lap and the start of the next one: invented too, s."""

MAP, BASE, LASER = "map", "base_link", "laser"
WIDTH_RAD = np.pi / N_SEGMENTS

_HOW = f"""\
ROS 2 recordings (MCAP, CDR), one file per participant: `ros2 bag play P0001.mcap`, or drop it on
Foxglove; a layout for it comes with lad-study (`examples/`).

| topic | type | what |
|---|---|---|
| `/lap` | std_msgs/String | JSON: start and end of each lap, with condition and lap time |
| `/odom` | nav_msgs/Odometry | true pose in `{MAP}` (axle), measured velocity; once more after the last step |
| `/scan` | sensor_msgs/LaserScan | **15 segment minima**, not rays; {LASER_RANGE:g} m: nothing seen |
| `/intent` | geometry_msgs/TwistStamped | the driver's command before the limitation |
| `/limited` | geometry_msgs/TwistStamped | after the limitation: what the model sees |
| `/takeover`, `/takeover_would` | std_msgs/Int8 | demonstrator's signal: +1, -1; or what it would be |
| `/demonstrator` | geometry_msgs/TwistStamped | its command, or the one it would give |
| `/p_help` | std_msgs/Float64 | model's p(h = 1), before it learns from the step |
| `/model` | geometry_msgs/TwistStamped | the command the model predicts |
| `/arbitrated`, `/cmd_vel` | geometry_msgs/TwistStamped | after arbitration; as executed |
| `/control` | std_msgs/String | whose command counted |
| `/contact` | std_msgs/Bool | whether the chair touched something |
| `/tf_static` | tf2_msgs/TFMessage | where the laser stands: {LASER_AHEAD:.2f} m ahead of the axle |

**The calendar time is invented**: a session begins {EPOCH_S} s after 1970, and
{BETWEEN_LAPS_S:g} s lie between laps. A topic has no message where the record has no value or no time;
a laser reading that is missing is NaN.
"""  # noqa: E501


class Topic(NamedTuple):
    """A stream of a lap: its name, its type, and a message from a step's columns; None for none."""

    name: str
    kind: str
    message: Callable[["_Ros", dict[str, Any], int], Any]


@dataclass(frozen=True)
class _Ros:
    """The message types, and how to make the common ones."""

    store: Typestore

    def new(self, kind: str, *values: Any) -> Any:
        """Return a message of a type from its fields in their order."""
        return self.store.types[kind](*values)

    def header(self, ns: int, frame: str) -> Any:
        """Return a header."""
        stamp = self.new("builtin_interfaces/msg/Time", ns // 10**9, ns % 10**9)
        return self.new("std_msgs/msg/Header", stamp, frame)

    def vector(self, x: float, y: float = 0.0, z: float = 0.0) -> Any:
        """Return a vector."""
        return self.new("geometry_msgs/msg/Vector3", x, y, z)

    def turned(self, heading: float) -> Any:
        """Return a heading as a quaternion."""
        half = heading / 2
        kind = "geometry_msgs/msg/Quaternion"
        return self.new(kind, 0.0, 0.0, float(np.sin(half)), float(np.cos(half)))

    def twist(self, v: float, w: float) -> Any:
        """Return a velocity."""
        turn = self.vector(0.0, 0.0, w)
        return self.new("geometry_msgs/msg/Twist", self.vector(v), turn)


_STATE = ("x_m", "y_m", "heading_rad", "velocity_v", "velocity_w")
_SEGMENTS = INPUT_NAMES[-N_SEGMENTS:]


def _twist(prefix: str) -> Callable[[_Ros, dict[str, Any], int], Any]:
    def message(ros: _Ros, row: dict[str, Any], ns: int) -> Any:
        v, w = row[f"{prefix}_v"], row[f"{prefix}_w"]
        if v is None or w is None:
            return None
        header = ros.header(ns, BASE)
        return ros.new("geometry_msgs/msg/TwistStamped", header, ros.twist(v, w))

    return message


def _plain(column: str, kind: str) -> Callable[[_Ros, dict[str, Any], int], Any]:
    def message(ros: _Ros, row: dict[str, Any], _: int) -> Any:
        return None if row[column] is None else ros.new(kind, row[column])

    return message


def _odometry(ros: _Ros, row: dict[str, Any], ns: int) -> Any:
    if any(row[n] is None for n in _STATE):
        return None
    point = ros.new("geometry_msgs/msg/Point", row["x_m"], row["y_m"], 0.0)
    pose = ros.new("geometry_msgs/msg/Pose", point, ros.turned(row["heading_rad"]))
    twist = ros.twist(row["velocity_v"], row["velocity_w"])
    unknown = np.zeros(36)
    return ros.new(
        "nav_msgs/msg/Odometry", ros.header(ns, MAP), BASE,
        ros.new("geometry_msgs/msg/PoseWithCovariance", pose, unknown),
        ros.new("geometry_msgs/msg/TwistWithCovariance", twist, unknown),
    )  # fmt: skip


def _scan(ros: _Ros, row: dict[str, Any], ns: int) -> Any:
    if all(row[n] is None for n in _SEGMENTS):
        return None
    # A reading that is not a number is none, as sensor_msgs/LaserScan has it.
    ranges = np.array([row[n] for n in _SEGMENTS], dtype=np.float32)
    first = float(-np.pi / 2 + WIDTH_RAD / 2)
    return ros.new(
        "sensor_msgs/msg/LaserScan", ros.header(ns, LASER), first, -first, float(WIDTH_RAD), 0.0,
        0.0, 0.0, LASER_RANGE + 0.01, ranges, np.zeros(0, dtype=np.float32),
    )  # fmt: skip


_STAMPED = "geometry_msgs/msg/TwistStamped"
TOPICS: tuple[Topic, ...] = (
    Topic("/odom", "nav_msgs/msg/Odometry", _odometry),
    Topic("/scan", "sensor_msgs/msg/LaserScan", _scan),
    Topic("/intent", _STAMPED, _twist("intent")),
    Topic("/limited", _STAMPED, _twist("user")),
    Topic("/takeover", "std_msgs/msg/Int8", _plain("h", "std_msgs/msg/Int8")),
    Topic("/takeover_would", "std_msgs/msg/Int8", _plain("h_would", "std_msgs/msg/Int8")),
    Topic("/demonstrator", _STAMPED, _twist("would")),
    Topic("/p_help", "std_msgs/msg/Float64", _plain("p_help", "std_msgs/msg/Float64")),
    Topic("/model", _STAMPED, _twist("mean")),
    Topic("/arbitrated", _STAMPED, _twist("arbitrated")),
    Topic("/cmd_vel", _STAMPED, _twist("executed")),
    Topic("/control", "std_msgs/msg/String", _plain("control", "std_msgs/msg/String")),
    Topic("/contact", "std_msgs/msg/Bool", _plain("contact", "std_msgs/msg/Bool")),
)
"""What every control step says."""


def write(content: Content, folder: Path, tell: Tell) -> None:
    """Write one recording per participant into an empty folder."""
    for participant, laps in groupby(content.laps_with_steps(), lambda lap: lap.lap["participant"]):
        tell(f"Recording of {participant}")
        with (folder / f"{content.labels[str(participant)]}.mcap").open("wb") as stream:
            _Recording(stream, content.study.protocol.control_period_s).write(laps)
    write_about(content, folder, _HOW + renamed_text(content.labels))


class _Recording:
    """The recording of one participant's session."""

    def __init__(self, stream: IO[bytes], period_s: float) -> None:
        self._period_s = period_s
        self._ros = _Ros(get_typestore(Stores.ROS2_HUMBLE))
        self._writer = Writer(stream)
        self._kinds = {topic.name: topic.kind for topic in TOPICS}
        self._kinds |= {"/lap": "std_msgs/msg/String", "/tf_static": "tf2_msgs/msg/TFMessage"}
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._sent: Counter[str] = Counter()

    def write(self, laps: Iterator[LapSteps]) -> None:
        """Write all laps, one after the other."""
        self._writer.start(profile="ros2", library="lad-study")
        for name, kind in self._kinds.items():
            self._channels[name] = self._channel(name, kind)
        self._send("/tf_static", self._laser(), EPOCH_S * 10**9)
        begin = EPOCH_S * 10**9
        for lap in laps:
            begin = self._lap(lap, begin) + round(BETWEEN_LAPS_S * 1e9)
        self._writer.finish()  # type: ignore[no-untyped-call]  # the library says no type

    def _channel(self, topic: str, kind: str) -> int:
        if kind not in self._schemas:
            text, _ = self._ros.store.generate_msgdef(kind, ros_version=2)
            self._schemas[kind] = self._writer.register_schema(kind, "ros2msg", text.encode())
        return self._writer.register_channel(topic, "cdr", self._schemas[kind], {})

    def _lap(self, lap: LapSteps, begin: int) -> int:
        """Write one lap; return when it ended, ns."""
        row = {n: lap.lap[n] for n in ("participant", "lap", "condition", "practice", "training")}
        self._say({"event": "start", **row}, begin)
        steps = lap.steps.to_pylist()
        timed = [step for step in steps if step["t_s"] is not None]
        for step in timed:
            ns = begin + round(step["t_s"] * 1e9)
            for topic in TOPICS:
                message = topic.message(self._ros, step, ns)
                if message is not None:
                    self._send(topic.name, message, ns)
        end = begin + round((timed[-1]["t_s"] + self._period_s) * 1e9) if timed else begin
        self._after(lap, steps, end)
        ending = {n: lap.lap[n] for n in ("completed", "end_reason", "lap_time_s")}
        self._say({"event": "end", **row, **ending}, end)
        return end

    def _after(self, lap: LapSteps, steps: list[dict[str, Any]], end: int) -> None:
        """Write the state after the last step, where the record has it."""
        if not steps:
            return
        last = steps[-1]
        state = {n: last[f"result_{n.removeprefix('velocity_')}"] for n in _STATE}
        seen = {name: lap.lap[f"last_segment_{i:02d}"] for i, name in enumerate(_SEGMENTS)}
        for topic, message in (
            ("/odom", _odometry(self._ros, state, end)),
            ("/scan", _scan(self._ros, seen, end)),
        ):
            if message is not None:
                self._send(topic, message, end)

    def _say(self, what: dict[str, Any], ns: int) -> None:
        text = self._ros.new("std_msgs/msg/String", json.dumps(what))
        self._send("/lap", text, ns)

    def _send(self, topic: str, message: Any, ns: int) -> None:
        content = bytes(self._ros.store.serialize_cdr(message, self._kinds[topic]))
        self._writer.add_message(self._channels[topic], ns, content, ns, self._sent[topic])
        self._sent[topic] += 1

    def _laser(self) -> Any:
        where = self._ros.vector(LASER_AHEAD, 0.0, LASER_HEIGHT)
        transform = self._ros.new("geometry_msgs/msg/Transform", where, self._ros.turned(0.0))
        header = self._ros.header(EPOCH_S * 10**9, BASE)
        stamped = self._ros.new("geometry_msgs/msg/TransformStamped", header, LASER, transform)
        return self._ros.new("tf2_msgs/msg/TFMessage", [stamped])
