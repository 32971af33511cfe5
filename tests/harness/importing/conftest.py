"""Recordings of a chair that drives along the centreline, written by a library of others."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("rosbags")

from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore

from protocols.course.centreline import Centreline
from protocols.load import load_course

SPEED = 0.5
STEP_S = 0.03
LAPS = 2
BREAK_S = 5.0

PROTOCOL = """\
schema: 1
name: recorded
title: Recorded
conditions:
  baseline: {}
  helped: {limitation: {right_turn_rad_s: 0.15}, assistant: demonstrator, training: true}
laps: [{condition: baseline}, {condition: helped}]
"""

MAPPING = """\
schema: 1
protocol: protocol.yaml
pose: {topic: /odom, frame: odom, transform: {x: 3.0, y: -2.0, yaw: 0.8}}
scan: {topic: /scan}
executed: {topic: /cmd_vel}
intent: {topic: /joy, stick: {axis_v: 1, axis_w: 0, scale_v: 0.7, scale_w: 0.5}}
takeover: {topic: /takeover}
demonstrator: {topic: /demonstrator}
starts: {topic: /lap, text: go}
"""


class Recording:
    """What a recorder would have written: (topic, type, arrival in s, message) in order."""

    def __init__(self, store: Any, ros: int) -> None:
        self.store, self.ros = store, ros
        self.messages: list[tuple[str, str, float, Any]] = []

    def new(self, kind: str, **fields: Any) -> Any:
        return self.store.types[kind](**fields)

    def header(self, t: float, frame: str) -> Any:
        ns = round(t * 1e9)
        stamp = self.new("builtin_interfaces/msg/Time", sec=ns // 10**9, nanosec=ns % 10**9)
        fields = {"stamp": stamp, "frame_id": frame}
        return self.new("std_msgs/msg/Header", **({"seq": 0} if self.ros == 1 else {}), **fields)

    def add(self, topic: str, kind: str, t: float, message: Any) -> None:
        self.messages.append((topic, kind, t, message))

    def twist(self, v: float, w: float) -> Any:
        kind = "geometry_msgs/msg/Vector3"
        linear, angular = self.new(kind, x=v, y=0.0, z=0.0), self.new(kind, x=0.0, y=0.0, z=w)
        return self.new("geometry_msgs/msg/Twist", linear=linear, angular=angular)


def _odometry(bag: Recording, t: float, x: float, y: float, heading: float) -> Any:
    point = bag.new("geometry_msgs/msg/Point", x=x, y=y, z=0.0)
    turn = bag.new(
        "geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=np.sin(heading / 2), w=np.cos(heading / 2)
    )
    pose = bag.new("geometry_msgs/msg/Pose", position=point, orientation=turn)
    cov = np.zeros(36)
    return bag.new(
        "nav_msgs/msg/Odometry",
        header=bag.header(t, "odom"),
        child_frame_id="base_link",
        pose=bag.new("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=cov),
        twist=bag.new(
            "geometry_msgs/msg/TwistWithCovariance", twist=bag.twist(SPEED, -0.1), covariance=cov
        ),
    )


def _scan(bag: Recording, t: float) -> Any:
    ranges = np.full(181, 2.0, dtype=np.float32)
    ranges[:12] = np.inf  # nothing to the right
    ranges[90], ranges[91], ranges[100] = np.nan, 0.005, 1.25
    return bag.new(
        "sensor_msgs/msg/LaserScan",
        header=bag.header(t, "laser"),
        angle_min=-np.pi / 2,
        angle_max=np.pi / 2,
        angle_increment=np.pi / 180,
        time_increment=0.0,
        scan_time=0.1,
        range_min=0.02,
        range_max=5.0,
        ranges=ranges,
        intensities=np.zeros(0, dtype=np.float32),
    )


def record(ros: int, offset_s: float = 0.0) -> Recording:
    """Return two laps along the centreline, in a turned frame, with jitter."""
    bag = Recording(get_typestore(Stores.ROS1_NOETIC if ros == 1 else Stores.ROS2_HUMBLE), ros)
    line = Centreline(load_course("lab-office"))
    rng = np.random.default_rng(3)
    zero = 1000.0
    cos, sin = np.cos(-0.8), np.sin(-0.8)
    lap_s = (line.length + 0.3) / SPEED
    for lap in range(LAPS):
        begin = zero + lap * (lap_s + BREAK_S)
        bag.add("/lap", "std_msgs/msg/String", begin,
                bag.new("std_msgs/msg/String", data=f"go {lap}"))  # fmt: skip
        for k in range(int(lap_s / STEP_S) + 2):
            t = begin + k * STEP_S
            arc = SPEED * k * STEP_S
            at = line.point(arc)
            past = max(0.0, arc - line.length)
            x, y = at.x + past * np.cos(at.heading) - 3.0, at.y + past * np.sin(at.heading) + 2.0
            late = t + rng.uniform(0, 0.02) + offset_s
            bag.add("/odom", "nav_msgs/msg/Odometry", late,
                    _odometry(bag, t, cos * x - sin * y, sin * x + cos * y, at.heading - 0.8)
                    )  # fmt: skip
            if k % 3 == 0:
                bag.add("/scan", "sensor_msgs/msg/LaserScan", late, _scan(bag, t))
                axes = np.array([-0.4, 0.5], dtype=np.float32)
                bag.add("/joy", "sensor_msgs/msg/Joy", late, bag.new(
                    "sensor_msgs/msg/Joy", header=bag.header(t, ""), axes=axes,
                    buttons=np.zeros(2, dtype=np.int32)))  # fmt: skip
                stamped = bag.new("geometry_msgs/msg/TwistStamped", header=bag.header(t, ""),
                                  twist=bag.twist(0.3, -0.2))  # fmt: skip
                bag.add("/cmd_vel", "geometry_msgs/msg/TwistStamped", late, stamped)
                bag.add("/demonstrator", "geometry_msgs/msg/TwistStamped", late, stamped)
                helping = bag.new("std_msgs/msg/Bool", data=bool(2.0 < arc < 4.0))
                bag.add("/takeover", "std_msgs/msg/Bool", t, helping)
    bag.messages.sort(key=lambda entry: entry[2])
    return bag


def write(bag: Recording, path: Path, storage: str) -> Path:
    """Write a recording as a ROS 1 bag, or a ROS 2 one in sqlite or MCAP."""
    if storage == "ros1":
        writer: Any = Writer1(path.with_suffix(".bag"))
    else:
        plugin = StoragePlugin.MCAP if storage == "mcap" else StoragePlugin.SQLITE3
        writer = Writer2(path, version=9, storage_plugin=plugin)
    with writer:
        known: dict[str, Any] = {}
        for topic, kind, t, message in bag.messages:
            if topic not in known:
                known[topic] = writer.add_connection(topic, kind, typestore=bag.store)
            if storage == "ros1":
                raw = bag.store.serialize_ros1(message, kind)
            else:
                raw = bag.store.serialize_cdr(message, kind)
            writer.write(known[topic], round(t * 1e9), raw)
    return path.with_suffix(".bag") if storage == "ros1" else path


@pytest.fixture
def make_bag(tmp_path: Path) -> Callable[..., Path]:
    """Return the function that writes a recording after something was changed in it."""

    def make(
        storage: str = "sqlite",
        change: Callable[[Recording], None] = lambda _: None,
        **options: Any,
    ) -> Path:
        bag = record(1 if storage == "ros1" else 2, **options)
        change(bag)
        return write(bag, tmp_path / "session", storage)

    return make


@pytest.fixture
def mapping(tmp_path: Path) -> Callable[..., Path]:
    """Return the function that writes protocol and mapping; lines can be replaced or added."""

    def make(more: str = "", **lines: str) -> Path:
        (tmp_path / "protocol.yaml").write_text(PROTOCOL)
        kept = [lines.get(line.partition(":")[0], line) for line in MAPPING.splitlines()]
        (tmp_path / "map.yaml").write_text("\n".join([*kept, more, ""]))
        return tmp_path / "map.yaml"

    return make
